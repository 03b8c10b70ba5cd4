#pragma once

#include <array>
#include <vector>

#include "paths/feed/machine.h"
#include "paths/feed/motion_nodes.h"

namespace dwell {

/// What keeps a machine from being faster in a stretch of its motion.
enum class BindingLimit {
  None,          // nothing: it runs at the feed that is commanded, or halts as commanded
  Speed,         // it runs as fast as path or axes allow
  Acceleration,  // it changes its speed as fast as path or axes allow
  Rest,          // it rests at a corner
  Jerk,          // it changes its acceleration as fast as path or axes allow
};
inline constexpr std::size_t kBindingLimits = 5;

/// Of every stretch of a motion at work, from nodes[k] to nodes[k + 1], the limit that binds there; lifted ones have
/// None. `machine` lies as the program does (machine_on); `max_feed`: of the program [mm/s]. Speeds count as at their
/// limit from 0.998 of it on, accelerations from 0.98: schedules of speeds keep within it by as much. Cost O(nodes).
std::vector<BindingLimit> binding_limits(const std::vector<MotionNode>& nodes, const Machine& machine, double max_feed);

/// The time at work in which each limit binds [s], by its number.
std::array<double, kBindingLimits> time_at_limits(const std::vector<MotionNode>& nodes,
                                                  const std::vector<BindingLimit>& limits);

}  // namespace dwell
