#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "core/base/grid.h"

namespace dwell {

/// g[q] = min over p of f[p] + (pitch (q - p))^2, entries of f possibly infinite (but not all), and the p that gives
/// it: the lower envelope of parabolas of Felzenszwalb and Huttenlocher 2012, "Distance transforms of sampled
/// functions", section 2. Cost O(n). Keeps its buffers between calls.
class LowerEnvelope {
 public:
  LowerEnvelope(Index n, double pitch)
      : pitch2_(pitch * pitch), apex_(static_cast<std::size_t>(n)), from_(static_cast<std::size_t>(n)) {}

  /// Calls visit(q, g[q], p) for every q in order.
  template <class Visit>
  void operator()(const std::vector<double>& f, const Visit& visit) {
    std::size_t count = 0;
    for (std::size_t q = 0; q < f.size(); ++q) {
      if (!std::isfinite(f[q])) continue;
      while (count > 0 && crossing(f, apex_[count - 1], q) <= from_[count - 1]) --count;
      from_[count] = count == 0 ? -std::numeric_limits<double>::infinity() : crossing(f, apex_[count - 1], q);
      apex_[count++] = q;
    }
    std::size_t k = 0;
    for (std::size_t q = 0; q < f.size(); ++q) {
      while (k + 1 < count && from_[k + 1] < static_cast<double>(q)) ++k;
      const double steps = static_cast<double>(q) - static_cast<double>(apex_[k]);
      visit(q, f[apex_[k]] + pitch2_ * steps * steps, apex_[k]);
    }
  }

 private:
  /// Where the parabola of `right` falls below that of `left` [nodes].
  double crossing(const std::vector<double>& f, std::size_t left, std::size_t right) const {
    const auto l = static_cast<double>(left), r = static_cast<double>(right);
    return 0.5 * (l + r) + (f[right] - f[left]) / (2.0 * pitch2_ * (r - l));
  }

  double pitch2_;
  std::vector<std::size_t> apex_;  // parabolas of the envelope, left to right
  std::vector<double> from_;       // where each begins
};

}  // namespace dwell
