#include "core/numerics/cubic_spline.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace dwell {
namespace {

/// One equation: before m_{i-1} + diagonal m_i + after m_{i+1} = right.
struct SplineRow {
  double before = 0.0, diagonal = 0.0, after = 0.0, right = 0.0;
};

/// The equations of the first derivatives: continuous second derivatives within, the condition of the ends outside.
std::vector<SplineRow> spline_rows(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  const auto step = [&x](std::size_t i) { return x[i + 1] - x[i]; };
  const auto chord = [&](std::size_t i) { return (y[i + 1] - y[i]) / step(i); };
  std::vector<SplineRow> rows(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = step(i - 1), right = step(i);
    rows[i] = {right, 2.0 * (left + right), left, 3.0 * (right * chord(i - 1) + left * chord(i))};
  }
  const double first = step(0), second = step(1), both = first + second;
  rows[0] = {0.0, second, both, ((first + 2.0 * both) * second * chord(0) + first * first * chord(1)) / both};
  const double last = step(n - 2), inner = step(n - 3), pair = last + inner;
  rows[n - 1] = {pair, inner, 0.0, (last * last * chord(n - 3) + (2.0 * pair + last) * inner * chord(n - 2)) / pair};
  return rows;
}

}  // namespace

CubicSpline::CubicSpline(std::vector<double> places, std::vector<double> values)
    : places_(std::move(places)), values_(std::move(values)) {
  constexpr std::size_t kFewest = 4;
  const std::size_t n = places_.size();
  if (n < kFewest || values_.size() != n)
    throw std::invalid_argument("a cubic spline needs four places and as many values");
  std::vector<SplineRow> rows = spline_rows(places_, values_);
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = rows[i].before / rows[i - 1].diagonal;
    rows[i].diagonal -= factor * rows[i - 1].after;
    rows[i].right -= factor * rows[i - 1].right;
  }
  derivatives_.resize(n);
  derivatives_[n - 1] = rows[n - 1].right / rows[n - 1].diagonal;
  for (std::size_t i = n - 1; i-- > 0;)
    derivatives_[i] = (rows[i].right - rows[i].after * derivatives_[i + 1]) / rows[i].diagonal;
}

double CubicSpline::value(double place) const {
  const auto after = std::upper_bound(places_.begin() + 1, places_.end() - 1, place);
  const auto i = static_cast<std::size_t>(after - places_.begin()) - 1;
  const double h = places_[i + 1] - places_[i], t = (place - places_[i]) / h, s = 1.0 - t;
  return values_[i] * s * s * (1.0 + 2.0 * t) + values_[i + 1] * t * t * (1.0 + 2.0 * s) +
         h * s * t * (derivatives_[i] * s - derivatives_[i + 1] * t);
}

std::vector<double> CubicSpline::integrals() const {
  constexpr double kTwelfth = 1.0 / 12.0;
  std::vector<double> sums(places_.size(), 0.0);
  for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
    const double h = places_[i + 1] - places_[i];
    sums[i + 1] =
        sums[i] + 0.5 * h * (values_[i] + values_[i + 1]) + kTwelfth * h * h * (derivatives_[i] - derivatives_[i + 1]);
  }
  return sums;
}

}  // namespace dwell
