// Constants that many files use.
#pragma once

#include <limits>
#include <numbers>

namespace dwell {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace dwell
