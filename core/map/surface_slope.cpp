#include "core/map/surface_slope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dwell {

SlopeStatistics slope_statistics(const HeightMap& map, int threads) {
  struct RowSums {
    double x = 0.0, y = 0.0;
    Index pairs_x = 0, pairs_y = 0;
  };
  const Grid& g = map.grid;
  std::vector<RowSums> rows(static_cast<std::size_t>(g.rows));
#pragma omp parallel for num_threads(std::max(threads, 1)) schedule(static)
  for (Index row = 0; row < g.rows; ++row) {
    RowSums sums;
    for (Index col = 0; col < g.cols; ++col) {
      const double z = map.at(row, col);
      const double dx = col + 1 < g.cols ? map.at(row, col + 1) - z : std::nan("");
      const double dy = row + 1 < g.rows ? map.at(row + 1, col) - z : std::nan("");
      if (std::isfinite(dx)) sums.x += dx * dx, ++sums.pairs_x;
      if (std::isfinite(dy)) sums.y += dy * dy, ++sums.pairs_y;
    }
    rows[static_cast<std::size_t>(row)] = sums;
  }
  SlopeStatistics s;
  for (const RowSums& row : rows) {
    s.x += row.x, s.y += row.y;
    s.pairs_x += row.pairs_x, s.pairs_y += row.pairs_y;
  }
  const auto rms = [](double sum, Index pairs, double pitch) {
    return pairs > 0 ? std::sqrt(sum / static_cast<double>(pairs)) / pitch : std::numeric_limits<double>::quiet_NaN();
  };
  s.x = rms(s.x, s.pairs_x, g.pitch_x);
  s.y = rms(s.y, s.pairs_y, g.pitch_y);
  s.total = s.pairs_y == 0 ? s.x : s.pairs_x == 0 ? s.y : std::hypot(s.x, s.y);
  return s;
}

}  // namespace dwell
