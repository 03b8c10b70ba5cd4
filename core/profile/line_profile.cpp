#include "core/profile/line_profile.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/numerics/cubic_spline.h"

namespace dwell {
namespace {

double weighted_mean(const std::vector<double>& values, const std::vector<double>& weights) {
  const double sum = std::inner_product(values.begin(), values.end(), weights.begin(), 0.0);
  return sum / std::accumulate(weights.begin(), weights.end(), 0.0);
}

double peak_to_valley(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

}  // namespace

LineProfile line_profile(ProfileQuantity measured, std::vector<double> x, std::vector<double> values) {
  const CubicSpline spline(x, values);
  LineProfile profile{measured, std::move(x), {}, {}};
  if (measured == ProfileQuantity::Height) {
    profile.slope = spline.derivatives();
    profile.height = std::move(values);
    return profile;
  }
  profile.slope = std::move(values);
  profile.height = spline.integrals();
  const double mean = weighted_mean(profile.height, place_lengths(profile.x));
  for (double& height : profile.height) height -= mean;
  return profile;
}

std::vector<double> place_lengths(const std::vector<double>& x) {
  std::vector<double> lengths(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double left = i > 0 ? x[i] - x[i - 1] : x[1] - x[0];
    const double right = i + 1 < x.size() ? x[i + 1] - x[i] : left;
    lengths[i] = 0.5 * (left + right);
  }
  return lengths;
}

double rms_about_mean(const std::vector<double>& values, const std::vector<double>& weights) {
  const double mean = weighted_mean(values, weights);
  double sum = 0.0, total = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += weights[i] * (values[i] - mean) * (values[i] - mean);
    total += weights[i];
  }
  return std::sqrt(sum / total);
}

ProfileFigures profile_figures(const LineProfile& profile) {
  const std::vector<double> lengths = place_lengths(profile.x);
  return {rms_about_mean(profile.slope, lengths), peak_to_valley(profile.slope),
          rms_about_mean(profile.height, lengths), peak_to_valley(profile.height)};
}

ProfileSpacing profile_spacing(const LineProfile& profile) {
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < profile.x.size(); ++i) steps.push_back(profile.x[i + 1] - profile.x[i]);
  std::sort(steps.begin(), steps.end());
  return {steps.front(), steps[steps.size() / 2], steps.back()};
}

}  // namespace dwell
