#include "core/spectra/psd.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.h"
#include "core/numerics/fft.h"

namespace dwell {
namespace {

/// The part of the map that holds all its finite pixels.
HeightMap bounding_box(const HeightMap& map) {
  const Grid& g = map.grid;
  Index row0 = g.rows, row1 = -1, col0 = g.cols, col1 = -1;
  for (Index row = 0; row < g.rows; ++row) {
    for (Index col = 0; col < g.cols; ++col) {
      if (!std::isfinite(map.at(row, col))) continue;
      row0 = std::min(row0, row), row1 = row;
      col0 = std::min(col0, col), col1 = std::max(col1, col);
    }
  }
  if (row1 < 0) throw InputError("map has no finite pixel; a spectrum needs at least one");
  HeightMap box(Grid{row1 - row0 + 1, col1 - col0 + 1, g.pitch_x, g.pitch_y, g.centre(row0, col0)});
  for (Index row = row0; row <= row1; ++row) {
    std::copy_n(map.values.begin() + g.index(row, col0), box.grid.cols,
                box.values.begin() + box.grid.index(row - row0, 0));
  }
  return box;
}

/// Fills the transform with w z; the sums of (w z)^2 and w^2.
std::pair<double, double> load(RealFft2D& fft, const HeightMap& map, const std::vector<double>& weights) {
  double* const out = fft.real().data();
  std::fill(fft.real().begin(), fft.real().end(), 0.0);
  double power = 0.0, area = 0.0;
  for (Index row = 0; row < map.grid.rows; ++row) {
    double row_power = 0.0, row_area = 0.0;
    for (Index col = 0; col < map.grid.cols; ++col) {
      const double w = weights[static_cast<std::size_t>(map.grid.index(row, col))];
      if (w == 0.0) continue;  // also where there is no data
      const double v = w * map.at(row, col);
      out[row * fft.cols() + col] = v;
      row_power += v * v, row_area += w * w;
    }
    power += row_power, area += row_area;
  }
  return {power, area};
}

PsdCurve curve(const std::string& name, const std::string& unit, double length, double nyquist) {
  return {name, unit, {}, {}, 2.0 / length, nyquist};
}

}  // namespace

ArealPsd areal_psd(const HeightMap& map, const PsdOptions& options) {
  HeightMap box = bounding_box(map);
  const Grid& g = box.grid;
  ArealPsd psd;
  if (box.valid_pixels() < g.size()) {
    psd.bridged = bridge_gaps(box, options.longest_gap);
    psd.holes = box.valid_pixels() < g.size();
  }
  RealFft2D fft(good_fft_size(g.rows), good_fft_size(g.cols), std::max(options.threads, 1));
  const auto [power, area] = load(fft, box, window_weights(box, options.window, options.threads));
  fft.forward();
  psd.rows = fft.rows(), psd.cols = fft.cols();
  psd.step_x = 1.0 / (static_cast<double>(psd.cols) * g.pitch_x);
  psd.step_y = 1.0 / (static_cast<double>(psd.rows) * g.pitch_y);
  psd.length_x = g.width(), psd.length_y = g.height();
  psd.nyquist_x = 0.5 / g.pitch_x, psd.nyquist_y = 0.5 / g.pitch_y;
  psd.mean_square = power / area;
  psd.density.resize(fft.spectrum().size());
  const double scale = g.pitch_x * g.pitch_y / area;
  const auto spectrum = fft.spectrum();
#pragma omp parallel for num_threads(std::max(options.threads, 1)) schedule(static)
  for (std::size_t i = 0; i < spectrum.size(); ++i) psd.density[i] = scale * std::norm(spectrum[i]);
  return psd;
}

PsdCurve psd_along_x(const ArealPsd& psd) {
  PsdCurve result = curve("x", "nm^2 mm", psd.length_x, psd.nyquist_x);
  for (Index col = 1; col < psd.half_cols(); ++col) {
    double sum = 0.0;
    for (Index row = 0; row < psd.rows; ++row)
      sum += psd.density[static_cast<std::size_t>(row * psd.half_cols() + col)];
    result.frequency.push_back(psd.step_x * static_cast<double>(col));
    result.density.push_back(psd.multiplicity(col) * sum * psd.step_y);
  }
  return result;
}

PsdCurve psd_along_y(const ArealPsd& psd) {
  PsdCurve result = curve("y", "nm^2 mm", psd.length_y, psd.nyquist_y);
  const auto row_sum = [&](Index row) {
    double sum = 0.0;
    for (Index col = 0; col < psd.half_cols(); ++col) {
      sum += psd.multiplicity(col) * psd.density[static_cast<std::size_t>(row * psd.half_cols() + col)];
    }
    return sum;
  };
  for (Index row = 1; row <= psd.rows / 2; ++row) {
    const double both = 2 * row == psd.rows ? row_sum(row) : row_sum(row) + row_sum(psd.rows - row);
    result.frequency.push_back(psd.step_y * static_cast<double>(row));
    result.density.push_back(both * psd.step_x);
  }
  return result;
}

PsdCurve radial_psd(const ArealPsd& psd) {
  const double side = std::min(psd.length_x, psd.length_y), nyquist = std::min(psd.nyquist_x, psd.nyquist_y);
  PsdCurve result = curve("radial", "nm^2 mm^2", side, nyquist);
  const auto rings = static_cast<std::size_t>(std::max(std::floor(nyquist * side - 0.5), 0.0)) + 1;  // 0: the middle
  std::vector<double> count(rings), frequency(rings), density(rings);
  for (Index row = 0; row < psd.rows; ++row) {
    const double fy = psd.frequency_y(row);
    for (Index col = 0; col < psd.half_cols(); ++col) {
      const double fx = psd.step_x * static_cast<double>(col), f = std::sqrt(fx * fx + fy * fy);
      const auto ring = static_cast<std::size_t>(std::lround(f * side));
      if (ring >= rings) break;  // it only grows along the row
      const double many = psd.multiplicity(col);
      count[ring] += many;
      frequency[ring] += many * f;
      density[ring] += many * psd.density[static_cast<std::size_t>(row * psd.half_cols() + col)];
    }
  }
  for (std::size_t k = 1; k < rings; ++k) {
    if (!(count[k] > 0.0)) continue;
    result.frequency.push_back(frequency[k] / count[k]);
    result.density.push_back(density[k] / count[k]);
  }
  return result;
}

std::vector<double> band_mean_squares(const ArealPsd& psd, const std::vector<double>& edges) {
  std::vector<double> squares(edges.size());
  for (std::size_t k = 0; k < edges.size(); ++k) squares[k] = edges[k] * edges[k];
  std::vector<double> sums(edges.size() + 1, 0.0);
  for (Index row = 0; row < psd.rows; ++row) {
    const double fy = psd.frequency_y(row);
    std::size_t band = 0;
    double sum = 0.0;
    for (Index col = 0; col < psd.half_cols(); ++col) {
      const double fx = psd.step_x * static_cast<double>(col);
      while (band < squares.size() && fx * fx + fy * fy >= squares[band]) {
        sums[band++] += sum;
        sum = 0.0;
      }
      sum += psd.multiplicity(col) * psd.density[static_cast<std::size_t>(row * psd.half_cols() + col)];
    }
    sums[band] += sum;
  }
  for (double& s : sums) s *= psd.step_x * psd.step_y;
  return sums;
}

}  // namespace dwell
