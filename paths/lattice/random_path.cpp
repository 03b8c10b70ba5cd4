#include "paths/lattice/random_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/base/counted.h"
#include "core/base/poll.h"
#include "core/base/random_numbers.h"
#include "paths/domain/cell_pyramid.h"
#include "paths/lattice/cell_links.h"
#include "paths/lattice/link_cover.h"
#include "paths/lattice/loop_merge.h"

namespace dwell {
namespace {

using Cell = CellLinks::Cell;

using Chains = std::vector<std::pair<Cell, Cell>>;  // end cells

/// Cuts every loop at its lowest, leftmost cell.
Chains cut_to_chains(CellLinks& links, const Progress& progress) {
  Poll poll(progress);
  std::vector<char> seen(static_cast<std::size_t>(links.size()), 0);
  const auto other_end = [&](Cell c) {
    int way = links.link_direction(c);
    seen[static_cast<std::size_t>(c)] = 1;
    while (way >= 0) {
      poll.step();
      c = links.neighbour(c, way);
      seen[static_cast<std::size_t>(c)] = 1;
      way = links.link_direction(c, way ^ 2);
    }
    return c;
  };
  Chains chains;
  for (const bool loops : {false, true}) {
    for (Cell c = links.first(); c < links.end(); ++c) {
      poll.step();
      if (!links.kept(c) || seen[static_cast<std::size_t>(c)] != 0) continue;
      if (!loops && links.degree(c) == 2) continue;
      const int cut = links.link_direction(c);
      if (loops && cut >= 0) links.toggle(c, cut);
      chains.emplace_back(c, other_end(c));
    }
  }
  return chains;
}

/// Chains through all pieces of a lattice.
struct Cover {
  CellLinks links;
  LatticePieces pieces;
  Chains chains;
  Index left_out = 0;
  Index must_leave_out = 0;  // before corners are thinned

  Index lifts_in_pieces() const { return static_cast<Index>(chains.size() - pieces.pieces.size()); }
};

void cover(Cover& c, bool peel, RandomNumbers& dice, const Progress& progress) {
  Poll poll(progress);
  CellLinks& links = c.links;
  trim_dead_ends(links, c.pieces, dice, progress);
  cover_with_loops(links, c.pieces, peel, dice, progress);
  merge_loops(links, c.pieces, dice, progress);
  Index kept = 0, all = 0;
  for (const LatticePiece& piece : c.pieces.pieces) all += piece.cells;
  for (Cell cell = links.first(); cell < links.end(); ++cell) {
    poll.step();
    if (links.degree(cell) == 0 && links.kept(cell) && links.kept_neighbours(cell) > 0) links.drop(cell);
    kept += links.kept(cell) ? 1 : 0;
  }
  c.left_out = all - kept;
  c.chains = cut_to_chains(links, progress);
}

/// By piece: whether it has more than one chain.
std::vector<char> in_parts(const Cover& c) {
  std::vector<char> parts(c.pieces.pieces.size(), 0);
  std::vector<char> seen = parts;
  for (const auto& [first, last] : c.chains) {
    const auto piece = static_cast<std::size_t>(c.pieces.of_cell[static_cast<std::size_t>(first)]);
    parts[piece] = std::exchange(seen[piece], 1);
  }
  return parts;
}

/// Tries again where a piece has not become one chain: first with ends peeled off, then with more and more of its
/// corners left out.
Cover best_cover(const CellLattice& lattice, RandomNumbers& dice, const Progress& progress) {
  constexpr Index kPointsForALift = 64;
  const CellLinks bare(lattice);
  const LatticePieces pieces = find_pieces(bare, progress);
  Cover best{bare, pieces, {}};
  cover(best, false, dice, progress);
  for (const LatticePiece& piece : best.pieces.pieces) best.must_leave_out += piece.must_leave_out();
  for (const unsigned share : {0U, 16U, 128U}) {
    if (best.lifts_in_pieces() == 0) break;
    Cover next{bare, pieces, {}};
    next.must_leave_out = best.must_leave_out;
    thin_corners(next.links, pieces, in_parts(best), share, dice, progress);
    cover(next, true, dice, progress);
    const auto price = [&](const Cover& c) { return c.left_out + kPointsForALift * c.lifts_in_pieces(); };
    if (price(next) < price(best)) best = std::move(next);
  }
  return best;
}

/// Chains in a short order: from the end of one to the nearest end of another.
class Assembly {
 public:
  Assembly(const CellLattice& lattice, const CellLinks& links, ToolPath& path, const Progress& progress)
      : poll_(progress), lattice_(lattice), links_(links), path_(path) {
    path_.points.reserve(static_cast<std::size_t>(lattice.kept_cells));
    path_.lifted.reserve(static_cast<std::size_t>(lattice.kept_cells));
  }

  void add_all(const Chains& chains) {
    if (chains.size() == 1) {
      add(chains[0].first);
      return;
    }
    std::vector<double> is_end(lattice_.kept.size(), std::numeric_limits<double>::quiet_NaN());
    for (const auto& [a, b] : chains) is_end[index(a)] = is_end[index(b)] = 0.0;
    CellPyramid ends(lattice_.rows, lattice_.cols, std::move(is_end));
    const Index columns = lattice_.cols;
    Index next = ends.nearest(0, 0);
    while (next >= 0) {
      const Cell begin =
          links_.first() + static_cast<Cell>(next / columns) * links_.row_step() + static_cast<Cell>(next % columns);
      const Index last = links_.lattice_cell(add(begin));
      ends.remove(next);
      if (last != next) ends.remove(last);
      next = ends.nearest(last / columns, last % columns);
    }
  }

 private:
  std::size_t index(Cell c) const { return static_cast<std::size_t>(links_.lattice_cell(c)); }

  /// Returns the last cell.
  Cell add(Cell c) {
    int way = links_.link_direction(c);
    append(c, 1);
    while (way >= 0) {
      c = links_.neighbour(c, way);
      append(c, 0);
      way = links_.link_direction(c, way ^ 2);
    }
    return c;
  }
  void append(Cell c, char lifted) {
    poll_.step();
    path_.points.push_back(lattice_.at(links_.lattice_cell(c)));
    path_.lifted.push_back(lifted);
  }

  Poll poll_;
  const CellLattice& lattice_;
  const CellLinks& links_;
  ToolPath& path_;
};

/// Points not visited that have a visited neighbour.
Index left_out_beside(const CellLattice& lattice, const CellLinks& links, const Progress& progress) {
  Index count = 0;
  for (Index row = 0; row < lattice.rows; ++row) {
    progress.check();
    for (Index col = 0; col < lattice.cols; ++col) {
      const Cell c = links.first() + static_cast<Cell>(row) * links.row_step() + static_cast<Cell>(col);
      if (lattice.keeps(row, col) && !links.kept(c) && links.kept_neighbours(c) > 0) ++count;
    }
  }
  return count;
}

void add_notes(RandomPath& r) {
  if (r.left_out > 0) {
    const std::string beside = r.left_out_beside == r.left_out ? "all" : std::to_string(r.left_out_beside);
    const Index unavoidable = std::min(r.left_out, r.must_leave_out);
    std::string note = fmt::format(
        "{} of {} lattice points left out, {} of them a pitch from the path, so that it works on their "
        "surroundings: ",
        r.left_out, r.lattice_points, beside);
    if (unavoidable > 0) {
      note += fmt::format(
          "{} because a path along the lattice takes black and white points of the chessboard in turn and has two ends "
          "(without lifts)",
          unavoidable);
    }
    if (r.left_out > unavoidable) {
      note += fmt::format("{}{} because no path through them was found", unavoidable > 0 ? ", " : "",
                          r.left_out - unavoidable);
    }
    r.path.notes.push_back(note);
  }
  if (r.pieces > 1) {
    r.path.notes.push_back(
        fmt::format("the lattice points fall into {}; the tool is lifted between them", counted(r.pieces, "piece")));
  }
  if (r.lifts_in_pieces > 0) {
    r.path.notes.push_back(
        fmt::format("the tool is lifted in {}, because no single path through all of a piece was "
                    "found (narrow or "
                    "ragged places); a smaller pitch or a larger overrun may help",
                    counted(r.lifts_in_pieces, "more place")));
  }
}

}  // namespace

RandomOptions parse_random_options(const SpecText& spec) {
  spec.accept_only(lattice_keys({"seed"}));
  RandomOptions options;
  options.lattice = parse_lattice_options(spec);
  constexpr double kLargest = 9007199254740992.0;  // 2^53: every integer to there is a double
  const double seed = spec.number("seed", 1.0);
  if (!(seed >= 0.0 && seed <= kLargest) || seed != std::floor(seed)) {
    spec.reject("seed", "an integer from 0 to 2^53");
  }
  options.seed = static_cast<std::uint64_t>(seed);
  return options;
}

RandomPath random_path(const HeightMap& map, const RandomOptions& options, const Progress& progress) {
  const CellLattice lattice = cell_lattice(map, options.lattice, "random", progress);
  RandomNumbers dice(options.seed);
  const Cover cover = best_cover(lattice, dice, progress);
  RandomPath result;
  result.lattice_points = lattice.kept_cells;
  result.left_out = cover.left_out;
  result.must_leave_out = cover.must_leave_out;
  result.left_out_beside = left_out_beside(lattice, cover.links, progress);
  result.pieces = static_cast<Index>(cover.pieces.pieces.size());
  result.lifts_in_pieces = cover.lifts_in_pieces();
  result.path.kind = "random";
  Assembly(lattice, cover.links, result.path, progress).add_all(cover.chains);
  add_notes(result);
  return result;
}

}  // namespace dwell
