#include "core/tif/footprint_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/tif/rate_rim.h"

namespace dwell {
namespace {

/// The first and the last place of the footprint on every line of one direction.
class LineSpans {
 public:
  explicit LineSpans(Index lines)
      : first_(static_cast<std::size_t>(lines), std::numeric_limits<Index>::max()),
        last_(static_cast<std::size_t>(lines), -1) {}
  void add(Index line, Index place) {
    auto &first = first_[static_cast<std::size_t>(line)], &last = last_[static_cast<std::size_t>(line)];
    first = std::min(first, place), last = std::max(last, place);
  }
  bool encloses(Index line, Index place) const {
    return first_[static_cast<std::size_t>(line)] < place && place < last_[static_cast<std::size_t>(line)];
  }

 private:
  std::vector<Index> first_, last_;
};

/// The four lines through a sample: row, column and diagonals.
struct Lines {
  const Grid& grid;
  std::array<LineSpans, 4> spans{LineSpans(grid.rows), LineSpans(grid.cols), LineSpans(grid.rows + grid.cols),
                                 LineSpans(grid.rows + grid.cols)};

  std::array<std::pair<Index, Index>, 4> through(Index i) const {
    const Index row = i / grid.cols, col = i % grid.cols;
    return {{{row, col}, {col, row}, {row + col, col}, {row - col + grid.cols, col}}};
  }
  void add(Index i) {
    const auto lines = through(i);
    for (std::size_t k = 0; k < spans.size(); ++k) spans[k].add(lines[k].first, lines[k].second);
  }
  int enclosing(Index i) const {
    const auto lines = through(i);
    int count = 0;
    for (std::size_t k = 0; k < spans.size(); ++k) count += spans[k].encloses(lines[k].first, lines[k].second) ? 1 : 0;
    return count;
  }
};

/// The largest finite rate of the eight neighbours; 0 if there is none above.
double largest_beside(const HeightMap& rates, Index i) {
  const Grid& g = rates.grid;
  const Index row = i / g.cols, col = i % g.cols;
  double largest = 0.0;
  for (Index r = std::max<Index>(row - 1, 0); r <= std::min(row + 1, g.rows - 1); ++r) {
    for (Index c = std::max<Index>(col - 1, 0); c <= std::min(col + 1, g.cols - 1); ++c) {
      if (rates.at(r, c) > largest) largest = rates.at(r, c);
    }
  }
  return largest;
}

/// The pixels without data that are joined by their sides to `start`, which are marked as seen.
std::vector<Index> hole_from(const HeightMap& rates, Index start, std::vector<char>& seen) {
  const Grid& g = rates.grid;
  std::vector<Index> hole{start};
  seen[static_cast<std::size_t>(start)] = 1;
  for (std::size_t k = 0; k < hole.size(); ++k) {
    const Index row = hole[k] / g.cols, col = hole[k] % g.cols;
    const auto take = [&](Index r, Index c) {
      if (r < 0 || c < 0 || r >= g.rows || c >= g.cols) return;
      const auto i = static_cast<std::size_t>(g.index(r, c));
      if (seen[i] != 0 || std::isfinite(rates.values[i])) return;
      seen[i] = 1;
      hole.push_back(g.index(r, c));
    };
    take(row - 1, col), take(row + 1, col), take(row, col - 1), take(row, col + 1);
  }
  return hole;
}

void count_gap(const HeightMap& rates, Index i, bool open, FootprintGaps& gaps) {
  const double beside = largest_beside(rates, i);
  if (gaps.samples == 0 || beside > gaps.beside) {
    gaps.row = i / rates.grid.cols, gaps.col = i % rates.grid.cols, gaps.beside = beside;
  }
  ++gaps.samples;
  gaps.open = gaps.open || open;
}

}  // namespace

FootprintGaps footprint_gaps(const HeightMap& rates, double level) {
  Lines lines{rates.grid};
  for (Index i = 0; i < rates.grid.size(); ++i) {
    if (rates.values[static_cast<std::size_t>(i)] > level) lines.add(i);
  }
  constexpr int kEnclosing = 3;
  FootprintGaps gaps;
  const std::vector<char> outside = outside_data(rates);
  std::vector<char> seen(outside.begin(), outside.end());
  for (Index i = 0; i < rates.grid.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (outside[at] != 0 && lines.enclosing(i) >= kEnclosing) count_gap(rates, i, true, gaps);
    if (seen[at] != 0 || std::isfinite(rates.values[at])) continue;
    const std::vector<Index> hole = hole_from(rates, i, seen);
    const bool beside =
        std::any_of(hole.begin(), hole.end(), [&](Index k) { return largest_beside(rates, k) > level; });
    if (!beside) continue;
    for (const Index k : hole) count_gap(rates, k, false, gaps);
  }
  return gaps;
}

}  // namespace dwell
