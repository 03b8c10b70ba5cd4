#pragma once

namespace dwell {

/// The most dwell points of a path, and of whatever else grows with them (cells, points of a track); more are refused
/// before memory is taken for them.
inline constexpr double kMaxPathPoints = 50e6;

}  // namespace dwell
