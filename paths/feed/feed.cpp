#include "paths/feed/feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"

namespace dwell {
namespace {

constexpr double kAtBound = 1e-9;  // relative to the bound

void check(const FeedLimits& limits) {
  if (!(std::isfinite(limits.min_dwell) && limits.min_dwell >= 0.0)) {
    throw InputError(fmt::format("feed: min_dwell = {} s; required finite and >= 0", limits.min_dwell));
  }
  if (!(limits.max_feed > 0.0)) {
    throw InputError(fmt::format("feed: max_feed = {} mm/s; required > 0", limits.max_feed));
  }
}

void check(const std::vector<Stroke>& strokes, const Eigen::VectorXd& dwell) {
  if (static_cast<std::size_t>(dwell.size()) != strokes.size()) {
    throw InputError(fmt::format("feed: {} for {} strokes; one a stroke required", counted(dwell.size(), "dwell time"),
                                 strokes.size()));
  }
  for (Index j = 0; j < dwell.size(); ++j) {
    if (!(std::isfinite(dwell[j]) && dwell[j] >= 0.0)) {
      throw InputError(fmt::format("feed: dwell of stroke {} = {} s; required finite and >= 0", j + 1, dwell[j]));
    }
  }
}

}  // namespace

Eigen::VectorXd minimum_dwell(const std::vector<Stroke>& strokes, const FeedLimits& limits) {
  check(limits);
  Eigen::VectorXd bound(static_cast<Index>(strokes.size()));
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    bound[static_cast<Index>(j)] = std::max(limits.min_dwell, strokes[j].length() / limits.max_feed);
  }
  return bound;
}

FeedSchedule feed_schedule(const std::vector<Stroke>& strokes, const Eigen::VectorXd& dwell, const FeedLimits& limits) {
  const Eigen::VectorXd bound = minimum_dwell(strokes, limits);
  check(strokes, dwell);
  FeedSchedule schedule;
  schedule.speed.reserve(strokes.size());
  double slowest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    const double length = strokes[j].length();
    const double t = dwell[static_cast<Index>(j)], least = bound[static_cast<Index>(j)];
    const bool moves = length > 0.0;
    schedule.speed.push_back(moves ? length / t : 0.0);
    if (moves) {
      slowest = std::min(slowest, schedule.speed.back());
      schedule.max_speed = std::max(schedule.max_speed, schedule.speed.back());
      schedule.min_speed = slowest;
    }
    if (t < least * (1.0 - kAtBound) || !std::isfinite(schedule.speed.back())) {
      ++schedule.segments_infeasible;
    } else if (least > 0.0 && t <= least * (1.0 + kAtBound)) {
      ++schedule.segments_limited;
    }
  }
  return schedule;
}

}  // namespace dwell
