#include "paths/metrics/path_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/errors.h"
#include "core/base/numbers.h"
#include "core/base/poll.h"
#include "paths/domain/rounding.h"

namespace dwell {
namespace {

struct Interval {
  double low = kInfinity;
  double high = -kInfinity;

  void include(double from, double to) {
    if (!(from <= to)) return;
    low = std::min(low, from);
    high = std::max(high, to);
  }
};

/// Where |factor x + offset - middle| <= half; everything or nothing if factor is 0.
Interval strip(double factor, double offset, double middle, double half) {
  if (factor == 0.0) return std::abs(offset - middle) <= half ? Interval{-kInfinity, kInfinity} : Interval{};
  const double centre = (middle - offset) / factor, width = half / std::abs(factor);
  return {centre - width, centre + width};
}

/// The area within `reach` of a straight piece of path: two discs and the rectangle between them.
struct Capsule {
  Point from, to;
  double reach;

  /// Its section at height y: one interval, since it is convex.
  Interval section(double y) const {
    Interval result;
    for (const Point end : {from, to}) {
      const double half = std::sqrt(reach * reach - (y - end.y) * (y - end.y));  // NaN beyond the disc: not included
      result.include(end.x - half, end.x + half);
    }
    const double l = distance(from, to);
    if (!(l > 0.0)) return result;
    const Point u = (1.0 / l) * (to - from);
    const double h = y - from.y;
    const Interval along = strip(u.x, u.y * h, 0.5 * l, 0.5 * l), across = strip(-u.y, u.x * h, 0.0, reach);
    result.include(from.x + std::max(along.low, across.low), from.x + std::min(along.high, across.high));
    return result;
  }
};

/// Pixels of one axis whose centres lie in [low, high]: first > last if none.
struct Range {
  Index first, last;

  Range(double low, double high, double origin, double pitch, Index count)
      : first(static_cast<Index>(std::clamp(std::ceil((low - origin) / pitch), 0.0, static_cast<double>(count)))),
        last(
            static_cast<Index>(std::clamp(std::floor((high - origin) / pitch), -1.0, static_cast<double>(count - 1)))) {
  }
};

void cover(const Capsule& capsule, const Grid& grid, std::vector<char>& covered) {
  const double low = std::min(capsule.from.y, capsule.to.y), high = std::max(capsule.from.y, capsule.to.y);
  const Range rows(low - capsule.reach, high + capsule.reach, grid.origin.y, grid.pitch_y, grid.rows);
  for (Index row = rows.first; row <= rows.last; ++row) {
    const Interval section = capsule.section(grid.y(row));
    const Range cols(section.low, section.high, grid.origin.x, grid.pitch_x, grid.cols);
    if (cols.last < cols.first) continue;
    const auto begin = covered.begin() + grid.index(row, cols.first);
    std::fill(begin, begin + (cols.last - cols.first + 1), char{1});
  }
}

}  // namespace

PathCoverage path_coverage(const ToolPath& path, const HeightMap& map, double reach, const Progress& progress) {
  validate(path);
  if (!(reach >= 0.0 && reach < kInfinity)) {
    throw InputError(fmt::format("path coverage: reach = {} mm; required finite and >= 0", reach));
  }
  const std::vector<Index> pixels = finite_pixels(map);
  if (pixels.empty()) throw InputError("path coverage: the map has no finite pixel; at least one is required");
  const double padded = reach + kRounding * std::max(reach, std::min(map.grid.pitch_x, map.grid.pitch_y));
  std::vector<char> covered(map.values.size(), 0);
  Poll poll(progress, 1024);
  for (const Stroke& stroke : moving_strokes(path)) {
    poll.step();
    cover({stroke.start, stroke.via, padded}, map.grid, covered);
    if (!(stroke.via == stroke.finish)) cover({stroke.via, stroke.finish, padded}, map.grid, covered);
  }
  PathCoverage result;
  result.pixels = static_cast<Index>(pixels.size());
  for (const Index i : pixels) result.covered += covered[static_cast<std::size_t>(i)];
  return result;
}

}  // namespace dwell
