#pragma once

namespace dwell {

/// The most dwell points a planner makes; more are refused before memory is taken for them.
inline constexpr double kMaxPathPoints = 50e6;

}  // namespace dwell
