#include "paths/lattice/loop_merge.h"

#include <map>

#include "paths/lattice/chain_labels.h"
#include "tests/paths/lattice/lattice_test_util.h"

namespace dwell {
namespace {

using Cell = CellLinks::Cell;

/// Chain of each kept cell by flooding over links: two cells share a number if and only if they are linked.
std::map<Cell, int> flood_links(const CellLinks& links) {
  std::map<Cell, int> chain;
  int count = 0;
  for (Cell c = 0; c < links.size(); ++c) {
    if (!links.kept(c) || chain.count(c) != 0) continue;
    std::vector<Cell> stack{c};
    chain[c] = count;
    while (!stack.empty()) {
      const Cell x = stack.back();
      stack.pop_back();
      for (int d = 0; d < 4; ++d) {
        if (links.linked(x, d) && chain.emplace(links.neighbour(x, d), count).second) {
          stack.push_back(links.neighbour(x, d));
        }
      }
    }
    ++count;
  }
  return chain;
}

void expect_labels(const ChainLabels& labels, const CellLinks& links) {
  std::map<int, std::int32_t> name_of;
  std::map<std::int32_t, int> chain_of;
  std::map<int, Index> cells;
  std::map<int, int> degrees;
  const std::map<Cell, int> chains = flood_links(links);
  for (const auto& [c, chain] : chains) {
    ASSERT_EQ(name_of.emplace(chain, labels.name(c)).first->second, labels.name(c));
    ASSERT_EQ(chain_of.emplace(labels.name(c), chain).first->second, chain);
    ++cells[chain];
    degrees[chain] += links.degree(c);
  }
  for (const auto& [c, chain] : chains) {
    ASSERT_EQ(labels.cells(c), cells[chain]);
    ASSERT_EQ(labels.open(c), degrees[chain] < 2 * cells[chain]);
  }
}

CellLattice lattice_of(unsigned number) {
  return cell_lattice(test::random_aperture(number), {0.5 + 0.1 * (number % 5), {}, 0.0}, "x");
}

TEST(RandomNumbers, GivesTheStandardsNumbers) {
  RandomNumbers dice(5489);  // [rand.predef]: the 10000th of a default-seeded mt19937_64
  std::uint64_t last = 0;
  for (int k = 0; k < 10000; ++k) last = dice.bits();
  EXPECT_EQ(last, 9981545732273789042u);
  std::vector<int> count(7, 0);
  for (int k = 0; k < 70000; ++k) ++count[dice.below(7)];
  for (const int c : count) EXPECT_NEAR(c, 10000, 500);
  std::vector<int> values{1, 2, 3, 4, 5, 6, 7, 8};
  dice.shuffle(values);
  EXPECT_NE(values, (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_TRUE(std::is_permutation(values.begin(), values.end(), std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}.begin()));
}

/// Any flip of a square joins, splits or rearranges; the names follow.
TEST(ChainLabels, FollowRandomFlips) {
  Index joins = 0, splits = 0, kept_whole = 0;
  for (unsigned number = 0; number < 40; ++number) {
    SCOPED_TRACE(number);
    CellLinks links(lattice_of(number));
    LatticePieces pieces = find_pieces(links);
    RandomNumbers dice(number);
    cover_with_loops(links, pieces, false, dice);
    ChainLabels labels(links);
    expect_labels(labels, links);
    std::int64_t steps = 0;
    for (int k = 0; k < 400; ++k) {
      const Cell square = links.first() + static_cast<Cell>(dice.below(static_cast<std::uint32_t>(links.size())));
      if (square >= links.end() || links.flippable(square) == 0) continue;
      const Cell other = links.flippable(square) == 1 ? square + links.row_step() : square + 1;
      if (labels.name(square) != labels.name(other)) {
        if (!labels.join(square, other)) continue;
        links.flip(square);
        ++joins;
      } else {
        links.flip(square);
        ++(labels.split(square, steps) >= 0 ? splits : kept_whole);
      }
      expect_labels(labels, links);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(joins, 50);
  EXPECT_GT(splits, 50);
  EXPECT_GT(kept_whole, 5);
}

/// The largest number of links that give every cell at most two, by trying all sets of links.
int most_links(const std::vector<std::pair<int, int>>& edges, std::size_t from, std::vector<int>& degree) {
  if (from == edges.size()) return 0;
  const auto [a, b] = edges[from];
  int best = most_links(edges, from + 1, degree);
  int& at_a = degree[static_cast<std::size_t>(a)];
  int& at_b = degree[static_cast<std::size_t>(b)];
  if (at_a < 2 && at_b < 2) {
    ++at_a;
    ++at_b;
    best = std::max(best, 1 + most_links(edges, from + 1, degree));
    --at_a;
    --at_b;
  }
  return best;
}

TEST(LinkCover, MakesTheMostLinks) {
  for (unsigned number = 1; number <= 60; ++number) {
    SCOPED_TRACE(number);
    std::mt19937 random(number);
    HeightMap map = test::full_map(3, 4);
    for (double& v : map.values) v = random() % 4 == 0 ? test::kNaN : 1.0;
    map.at(0, 1) = map.at(2, 3) = 1.0;
    std::vector<std::pair<int, int>> edges;
    for (int row = 0; row < 3; ++row) {
      for (int col = 0; col < 4; ++col) {
        if (!std::isfinite(map.at(row, col))) continue;
        if (col < 3 && std::isfinite(map.at(row, col + 1))) edges.emplace_back(4 * row + col, 4 * row + col + 1);
        if (row < 2 && std::isfinite(map.at(row + 1, col))) edges.emplace_back(4 * row + col, 4 * row + col + 4);
      }
    }
    std::vector<int> degree(12, 0);
    const int most = most_links(edges, 0, degree);

    CellLattice lattice = cell_lattice(map, {1.0, {}, 0.0}, "x");
    CellLinks links(lattice);
    LatticePieces pieces = find_pieces(links);
    RandomNumbers dice(number);
    cover_with_loops(links, pieces, false, dice);
    int total = 0, cells = 0, missing = 0;
    for (Cell c = 0; c < links.size(); ++c) {
      ASSERT_LE(links.degree(c), 2);
      total += links.degree(c);
      cells += links.kept(c) ? 1 : 0;
      for (int d = 0; d < 4; ++d) ASSERT_TRUE(!links.linked(c, d) || links.linked(links.neighbour(c, d), d ^ 2));
    }
    for (const LatticePiece& piece : pieces.pieces) missing += static_cast<int>(piece.open_ends);
    ASSERT_EQ(total, 2 * most);
    ASSERT_EQ(missing, 2 * cells - total);
  }
}

/// Merging keeps what every cell has but for loops that are opened, and leaves one chain where there was no other end.
TEST(LoopMerge, JoinsTheLoopsOfARectangle) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    CellLinks links(cell_lattice(test::full_map(6 + seed % 3, 8 + seed % 5), {1.0, {}, 0.0}, "x"));
    LatticePieces pieces = find_pieces(links);
    RandomNumbers dice(seed);
    cover_with_loops(links, pieces, false, dice);
    merge_loops(links, pieces, dice);
    int chains = 0;
    for (const auto& [c, chain] : flood_links(links)) chains = std::max(chains, chain + 1);
    EXPECT_EQ(chains, 1) << seed;
  }
}

}  // namespace
}  // namespace dwell
