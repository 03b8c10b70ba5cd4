#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dwell {

/// The value below which a share (0 to 1) of the sorted values lies, between two of them by proportion: the first for
/// 0, the last for 1. At least one value, ascending.
inline double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

}  // namespace dwell
