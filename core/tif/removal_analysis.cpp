#include "core/tif/removal_analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/numerics/spline_surface.h"
#include "core/tif/removal_function.h"

namespace dwell {
namespace {

void find_moments(const HeightMap& rates, RemovalAnalysis& a) {
  const Grid& g = rates.grid;
  double sum = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  Point moment;
  for (Index i = 0; i < g.size(); ++i) {
    const double v = rates.values[static_cast<std::size_t>(i)];
    sum += v;
    moment = moment + v * g.centre(i);
    if (v > a.peak || i == 0) a.peak = v, a.peak_at = g.centre(i);
  }
  a.centroid = (1.0 / sum) * moment;
  for (Index i = 0; i < g.size(); ++i) {
    const Point d = g.centre(i) - a.centroid;
    const double v = rates.values[static_cast<std::size_t>(i)] / sum;
    xx += v * d.x * d.x, xy += v * d.x * d.y, yy += v * d.y * d.y;
  }
  const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
  a.sigma_major = std::sqrt(std::max(0.0, mean + half));
  a.sigma_minor = std::sqrt(std::max(0.0, mean - half));
  a.angle = 0.5 * std::atan2(2.0 * xy, xx - yy) * 180.0 / std::numbers::pi;
}

/// Distance between the outermost places at half the peak on a line through the centroid.
double width(const SplineSurface& surface, const RemovalAnalysis& a, Point way, double reach) {
  constexpr int kSteps = 4000;
  double first = 0.0, last = 0.0, before = 0.0;
  bool any = false;
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double step = reach / kSteps, t = step * k;
    const double above = surface(a.centroid + t * way) - 0.5 * a.peak;
    if (k > -kSteps && (above >= 0.0) != (before >= 0.0)) {
      const double at = t - step * above / (above - before);
      if (!any) first = at;
      last = at;
      any = true;
    }
    before = above;
  }
  return any ? last - first : 0.0;
}

double radius_of_share(const HeightMap& rates, Point centre, double share) {
  std::vector<std::pair<double, double>> by_radius;
  double sum = 0.0;
  for (Index i = 0; i < rates.grid.size(); ++i) {
    const double v = rates.values[static_cast<std::size_t>(i)];
    if (v == 0.0) continue;
    by_radius.emplace_back(distance(rates.grid.centre(i), centre), v);
    sum += v;
  }
  std::sort(by_radius.begin(), by_radius.end());
  double within = 0.0;
  for (const auto& [radius, v] : by_radius) {
    within += v;
    if (within >= share * sum) return radius;
  }
  return 0.0;
}

double asymmetry_of(const HeightMap& rates, const SplineSurface& surface, Point centre) {
  constexpr int kDirections = 180;
  const Grid& g = rates.grid;
  const double step = 0.5 * std::min(g.pitch_x, g.pitch_y);
  std::vector<double> mean;  // over all directions, at radii `step` apart
  const double farthest = std::hypot(g.width(), g.height());
  for (double r = 0.0; r <= farthest + step; r += step) {
    double sum = 0.0;
    for (int k = 0; k < kDirections; ++k) {
      const double phi = 2.0 * std::numbers::pi * k / kDirections;
      sum += surface(centre + Point{r * std::cos(phi), r * std::sin(phi)});
    }
    mean.push_back(sum / kDirections);
  }
  double odd = 0.0, all = 0.0;
  for (Index i = 0; i < g.size(); ++i) {
    const double place = distance(g.centre(i), centre) / step;
    const std::size_t k = std::min(static_cast<std::size_t>(place), mean.size() - 2);
    const double round = mean[k] + (place - static_cast<double>(k)) * (mean[k + 1] - mean[k]);
    const double v = rates.values[static_cast<std::size_t>(i)];
    odd += (v - round) * (v - round), all += v * v;
  }
  return std::sqrt(odd / all);
}

}  // namespace

RemovalAnalysis analyse_shape(const HeightMap& given) {
  // Checks the samples, and takes missing ones as zero.
  const RemovalFunction tif = measured_removal(given, {TifCentre::Kind::Given, {}});
  const HeightMap& rates = tif.samples;
  RemovalAnalysis a;
  find_moments(rates, a);
  a.volume = tif.volume;
  a.fwhm = tif.fwhm;
  const SplineSurface surface(rates.grid, rates.values);
  const double reach = std::max(rates.grid.width(), rates.grid.height());
  a.fwhm_x = width(surface, a, {1.0, 0.0}, reach);
  a.fwhm_y = width(surface, a, {0.0, 1.0}, reach);
  a.radius = radius_of_share(rates, a.centroid, 0.99);
  a.asymmetry = asymmetry_of(rates, surface, a.centroid);
  return a;
}

RemovalAnalysis analyse_removal(const HeightMap& rates, int threads) {
  RemovalAnalysis a = analyse_shape(rates);
  a.transfer = transfer_function(measured_removal(rates, {TifCentre::Kind::Given, {}}).samples, threads);
  const auto waves = [&](double share) {
    const TransferFunction& t = a.transfer;
    return RemovalAnalysis::Waves{shortest_wave(t.frequency, t.along_x, share),
                                  shortest_wave(t.frequency, t.along_y, share),
                                  shortest_wave(t.frequency, t.radial, share)};
  };
  a.at_half = waves(0.5);
  a.at_tenth = waves(0.1);
  return a;
}

RemovalAnalysis with_exact_figures(RemovalAnalysis analysis, const RemovalFunction& tif) {
  const bool disc = tif.kind == RemovalFunction::Kind::Disc;
  if (!disc && tif.kind != RemovalFunction::Kind::Gaussian) return analysis;
  const double cut = 2.0 * tif.radius;  // which may be within the half peak of a Gaussian
  analysis.peak = tif.peak;
  analysis.volume = tif.volume;
  analysis.fwhm = std::min(tif.fwhm, cut);
  analysis.fwhm_x = analysis.fwhm_y = disc ? cut : analysis.fwhm;
  analysis.centroid = {};
  analysis.asymmetry = 0.0;
  return analysis;
}

}  // namespace dwell
