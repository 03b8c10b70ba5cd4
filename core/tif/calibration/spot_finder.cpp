#include "core/tif/calibration/spot_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/map/robust_plane.h"

namespace dwell {
namespace {

constexpr double kShare = 0.3;        // of the deepest: what belongs to a spot
constexpr double kScatters = 4.0;     // of the surroundings, at least
constexpr double kClear = 8.0;        // scatters that the deepest place must have
constexpr double kLeastVolume = 0.1;  // of the largest spot

struct Region {
  double volume = 0.0;
  Point moment;
  std::vector<Index> pixels;

  Point centre() const { return (1.0 / volume) * moment; }
  double extent(const Grid& grid) const {
    double farthest = 0.0;
    for (const Index i : pixels) farthest = std::max(farthest, distance(grid.centre(i), centre()));
    return farthest;
  }
};

/// The map less its plane, each pixel the mean of the finite ones of 3 x 3.
HeightMap smooth_depth(const HeightMap& depth, const Plane& plane) {
  const Grid& g = depth.grid;
  HeightMap result(g);
  for (Index r = 0; r < g.rows; ++r) {
    for (Index c = 0; c < g.cols; ++c) {
      if (!std::isfinite(depth.at(r, c))) continue;
      double sum = 0.0;
      int count = 0;
      for (Index i = std::max<Index>(r - 1, 0); i <= std::min(r + 1, g.rows - 1); ++i) {
        for (Index j = std::max<Index>(c - 1, 0); j <= std::min(c + 1, g.cols - 1); ++j) {
          if (!std::isfinite(depth.at(i, j))) continue;
          sum += depth.at(i, j) - plane.at(g.centre(i, j));
          ++count;
        }
      }
      result.at(r, c) = sum / count;
    }
  }
  return result;
}

Region grow(const HeightMap& depth, Index seed, double threshold, std::vector<char>& seen) {
  const Grid& g = depth.grid;
  Region region;
  std::vector<Index> open{seed};
  seen[static_cast<std::size_t>(seed)] = 1;
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    const double v = depth.values[static_cast<std::size_t>(i)];
    region.volume += v;
    region.moment = region.moment + v * g.centre(i);
    region.pixels.push_back(i);
    const Index row = i / g.cols, col = i % g.cols;
    for (Index r = std::max<Index>(row - 1, 0); r <= std::min(row + 1, g.rows - 1); ++r) {
      for (Index c = std::max<Index>(col - 1, 0); c <= std::min(col + 1, g.cols - 1); ++c) {
        const Index next = g.index(r, c);
        if (seen[static_cast<std::size_t>(next)] || !(depth.at(r, c) >= threshold)) continue;
        seen[static_cast<std::size_t>(next)] = 1;
        open.push_back(next);
      }
    }
  }
  return region;
}

/// Joins regions that lie closer to each other than the larger of their extents.
void join_parts(std::vector<Region>& regions, const Grid& grid) {
  for (std::size_t a = 0; a < regions.size(); ++a) {
    for (std::size_t b = a + 1; b < regions.size();) {
      const double reach = regions[a].extent(grid) + regions[b].extent(grid);
      if (distance(regions[a].centre(), regions[b].centre()) > reach) {
        ++b;
        continue;
      }
      regions[a].volume += regions[b].volume;
      regions[a].moment = regions[a].moment + regions[b].moment;
      regions[a].pixels.insert(regions[a].pixels.end(), regions[b].pixels.begin(), regions[b].pixels.end());
      regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(b));
      b = a + 1;
    }
  }
}

}  // namespace

void refuse_rise(double rise, double fall) {
  throw InputError(fmt::format(
      "the surface stands {:.4g} nm higher after than before, and went down by only {:.4g} nm: no removal; are "
      "`spot` (after) and `before` swapped, or is the sign of the heights the other one?",
      rise, fall));
}

std::vector<FoundSpot> find_spots(const HeightMap& depth) {
  const std::vector<Index> pixels = finite_pixels(depth);
  if (pixels.size() < 25) {
    throw InputError(
        fmt::format("{} with data; at least 25 are required to find a spot", counted(pixels.size(), "pixel")));
  }
  const HeightMap smooth = smooth_depth(depth, robust_plane(depth, pixels, true));
  const double scatter = robust_plane(smooth, pixels, false).scatter;
  double deepest = 0.0, highest = 0.0;
  for (const Index i : pixels) {
    deepest = std::max(deepest, smooth.values[static_cast<std::size_t>(i)]);
    highest = std::max(highest, -smooth.values[static_cast<std::size_t>(i)]);
  }
  if (highest > 2.0 * deepest && highest > kClear * scatter) refuse_rise(highest, deepest);
  if (!(deepest > kClear * scatter)) {
    throw InputError(
        fmt::format("no spot found: the deepest place is {:.4g} nm, the scatter of the map {:.4g} nm; a spot "
                    "stands out by {:g} times the scatter (or give `at` and `radius`)",
                    deepest, scatter, kClear));
  }
  const double threshold = std::max(kShare * deepest, kScatters * scatter);
  std::vector<char> seen(smooth.values.size(), 0);
  std::vector<Region> regions;
  for (const Index i : pixels) {
    if (seen[static_cast<std::size_t>(i)] || !(smooth.values[static_cast<std::size_t>(i)] >= threshold)) continue;
    regions.push_back(grow(smooth, i, threshold, seen));
  }
  double largest = 0.0;
  for (const Region& r : regions) largest = std::max(largest, r.volume);
  std::erase_if(regions, [&](const Region& r) { return r.volume < 1e-3 * largest; });
  join_parts(regions, depth.grid);
  for (const Region& r : regions) largest = std::max(largest, r.volume);
  std::vector<FoundSpot> spots;
  for (const Region& r : regions) {
    if (r.volume >= kLeastVolume * largest) spots.push_back({r.centre(), r.extent(depth.grid)});
  }
  std::sort(spots.begin(), spots.end(), [](const FoundSpot& a, const FoundSpot& b) {
    return a.centre.y != b.centre.y ? a.centre.y > b.centre.y : a.centre.x < b.centre.x;
  });
  return spots;
}

}  // namespace dwell
