#include "paths/metrics/path_spacing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/numbers.h"
#include "core/base/poll.h"
#include "paths/domain/point_limit.h"
#include "paths/domain/point_tree.h"
#include "paths/domain/rounding.h"

namespace dwell {
namespace {

constexpr auto kMaxPoints = static_cast<std::size_t>(kMaxPathPoints);

/// Where a point stands on the path.
struct Station {
  Index piece = 0;
  double along = 0.0;  // length of path before it [mm]
};

std::vector<Station> stations(const ToolPath& path) {
  std::vector<Station> result(path.size());
  for (std::size_t j = 1; j < path.size(); ++j) {
    result[j] = {result[j - 1].piece + (path.lifted[j] ? 1 : 0),
                 result[j - 1].along + distance(path.points[j - 1], path.points[j])};
  }
  return result;
}

void check(const ToolPath& path, const SpacingOptions& options) {
  validate(path);
  if (path.size() > kMaxPoints) {
    throw InputError(fmt::format("path spacing: {}; at most {} accepted", counted(path.size(), "point"), kMaxPoints));
  }
  if (options.skip < 1) throw InputError(fmt::format("path spacing: skip = {}; required >= 1", options.skip));
  if (!(options.detour >= 1.0 && options.detour < kInfinity)) {
    throw InputError(fmt::format("path spacing: detour = {}; required finite and >= 1", options.detour));
  }
  if (!(options.reach > 0.0)) {
    throw InputError(fmt::format("path spacing: reach = {} mm; required > 0", options.reach));
  }
}

}  // namespace

PathSpacing path_spacing(const ToolPath& path, const SpacingOptions& options, const Progress& progress) {
  check(path, options);
  progress.check();
  const std::vector<Station> station = stations(path);
  const PointTree tree(path.points, progress);
  PathSpacing spacing;
  spacing.min = kInfinity;
  double sum = 0.0, squares = 0.0, reference = 0.0;
  Poll poll(progress, 1024);
  for (std::size_t i = 0; i < path.size(); ++i) {
    poll.step();
    double nearest2 = kInfinity, reach2 = options.reach * options.reach;
    const auto take = [&](std::int32_t member) {
      const auto j = static_cast<std::size_t>(member);
      const double d2 = squared_distance(path.points[i], path.points[j]);
      if (!(d2 < nearest2 && d2 <= reach2)) return;
      if (std::abs(static_cast<Index>(i) - static_cast<Index>(j)) <= options.skip) return;
      const double detour = options.detour * std::sqrt(d2) * (1.0 - kRounding);
      if (station[i].piece == station[j].piece && !(std::abs(station[i].along - station[j].along) >= detour)) return;
      nearest2 = d2;
      reach2 = std::nextafter(d2, -kInfinity);  // points at the same distance are not searched for
    };
    tree.search(
        path.points[i], reach2, [](std::size_t) { return false; }, take);
    if (nearest2 == kInfinity) {
      ++spacing.alone;
      continue;
    }
    const double nearest = std::sqrt(nearest2);
    if (spacing.points++ == 0) reference = nearest;  // so that the squares do not cancel
    sum += nearest - reference;
    squares += (nearest - reference) * (nearest - reference);
    spacing.min = std::min(spacing.min, nearest);
    spacing.max = std::max(spacing.max, nearest);
  }
  if (spacing.points == 0) {
    spacing.min = 0.0;
    return spacing;
  }
  const double count = static_cast<double>(spacing.points);
  spacing.mean = reference + sum / count;
  spacing.deviation = std::sqrt(std::max(0.0, squares / count - (sum / count) * (sum / count)));
  return spacing;
}

}  // namespace dwell
