#pragma once

/// The one unit system inside: lateral mm, height nm, time s, removal rate nm/s, speed mm/s.
/// Readers and writers convert; nothing else does.
namespace dwell::units {

inline constexpr double kNmPerUm = 1e3;
inline constexpr double kNmPerMm = 1e6;
inline constexpr double kNmPerM = 1e9;
inline constexpr double kMmPerM = 1e3;
inline constexpr double kMmPerInch = 25.4;  // exact
inline constexpr double kSecondsPerMinute = 60.0;

inline constexpr double mm_per_s(double mm_per_min) { return mm_per_min / kSecondsPerMinute; }
inline constexpr double mm_per_min(double mm_per_s) { return mm_per_s * kSecondsPerMinute; }

}  // namespace dwell::units
