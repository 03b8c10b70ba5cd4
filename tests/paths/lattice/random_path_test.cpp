#include "paths/lattice/random_path.h"

#include <bit>
#include <map>

#include "tests/paths/lattice/lattice_test_util.h"

namespace dwell {
namespace {

using test::full_map;
using test::map_from_picture;
using test::RowCol;

RandomOptions random_options(double pitch, std::uint64_t seed = 1, std::optional<double> overrun = {},
                             double angle = 0.0) {
  return {{pitch, overrun, angle}, seed};
}

/// The pieces of the lattice, flooded anew.
std::map<RowCol, int> flood(const std::set<RowCol>& kept) {
  std::map<RowCol, int> piece;
  int count = 0;
  for (const RowCol& seed : kept) {
    if (piece.count(seed) != 0) continue;
    std::vector<RowCol> stack{seed};
    piece[seed] = count;
    while (!stack.empty()) {
      const auto [row, col] = stack.back();
      stack.pop_back();
      for (const RowCol& next : {RowCol{row, col + 1}, {row, col - 1}, {row + 1, col}, {row - 1, col}}) {
        if (kept.count(next) == 1 && piece.emplace(next, count).second) stack.push_back(next);
      }
    }
    ++count;
  }
  return piece;
}

/// Every point kept and at most once, neighbour to neighbour but where lifted, and all that the result says of itself.
void expect_sound(const RandomPath& result, const HeightMap& map, const RandomOptions& o) {
  const test::SlowLattice lattice(map, o.lattice);
  const std::vector<RowCol> order = test::visited_once(result.path, lattice);
  const std::map<RowCol, int> piece = flood(lattice.kept);
  ASSERT_EQ(result.lattice_points, static_cast<Index>(lattice.kept.size()));
  ASSERT_EQ(result.left_out, static_cast<Index>(lattice.kept.size() - order.size()));
  ASSERT_LE(result.must_leave_out, result.left_out + 2 * result.lifts_in_pieces);

  std::set<int> visited_pieces;
  Index chains = 0;
  ASSERT_EQ(result.path.lifted[0], 1);
  for (std::size_t j = 0; j < order.size(); ++j) {
    visited_pieces.insert(piece.at(order[j]));
    ASSERT_TRUE(result.path.lifted[j] != 0 || test::neighbours(order[j - 1], order[j]));
    chains += result.path.lifted[j] != 0 ? 1 : 0;
  }
  const auto pieces =
      static_cast<Index>(
          std::max_element(piece.begin(), piece.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
              ->second) +
      1;
  ASSERT_EQ(result.pieces, pieces);
  ASSERT_EQ(static_cast<Index>(visited_pieces.size()), pieces);
  ASSERT_EQ(result.lifts_in_pieces, chains - pieces);

  const std::set<RowCol> visited(order.begin(), order.end());
  Index beside = 0;
  for (const auto& [row, col] : lattice.kept) {
    if (visited.count({row, col}) == 1) continue;
    const bool next_to_path = visited.count({row, col + 1}) + visited.count({row, col - 1}) +
                                  visited.count({row + 1, col}) + visited.count({row - 1, col}) >
                              0;
    beside += next_to_path ? 1 : 0;
  }
  ASSERT_EQ(result.left_out_beside, beside);
  const std::size_t notes = (result.left_out > 0 ? 1u : 0u) + (pieces > 1 ? 1u : 0u) + (chains > pieces ? 1u : 0u);
  ASSERT_EQ(result.path.notes.size(), notes);
}

/// Points of a longest path through all-different neighbours, by dynamic programming over all sets of points.
Index longest_path(const std::vector<RowCol>& cells) {
  const std::size_t n = cells.size();
  std::vector<std::uint32_t> next_to(n, 0);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) next_to[a] |= test::neighbours(cells[a], cells[b]) ? 1u << b : 0u;
  }
  std::vector<std::uint32_t> ends(std::size_t{1} << n, 0);  // by set: points at which a path through all of it can end
  Index longest = 0;
  for (std::uint32_t set = 1; set < ends.size(); ++set) {
    for (std::size_t a = 0; a < n; ++a) {
      if ((set >> a & 1u) == 0) continue;
      const std::uint32_t before = set & ~(1u << a);
      if (before == 0 || (ends[before] & next_to[a]) != 0) ends[set] |= 1u << a;
    }
    if (ends[set] != 0) longest = std::max<Index>(longest, std::popcount(set));
  }
  return longest;
}

TEST(RandomPath, VisitsAllOfThePapersArea) {
  // Zha et al. 2020, section 3.1: 260 x 260 mm at 1 mm.
  const HeightMap map = full_map(260, 260);
  const RandomPath result = random_path(map, random_options(1.0));
  ASSERT_EQ(result.path.size(), 67600u);
  EXPECT_EQ(result.path.kind, "random");
  EXPECT_EQ(result.left_out, 0);
  EXPECT_TRUE(result.path.notes.empty());
  std::set<std::pair<double, double>> seen;
  double horizontal = 0.0;
  int runs = 0, long_runs = 0, run = 0;
  bool was_horizontal = false;
  for (std::size_t j = 0; j < result.path.size(); ++j) {
    const Point p = result.path.points[j];
    ASSERT_TRUE(p.x >= 0 && p.x <= 259 && p.y >= 0 && p.y <= 259 && p.x == std::floor(p.x) && p.y == std::floor(p.y));
    ASSERT_TRUE(seen.emplace(p.x, p.y).second);
    ASSERT_EQ(result.path.lifted[j], j == 0 ? 1 : 0);
    if (j == 0) continue;
    const Point step = p - result.path.points[j - 1];
    ASSERT_EQ(std::abs(step.x) + std::abs(step.y), 1.0);
    const bool is_horizontal = step.x != 0.0;
    horizontal += is_horizontal ? 1.0 : 0.0;
    run = is_horizontal == was_horizontal ? run + 1 : 1;
    was_horizontal = is_horizontal;
    runs += run == 1 ? 1 : 0;
    long_runs += run == 13 ? 1 : 0;
  }
  EXPECT_NEAR(horizontal / 67599.0, 0.5, 0.05);
  EXPECT_GT(runs, 67600 / 3) << "it turns at least every third step";
  EXPECT_LT(long_runs, 20) << "straight for more than 12 steps";
}

TEST(RandomPath, EverySmallRectangleIsVisitedWhole) {
  for (Index rows = 1; rows <= 9; ++rows) {
    for (Index cols = 1; cols <= 10; ++cols) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const HeightMap map = full_map(rows, cols, 0.7, 0.7, {2.0, -9.0});
        const RandomPath result = random_path(map, random_options(0.7, seed));
        SCOPED_TRACE(testing::Message() << rows << " x " << cols << " seed " << seed);
        expect_sound(result, map, random_options(0.7, seed));
        ASSERT_EQ(result.left_out, 0);
        ASSERT_EQ(result.lifts_in_pieces, 0);
        ASSERT_EQ(result.must_leave_out, 0);
      }
    }
  }
}

TEST(RandomPath, ADiscOfEvenWidthIsVisitedWhole) {
  HeightMap map = full_map(60, 61);
  for (Index row = 0; row < 60; ++row) {
    for (Index col = 0; col < 61; ++col) {
      if (std::hypot(static_cast<double>(row) - 29.5, static_cast<double>(col) - 30.0) > 29.8) {
        map.at(row, col) = test::kNaN;
      }
    }
  }
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const RandomPath result = random_path(map, random_options(1.0, seed));
    expect_sound(result, map, random_options(1.0, seed));
    EXPECT_GT(result.lattice_points, 2700);
    EXPECT_EQ(result.left_out, 0);
    EXPECT_EQ(result.lifts_in_pieces, 0);
  }
}

TEST(RandomPath, ChessboardWithoutTwoCornersOfAColourLeavesOneOut) {
  HeightMap map = full_map(8, 8);
  map.at(0, 0) = map.at(7, 7) = test::kNaN;  // 32 of one colour, 30 of the other: a path takes 61
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const RandomPath result = random_path(map, random_options(1.0, seed));
    expect_sound(result, map, random_options(1.0, seed));
    EXPECT_EQ(result.must_leave_out, 1);
    EXPECT_EQ(result.left_out, 1);
    ASSERT_EQ(result.path.notes.size(), 1u);
    EXPECT_EQ(result.path.notes[0],
              "1 of 62 lattice points left out, all of them a pitch from the path, so that it works on their "
              "surroundings: 1 because a path along the lattice takes black and white points of the chessboard in turn "
              "and has two ends (without lifts)");
  }
  HeightMap fair = full_map(8, 8);
  fair.at(2, 3) = fair.at(5, 5) = test::kNaN;  // one of each colour
  EXPECT_EQ(random_path(fair, random_options(1.0)).left_out, 0);
}

/// Boards of up to 16 points, against the longest path of each piece.
TEST(RandomPath, BoundHoldsOnEveryBoardAndIsMostlyMet) {
  Index boards = 0, best = 0;
  for (unsigned number = 1; number <= 150; ++number) {
    SCOPED_TRACE(number);
    std::mt19937 random(number);
    HeightMap map = full_map(4, 4, 1.0, 1.0, {-3.0, 8.0});
    for (double& v : map.values) v = random() % 5 == 0 ? test::kNaN : 1.0;
    map.at(0, 0) = map.at(3, 3) = 1.0;
    const RandomPath result = random_path(map, random_options(1.0, number));
    expect_sound(result, map, random_options(1.0, number));
    std::map<int, std::vector<RowCol>> pieces;
    for (const auto& [cell, piece] : flood(test::SlowLattice(map, random_options(1.0).lattice).kept)) {
      pieces[piece].push_back(cell);
    }
    Index fewest = 0;
    for (const auto& [piece, cells] : pieces) fewest += static_cast<Index>(cells.size()) - longest_path(cells);
    ASSERT_LE(result.must_leave_out, fewest);
    if (result.lifts_in_pieces == 0) {
      ASSERT_GE(result.left_out, fewest);
    }
    ++boards;
    best += result.lifts_in_pieces == 0 && result.left_out == fewest ? 1 : 0;
  }
  EXPECT_GE(best, boards * 9 / 10);
}

TEST(RandomPath, CorridorsAreVisitedWithLifts) {
  const HeightMap map = map_from_picture({
      "....1....",
      "....1....",
      "....1....",
      "...111...",
      "111111111",
      "...111...",
      "....1....",
      "....1....",
      "....1....",
  });
  const RandomPath result = random_path(map, random_options(1.0));
  expect_sound(result, map, random_options(1.0));
  EXPECT_LE(result.left_out, 3);
  EXPECT_GE(result.lifts_in_pieces, 1);
}

TEST(RandomPath, PiecesAreJoinedByLifts) {
  const HeightMap map = map_from_picture({"11..1111", "11......", "11.....1", "........", "1111..11"});
  const RandomPath result = random_path(map, random_options(1.0));
  expect_sound(result, map, random_options(1.0));
  EXPECT_EQ(result.pieces, 5);
  EXPECT_EQ(result.left_out, 0);
  EXPECT_EQ(result.path.notes,
            std::vector<std::string>{"the lattice points fall into 5 pieces; the tool is lifted between them"});
}

TEST(RandomPath, SoundOnRandomApertures) {
  for (unsigned number = 0; number < 120; ++number) {
    SCOPED_TRACE(number);
    const HeightMap map = test::random_aperture(number);
    const RandomOptions o = random_options(0.4 + 0.13 * (number % 9), number, 0.5 * (number % 4), 15.0 * (number % 7));
    expect_sound(random_path(map, o), map, o);
  }
}

TEST(RandomPath, TheSeedDecidesTheBytes) {
  const HeightMap map = full_map(13, 22, 0.9, 1.1);
  const ToolPath one = random_path(map, random_options(1.0, 7)).path;
  EXPECT_EQ(one.points, random_path(map, random_options(1.0, 7)).path.points);
  EXPECT_NE(one.points, random_path(map, random_options(1.0, 8)).path.points);
}

TEST(RandomOptions, AreParsedAndTheSeedIsAnInteger) {
  const auto parse = [](const std::string& text) { return parse_random_options(parse_spec_text(text, "path")); };
  const RandomOptions full = parse("random:pitch=2,overrun=3,angle=-10,seed=9007199254740992");
  EXPECT_EQ(full.lattice.pitch, 2.0);
  EXPECT_EQ(full.lattice.overrun, 3.0);
  EXPECT_EQ(full.lattice.angle_deg, -10.0);
  EXPECT_EQ(full.seed, 9007199254740992u);
  EXPECT_EQ(parse("random:pitch=2").seed, 1u);
  for (const char* seed : {"1.5", "-1", "1e16", "inf"}) {
    const std::string text = std::string("random:pitch=2,seed=") + seed;
    EXPECT_EQ(test::message_of([&] { parse(text); }),
              "path \"" + text + "\": seed = \"" + seed + "\"; required an integer from 0 to 2^53");
  }
  EXPECT_EQ(
      test::message_of([&] { parse("random:pitch=1,gaps=link"); }),
      "path \"random:pitch=1,gaps=link\": unknown key \"gaps\"; accepted for random: pitch, overrun, angle, seed");
  EXPECT_EQ(test::message_of([] { random_path(full_map(2, 2), random_options(-1.0)); }),
            "random: pitch = -1 mm; required > 0");
}

}  // namespace
}  // namespace dwell
