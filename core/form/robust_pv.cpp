#include "core/form/robust_pv.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/form/map_statistics.h"
#include "core/form/polynomial_fit.h"

namespace dwell {

namespace {

/// Whether the pixels with data lie on so few rows or columns that they do not determine 36 terms, however many.
bool is_line(const HeightMap& map) {
  constexpr Index kFewest = 6;
  std::vector<char> rows(static_cast<std::size_t>(map.grid.rows), 0), cols(static_cast<std::size_t>(map.grid.cols), 0);
  for (Index i = 0; i < map.grid.size(); ++i) {
    if (!std::isfinite(map.values[static_cast<std::size_t>(i)])) continue;
    rows[static_cast<std::size_t>(i / map.grid.cols)] = cols[static_cast<std::size_t>(i % map.grid.cols)] = 1;
  }
  const auto fewer = [](const std::vector<char>& lines) { return std::count(lines.begin(), lines.end(), 1) < kFewest; };
  return fewer(rows) || fewer(cols);
}

}  // namespace

std::optional<RobustPv> robust_pv(const HeightMap& map, int threads) {
  static const PolynomialSpec kFringe36 = parse_polynomial_spec("zernike-fringe:1-36");
  HeightMap residual = map;
  const PolynomialFit fit = remove_polynomials(residual, kFringe36, threads);
  if (map.valid_pixels() < static_cast<Index>(fit.terms.size()) || is_line(map)) return std::nullopt;
  RobustPv result;
  result.residual_rms = map_statistics(residual, {}, threads).rms_about_zero();
  for (std::size_t i = 0; i < map.values.size(); ++i) residual.values[i] = map.values[i] - residual.values[i];
  result.fit_pv = map_statistics(residual, {}, threads).pv;
  result.pvr = result.fit_pv + 3.0 * result.residual_rms;
  return result;
}

MapStatistics with_robust_pv(MapStatistics statistics, const HeightMap& map, int threads) {
  statistics.pvr.reset();
  if (const auto robust = robust_pv(map, threads)) statistics.pvr = robust->pvr;
  return statistics;
}

}  // namespace dwell
