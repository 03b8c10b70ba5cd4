#include "runs/logs/path_tracker.h"

#include <algorithm>
#include <limits>

namespace dwell {

PathTracker::PathTracker(const std::vector<ProgramStep>& steps, std::size_t first, std::size_t end, double margin)
    : steps_(steps), first_(first), end_(end), step_(first), margin_(margin) {
  ways_.push_back(0.0);
  for (std::size_t i = first; i < end; ++i) ways_.push_back(ways_.back() + steps[i].length());
}

void PathTracker::follow(Point tool, double reach, double tolerance) {
  const double most = along_ + reach;
  double best = std::numeric_limits<double>::infinity(), best_way = along_;
  std::size_t best_step = step_;
  for (std::size_t i = step_; i < end_ && ways_[i - first_] <= most; ++i) {
    const Point from = steps_[i].start, direction = steps_[i].finish - from;
    const double begin = ways_[i - first_], whole = ways_[i - first_ + 1] - begin;
    const double least = std::max(0.0, along_ - begin), farthest = std::min(whole, most - begin);
    double at = whole > 0.0 ? dot(tool - from, direction) / whole : 0.0;
    at = std::clamp(at, std::min(least, farthest), farthest);
    const double off = distance(tool, whole > 0.0 ? from + (at / whole) * direction : from);
    if (!(off < best - (i == step_ ? 0.0 : margin_))) continue;
    best = off;
    best_way = begin + at;
    best_step = i;
  }
  off_ = best;
  if (!(best <= tolerance) && removes()) return;
  along_ = best_way;
  step_ = best_step;
}

}  // namespace dwell
