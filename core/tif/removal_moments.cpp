#include "core/tif/removal_moments.h"

#include <algorithm>
#include <cmath>

#include "core/tif/removal_function.h"

namespace dwell {

RemovalMoments removal_moments(const HeightMap& rates) {
  constexpr double kPi = 3.14159265358979323846;
  const RemovalFunction tif = measured_removal(rates, {TifCentre::Kind::Given, {}});
  const Grid& g = tif.samples.grid;
  RemovalMoments m;
  m.peak = tif.peak;
  m.fwhm = tif.fwhm;
  double sum = 0.0, area = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  const auto each = [&](auto&& visit) {
    for (Index i = 0; i < g.size(); ++i) {
      const double v = tif.samples.values[static_cast<std::size_t>(i)] - 0.05 * tif.peak;
      if (v > 0.0) visit(g.centre(i), v);
    }
  };
  each([&](Point p, double v) {
    sum += v, area += g.pitch_x * g.pitch_y, m.centre = m.centre + v * p;
    if (v >= 0.95 * tif.peak * (1.0 - 1e-12)) m.peak_at = p;
  });
  m.centre = (1.0 / sum) * m.centre;
  m.edge = std::sqrt(area / kPi);
  each([&](Point p, double v) {
    const Point d = p - m.centre;
    xx += v * d.x * d.x / sum, xy += v * d.x * d.y / sum, yy += v * d.y * d.y / sum;
  });
  const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
  constexpr double kFwhmPerSigma = 2.3548200450309493;
  m.major = kFwhmPerSigma * std::sqrt(std::max(mean + half, 1e-6 * mean));
  m.minor = kFwhmPerSigma * std::sqrt(std::max(mean - half, 1e-3 * mean));
  m.angle = 0.5 * std::atan2(2.0 * xy, xx - yy) * 180.0 / kPi;
  return m;
}

}  // namespace dwell
