#pragma once

#include <algorithm>
#include <vector>

namespace dwell::bench {

struct Statistics {
  double median, fastest, slowest;
};

/// Of at least one value.
inline Statistics statistics(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return {0.5 * (v[(v.size() - 1) / 2] + v[v.size() / 2]), v.front(), v.back()};
}

}  // namespace dwell::bench
