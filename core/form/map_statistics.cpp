#include "core/form/map_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.h"
#include "core/form/form_polynomials.h"

namespace dwell {
MapStatistics map_statistics(const HeightMap& map, const FormTerms& terms, int threads) {
  if (terms.any()) return map_statistics(without_form(map, terms, threads), {}, threads);
  struct RowSums {
    Index count = 0;
    double low = std::numeric_limits<double>::infinity(), high = -low, square = 0.0;
  };
  std::vector<RowSums> rows(static_cast<std::size_t>(map.grid.rows));
  [[maybe_unused]] const int count = std::max(threads, 1);
#pragma omp parallel for num_threads(count) schedule(static)
  for (Index row = 0; row < map.grid.rows; ++row) {
    RowSums sums;
    for (Index col = 0; col < map.grid.cols; ++col) {
      const double v = map.at(row, col);
      if (!std::isfinite(v)) continue;
      ++sums.count;
      sums.low = std::min(sums.low, v), sums.high = std::max(sums.high, v), sums.square += v * v;
    }
    rows[static_cast<std::size_t>(row)] = sums;
  }
  RowSums all;
  for (const RowSums& row : rows) {
    all.count += row.count;
    all.low = std::min(all.low, row.low), all.high = std::max(all.high, row.high), all.square += row.square;
  }
  if (all.count == 0) throw InputError("map has no finite pixel; PV and RMS need at least one");
  return {all.count, all.high - all.low, std::sqrt(all.square / static_cast<double>(all.count))};
}

HeightMap without_form(const HeightMap& map, const FormTerms& terms, int threads) {
  HeightMap result = map;
  if (!terms.any()) return result;
  const std::vector<Index> pixels = finite_pixels(map);
  FormPolynomials(map.grid, pixels, terms, {}, threads).remove_from(result.values);
  return result;
}

}  // namespace dwell
