#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/map/height_map.h"

namespace dwell::test {

struct Spread {
  double pv = 0.0, deviation = 0.0;  // population standard deviation
};

/// Of the finite pixels, by plain loops.
inline Spread spread_of(const HeightMap& map) {
  double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0.0, squares = 0.0, count = 0.0;
  for (const double v : map.values) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
    sum += v;
    count += 1.0;
  }
  for (const double v : map.values) {
    if (std::isfinite(v)) squares += (v - sum / count) * (v - sum / count);
  }
  return {high - low, std::sqrt(squares / count)};
}

}  // namespace dwell::test
