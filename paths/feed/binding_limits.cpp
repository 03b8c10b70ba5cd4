#include "paths/feed/binding_limits.h"

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

constexpr double kAtSpeed = 0.998, kAtAcceleration = 0.98;
constexpr double kSpeedRounding = 1e-6;  // relative change that is rounding

BindingLimit limit_of(const MotionNode& from, const MotionNode& to, const Machine& machine, double max_feed) {
  const double seconds = to.seconds - from.seconds;
  if (!to.removes || !(seconds > 0.0)) return BindingLimit::None;
  const Point way = to.place - from.place;
  if (!(length(way) > 0.0)) {
    const bool at_corner =
        machine.corner_delay > 0.0 && std::abs(seconds / machine.corner_delay - 1.0) <= kSpeedRounding;
    return at_corner ? BindingLimit::Rest : BindingLimit::None;
  }
  const double fastest = std::max(from.speed, to.speed), change = std::abs(to.speed - from.speed);
  if (change > kSpeedRounding * fastest) {
    const bool at_limit = change >= kAtAcceleration * seconds * acceleration_limit(machine, way);
    if (at_limit) return BindingLimit::Acceleration;
    return limits_jerk(machine) ? BindingLimit::Jerk : BindingLimit::None;
  }
  return fastest >= kAtSpeed * std::min(speed_limit(machine, way), max_feed) ? BindingLimit::Speed : BindingLimit::None;
}

}  // namespace

std::vector<BindingLimit> binding_limits(const std::vector<MotionNode>& nodes, const Machine& machine,
                                         double max_feed) {
  std::vector<BindingLimit> limits;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    limits.push_back(limit_of(nodes[k], nodes[k + 1], machine, max_feed));
  return limits;
}

std::array<double, kBindingLimits> time_at_limits(const std::vector<MotionNode>& nodes,
                                                  const std::vector<BindingLimit>& limits) {
  std::array<double, kBindingLimits> seconds{};
  for (std::size_t k = 0; k < limits.size(); ++k) {
    if (nodes[k + 1].removes) seconds[static_cast<std::size_t>(limits[k])] += nodes[k + 1].seconds - nodes[k].seconds;
  }
  return seconds;
}

}  // namespace dwell
