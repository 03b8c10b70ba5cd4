#include "core/spectra/spectral_window.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/spec_text.h"
#include "core/map/edge_distance.h"

namespace dwell {
namespace {

std::vector<double> along_axis(Index count, const SpectralWindow& window) {
  std::vector<double> w(static_cast<std::size_t>(count));
  for (Index i = 0; i < count; ++i) {
    const double edge = static_cast<double>(std::min(i, count - 1 - i)) + 0.5;
    w[static_cast<std::size_t>(i)] = window(2.0 * edge / static_cast<double>(count));
  }
  return w;
}

/// Bridges the gaps of one line: `at(k)` is its k-th value.
template <class At>
Index bridge_line(Index count, Index longest, const At& at) {
  Index filled = 0, last = -1;  // last valid
  for (Index k = 0; k < count; ++k) {
    if (!std::isfinite(at(k))) continue;
    const Index gap = k - last - 1;
    if (last >= 0 && gap > 0 && gap <= longest) {
      const double from = at(last), step = (at(k) - from) / static_cast<double>(gap + 1);
      for (Index i = 1; i <= gap; ++i) at(last + i) = from + step * static_cast<double>(i);
      filled += gap;
    }
    last = k;
  }
  return filled;
}

}  // namespace

double SpectralWindow::operator()(double t) const {
  if (kind == Kind::None || t >= taper) return 1.0;
  const double s = std::sin(0.5 * std::numbers::pi * t / taper);
  return s * s;
}

SpectralWindow parse_spectral_window(const std::string& text) {
  const auto [kind, rest] = split_kind(text);
  const std::string word = lower_case(trim(kind));
  if (word == "hann" && rest.empty()) return {};
  if (word == "none" && rest.empty()) return {SpectralWindow::Kind::None, 1.0};
  if (word == "tukey") {
    const auto taper = finite_number(rest);
    if (taper && *taper > 0.0 && *taper <= 1.0) return {SpectralWindow::Kind::Tukey, *taper};
  }
  throw InputError(
      fmt::format("window \"{}\"; accepted: hann, none, or tukey:R with the tapered part 0 < R <= 1", text));
}

std::string to_string(const SpectralWindow& window) {
  if (window.kind == SpectralWindow::Kind::Tukey) return fmt::format("tukey:{}", window.taper);
  return window.kind == SpectralWindow::Kind::Hann ? "hann" : "none";
}

std::vector<double> window_weights(const HeightMap& map, const SpectralWindow& window, int threads) {
  const Grid& g = map.grid;
  std::vector<double> weights(static_cast<std::size_t>(g.size()), 0.0);
  if (map.valid_pixels() == g.size()) {
    const std::vector<double> x = along_axis(g.cols, window), y = along_axis(g.rows, window);
    for (Index row = 0; row < g.rows; ++row) {
      double* out = weights.data() + g.index(row, 0);
      for (Index col = 0; col < g.cols; ++col) {
        out[col] = y[static_cast<std::size_t>(row)] * x[static_cast<std::size_t>(col)];
      }
    }
    return weights;
  }
  weights = edge_distances(map, threads);
  const double half = 0.5 * std::min(g.pitch_x, g.pitch_y), most = *std::max_element(weights.begin(), weights.end());
#pragma omp parallel for num_threads(std::max(threads, 1)) schedule(static)
  for (Index i = 0; i < g.size(); ++i) {
    double& w = weights[static_cast<std::size_t>(i)];
    if (w > 0.0) w = window((w - half) / (most - half));
  }
  return weights;
}

Index bridge_gaps(HeightMap& map, Index longest) {
  const Grid& g = map.grid;
  Index filled = 0;
  for (Index row = 0; row < g.rows; ++row) {
    filled += bridge_line(g.cols, longest, [&](Index k) -> double& { return map.at(row, k); });
  }
  for (Index col = 0; col < g.cols; ++col) {
    filled += bridge_line(g.rows, longest, [&](Index k) -> double& { return map.at(k, col); });
  }
  return filled;
}

}  // namespace dwell
