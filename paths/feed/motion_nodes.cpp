#include "paths/feed/motion_nodes.h"

#include <cmath>
#include <utility>

namespace dwell {
namespace {

constexpr double kNodeRounding = 1e-9;  // of places [mm] and speeds [mm/s] that are computed twice

/// Whether a stretch that begins so goes on where the last one ended.
bool goes_on(const MotionNode& last, Point from, double speed_in) {
  return distance(last.place, from) <= kNodeRounding &&
         std::abs(last.speed - speed_in) <= kNodeRounding * (1.0 + speed_in);
}

}  // namespace

void MotionNodes::run(Point from, Point to, double speed_in, double speed_out, double seconds, bool removes) {
  const double now = nodes_.empty() ? 0.0 : nodes_.back().seconds;
  if (nodes_.empty() || !goes_on(nodes_.back(), from, speed_in)) nodes_.push_back({now, from, speed_in, removes});
  nodes_.push_back({now + seconds, to, speed_out, removes});
}

std::vector<MotionNode> MotionNodes::take() { return std::move(nodes_); }

}  // namespace dwell
