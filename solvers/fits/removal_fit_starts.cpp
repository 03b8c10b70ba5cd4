#include "solvers/fits/removal_fit_starts.h"

#include <algorithm>
#include <cmath>

#include "core/base/numbers.h"
#include "core/tif/removal_function.h"

namespace dwell {
namespace {

/// Moments of the samples above a twentieth of the peak.
struct Moments {
  double peak = 0.0, fwhm = 0.0, edge = 0.0;  // edge: radius of the disc of the area above a twentieth of the peak
  Point centre, peak_at;
  double major = 0.0, minor = 0.0, angle = 0.0;  // FWHM of the Gaussian of these second moments; [deg]
};

Moments moments_of(const HeightMap& rates) {
  const RemovalFunction tif = measured_removal(rates, {TifCentre::Kind::Given, {}});
  const Grid& g = tif.samples.grid;
  Moments m;
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

std::vector<double> own_parameters(const RemovalModel& model) {
  std::vector<double> values;
  for (const ModelParameter& p : model.parameters) values.push_back(p.fallback.value_or(p.least + 1.0));
  return values;
}

}  // namespace

std::vector<std::vector<double>> removal_fit_starts(const HeightMap& rates, const RemovalModel& model) {
  const Moments m = moments_of(rates);
  std::vector<std::vector<double>> starts;
  const auto add = [&](Point at, const std::vector<double>& own) {
    std::vector<double> start{at.x, at.y, m.peak};
    start.insert(start.end(), own.begin(), own.end());
    starts.push_back(std::move(start));
  };
  if (model.name == "gaussian") {
    add(m.centre, {m.fwhm});
  } else if (model.name == "elliptic-gaussian") {
    add(m.centre, {m.major, m.minor, m.angle});
  } else if (model.name == "super-gaussian") {
    for (const double order : {2.0, 5.0}) add(m.centre, {m.fwhm, order});
  } else if (model.name == "disc") {
    for (const double share : {0.9, 1.0}) add(m.centre, {share * m.edge});
  } else if (model.name == "planetary") {
    for (const double e : {0.3, 0.8, 1.1, 2.0}) add(m.centre, {m.edge / (1.0 + e), e, -1.0});
  } else if (model.name == "mrf") {
    for (int k = 0; k < 4; ++k) {
      const double along = k % 2 == 0 ? m.major : m.minor, across = k % 2 == 0 ? m.minor : m.major;
      add(m.peak_at, {0.65 * along, 0.35 * along, across, m.angle + 90.0 * k});
    }
  } else {
    for (const double angle : {0.0, 90.0, 180.0, 270.0}) {
      for (const double precession : {6.0, 20.0}) {
        std::vector<double> own = own_parameters(model);
        own[0] = 1.05 * m.edge, own[2] = precession, own[5] = m.angle + angle;
        add(m.centre, own);
      }
    }
  }
  return starts;
}

}  // namespace dwell
