#include "core/numerics/lattice_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/number_text.h"

namespace dwell {
namespace {

constexpr double kSameStep = 0.25;  // steps within this fraction of a pitch are taken as one pitch

constexpr double kMostSteps = 1e15;  // far above any map; keeps absurd coordinates within an Index

/// Sorted, with coordinates that differ only by rounding (single precision, sums of steps) taken as one.
void make_distinct(std::vector<double>& v) {
  // Runs of equal values, as rows have them, go first, so that less is left to sort.
  v.erase(std::unique(v.begin(), v.end()), v.end());
  std::sort(v.begin(), v.end());
  // The middle half of the coordinates shows the size of the part; without that, one stray point far away would merge
  // all the others into one.
  const double low = v[v.size() / 4], high = v[v.size() - 1 - v.size() / 4];
  const double rounding = 2e-6 * (high - low) + 1e-7 * std::max(std::abs(low), std::abs(high));
  v.erase(std::unique(v.begin(), v.end(), [&](double a, double b) { return b - a <= rounding; }), v.end());
}

bool same_step(double step, double pitch) { return std::abs(step - pitch) <= kSameStep * pitch; }

/// Mean of the steps that are about `pitch`: in coordinates printed with few digits, a single step is inexact.
double mean_step(const std::vector<double>& steps, double pitch) {
  double sum = 0.0;
  double count = 0.0;
  for (const double step : steps) {
    if (same_step(step, pitch)) sum += step, count += 1.0;
  }
  return count > 0.0 ? sum / count : pitch;
}

/// The pitch with the digits a person wrote: 0.1 rather than 0.09999999999999998.
double written(double pitch) { return finite_number(fmt::format("{:.12g}", pitch)).value_or(pitch); }

/// Numbers the coordinates by walking from neighbour to neighbour, so that an error of the pitch does not add up, and
/// without stepping onto strays; then least squares over those on the lattice.
LatticeFit fit_with(const std::vector<double>& v, double pitch) {
  std::size_t anchor = 0;
  while (anchor + 2 < v.size() && !same_step(v[anchor + 1] - v[anchor], pitch)) ++anchor;
  const double base = v[anchor];
  double last = base, last_index = 0.0, first_index = 0.0, max_index = 0.0;
  double n = 0.0, sum_k = 0.0, sum_v = 0.0, sum_kk = 0.0, sum_kv = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double from = i < anchor ? base : last;
    const double steps = (v[i] - from) / pitch;
    const double k = (i < anchor ? 0.0 : last_index) + std::round(steps);
    first_index = std::min(first_index, k);
    max_index = std::max(max_index, k);
    if (!(std::abs(steps - std::round(steps)) <= kSameStep)) continue;
    if (i >= anchor) last = v[i], last_index = k;
    const double u = v[i] - base;
    n += 1.0, sum_k += k, sum_v += u, sum_kk += k * k, sum_kv += k * u;
  }
  const double spread = n * sum_kk - sum_k * sum_k;
  const double slope = spread > 0.0 ? (n * sum_kv - sum_k * sum_v) / spread : pitch;
  LatticeFit fit;
  fit.lattice.pitch = written(slope > 0.0 ? slope : pitch);
  fit.lattice.origin = base + (sum_v - fit.lattice.pitch * sum_k) / n + first_index * fit.lattice.pitch;
  if (std::abs(fit.lattice.origin - v.front()) <= 1e-9 * fit.lattice.pitch) fit.lattice.origin = v.front();
  fit.lattice.count = static_cast<Index>(std::min(max_index - first_index, kMostSteps)) + 1;
  fit.fits = std::all_of(v.begin(), v.end(), [&](double x) {
    return fit.lattice.deviation(x) <= kLatticeTolerance && fit.lattice.nearest(x) >= 0 &&
           fit.lattice.nearest(x) < fit.lattice.count;
  });
  return fit;
}

}  // namespace

Index Lattice::nearest(double v) const {
  if (!(pitch > 0.0)) return 0;
  const double k = std::round((v - origin) / pitch);
  if (!(std::abs(k) <= kMostSteps)) return static_cast<Index>(k < 0.0 ? -kMostSteps : kMostSteps);
  return static_cast<Index>(k);
}

double Lattice::deviation(double v) const {
  if (!(pitch > 0.0)) return 0.0;
  const double k = (v - origin) / pitch;
  return std::abs(k - std::round(k));
}

LatticeFit fit_lattice(std::vector<double> v, std::optional<double> pitch) {
  make_distinct(v);
  if (v.size() == 1) return {{v.front(), 0.0, 1}, true};
  std::vector<double> steps(v.size() - 1);
  for (std::size_t i = 0; i + 1 < v.size(); ++i) steps[i] = v[i + 1] - v[i];
  std::vector<double> sorted = steps;
  std::sort(sorted.begin(), sorted.end());

  const LatticeFit by_median = fit_with(v, mean_step(steps, sorted[sorted.size() / 2]));
  if (by_median.fits) return by_median;
  const double smallest = sorted.front();
  const auto as_small =
      std::count_if(steps.begin(), steps.end(), [&](double step) { return same_step(step, smallest); });
  if (4 * static_cast<std::size_t>(as_small) >= steps.size()) {
    const LatticeFit by_smallest = fit_with(v, mean_step(steps, smallest));
    if (by_smallest.fits) return by_smallest;
  }
  if (pitch) {
    const LatticeFit by_given = fit_with(v, *pitch);
    if (by_given.fits) return by_given;
  }
  return by_median;
}

}  // namespace dwell
