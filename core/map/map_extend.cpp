#include "core/map/map_extend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/map/nearest_pixel.h"
#include "core/numerics/fft.h"
#include "core/numerics/laplace.h"

namespace dwell {
namespace {

void check(const ExtendOptions& o) {
  if (!(std::isfinite(o.width) && o.width > 0.0)) {
    throw InputError(fmt::format("extend: width = {} mm; a finite number > 0 is required", o.width));
  }
  if (o.how != Extension::Gerchberg) return;
  if (!(std::isfinite(o.shortest) && o.shortest > 0.0)) {
    throw InputError(fmt::format("extend: shortest = {} mm; a finite wavelength > 0 is required", o.shortest));
  }
  if (o.iterations < 1) throw InputError(fmt::format("extend: iterations = {}; at least 1 required", o.iterations));
  if (!(std::isfinite(o.tolerance) && o.tolerance >= 0.0)) {
    throw InputError(fmt::format("extend: tolerance = {}; a finite number >= 0 is required", o.tolerance));
  }
}

HeightMap enlarge_map(const HeightMap& map, double width, const PixelLimit& limit) {
  const Grid& g = map.grid;
  constexpr double kRounding = 1e-9;  // pixels
  const double rows = std::ceil(width / g.pitch_y - kRounding), cols = std::ceil(width / g.pitch_x - kRounding);
  Grid wide = limited_grid(static_cast<double>(g.rows) + 2.0 * rows, static_cast<double>(g.cols) + 2.0 * cols,
                           {g.pitch_x, g.pitch_y}, {}, fmt::format("extend: width = {} mm", width), limit);
  const auto down = static_cast<Index>(rows), right = static_cast<Index>(cols);
  wide.origin = g.centre(-down, -right);
  HeightMap result(wide);
  for (Index r = 0; r < g.rows; ++r) {
    std::copy_n(map.values.begin() + g.index(r, 0), g.cols, result.values.begin() + wide.index(r + down, right));
  }
  result.history = map.history;
  return result;
}

double mean_of_data(const HeightMap& map) {
  double sum = 0.0;
  for (const Index i : finite_pixels(map)) sum += map.values[static_cast<std::size_t>(i)];
  return sum / static_cast<double>(map.valid_pixels());
}

/// Gerchberg's iteration on the pixels of a map, periodic.
class Gerchberg {
 public:
  Gerchberg(const HeightMap& map, const std::vector<Index>& nearest, const ExtendOptions& options, int threads)
      : map_(map),
        mean_(mean_of_data(map)),
        fft_(within_limit(periodic_size(map.grid.rows, map.grid.pitch_y, options),
                          periodic_size(map.grid.cols, map.grid.pitch_x, options), options, threads)) {
    // The start is the nearest height everywhere: padding beyond the map continues its last row and column.
    for (Index r = 0; r < fft_.rows(); ++r) {
      for (Index c = 0; c < fft_.cols(); ++c) {
        const Index inside = map.grid.index(std::min(r, map.grid.rows - 1), std::min(c, map.grid.cols - 1));
        at(r, c) = map.values[static_cast<std::size_t>(nearest[static_cast<std::size_t>(inside)])] - mean_;
      }
    }
  }

  double height(Index row, Index col) { return mean_ + at(row, col); }

  /// One iteration; returns the RMS change in the pixels without data, relative to the RMS of the data.
  double iterate(double shortest) {
    const std::vector<double> before(fft_.real().begin(), fft_.real().end());
    fft_.forward();
    take_out_short_waves(shortest);
    fft_.inverse();
    double change = 0.0, data = 0.0;
    Index changed = 0, known = 0;
    for (Index r = 0; r < fft_.rows(); ++r) {
      for (Index c = 0; c < fft_.cols(); ++c) {
        const bool inside = r < map_.grid.rows && c < map_.grid.cols;
        if (inside && std::isfinite(map_.at(r, c))) {
          at(r, c) = map_.at(r, c) - mean_;
          data += at(r, c) * at(r, c);
          ++known;
        } else if (inside) {
          const double step = at(r, c) - before[static_cast<std::size_t>(r * fft_.cols() + c)];
          change += step * step;
          ++changed;
        }
      }
    }
    if (changed == 0 || !(data > 0.0)) return 0.0;
    return std::sqrt(change / static_cast<double>(changed) / (data / static_cast<double>(known)));
  }

 private:
  /// Pixels of an axis of the transform. At least one shortest wave lies between the data and its periodic repetition,
  /// so that they do not influence each other.
  static Index periodic_size(Index count, double pitch, const ExtendOptions& options) {
    const double gap = std::max(0.0, options.shortest - 2.0 * options.width) / pitch;
    return good_fft_size(count + static_cast<Index>(std::ceil(std::min(gap, static_cast<double>(count)))));
  }

  static RealFft2D within_limit(Index rows, Index cols, const ExtendOptions& options, int threads) {
    check_pixels(
        static_cast<double>(rows), static_cast<double>(cols), options.limit,
        fmt::format("extend: width = {} mm, shortest = {} mm: the transform", options.width, options.shortest));
    return {rows, cols, threads};
  }

  double& at(Index row, Index col) { return fft_.real()[static_cast<std::size_t>(row * fft_.cols() + col)]; }

  void take_out_short_waves(double shortest) {
    const double highest = 1.0 / shortest * (1.0 + 1e-12), scale = 1.0 / static_cast<double>(fft_.rows() * fft_.cols());
    const Index half = fft_.cols() / 2 + 1;
    const double span_x = map_.grid.pitch_x * static_cast<double>(fft_.cols());
    const double span_y = map_.grid.pitch_y * static_cast<double>(fft_.rows());
    for (Index r = 0; r < fft_.rows(); ++r) {
      const double fy = static_cast<double>(std::min(r, fft_.rows() - r)) / span_y;
      for (Index c = 0; c < half; ++c) {
        const double fx = static_cast<double>(c) / span_x;
        auto& wave = fft_.spectrum()[static_cast<std::size_t>(r * half + c)];
        wave = std::hypot(fx, fy) <= highest ? wave * scale : 0.0;
      }
    }
  }

  const HeightMap& map_;
  double mean_;
  RealFft2D fft_;
};

void extend_by_gerchberg(const HeightMap& data, const std::vector<Index>& nearest, const ExtendOptions& options,
                         const std::vector<Index>& region, HeightMap& result, ExtendSummary& summary, int threads,
                         const Progress& progress) {
  Gerchberg gerchberg(data, nearest, options, threads);
  do {
    progress.step(fmt::format("gerchberg: iteration {} of at most {}, change {:.1e}", summary.iterations,
                              options.iterations, summary.change));
    summary.change = gerchberg.iterate(options.shortest);
    ++summary.iterations;
  } while (summary.iterations < options.iterations && summary.change > options.tolerance);
  for (const Index i : region) {
    result.values[static_cast<std::size_t>(i)] = gerchberg.height(i / data.grid.cols, i % data.grid.cols);
  }
}

void extend_harmonically(const std::vector<Index>& region, HeightMap& result, ExtendSummary& summary,
                         const Progress& progress) {
  std::vector<unsigned char> unknown(result.values.size(), 0);
  for (const Index i : region) unknown[static_cast<std::size_t>(i)] = 1;
  summary.iterations = solve_laplace(result.grid, unknown, result.values, progress).iterations;
}

}  // namespace

Extension parse_extension(const std::string& text) {
  if (text == "zero") return Extension::Zero;
  if (text == "nearest") return Extension::Nearest;
  if (text == "decay") return Extension::Decay;
  if (text == "harmonic") return Extension::Harmonic;
  if (text == "gerchberg") return Extension::Gerchberg;
  throw InputError(fmt::format("extension '{}'; accepted: zero, nearest, decay, harmonic or gerchberg", text));
}

HeightMap extend_map(const HeightMap& map, const ExtendOptions& options, ExtendSummary& summary, int threads,
                     const Progress& progress) {
  check(options);
  const HeightMap data = enlarge_map(map, options.width, options.limit);
  const std::vector<Index> nearest = nearest_pixels(data);
  summary = {};
  HeightMap result = data;
  std::vector<Index> region;
  for (Index i = 0; i < data.grid.size(); ++i) {
    const auto pixel = static_cast<std::size_t>(i);
    if (std::isfinite(data.values[pixel])) continue;
    const double away = distance(data.grid.centre(i), data.grid.centre(nearest[pixel]));
    if (away > options.width * (1.0 + 1e-9)) continue;
    region.push_back(i);
    const double height = data.values[static_cast<std::size_t>(nearest[pixel])];
    if (options.how == Extension::Zero) result.values[pixel] = 0.0;
    if (options.how == Extension::Nearest) result.values[pixel] = height;
    if (options.how == Extension::Decay) {
      result.values[pixel] = height * 0.5 * (1.0 + std::cos(std::numbers::pi * std::min(away / options.width, 1.0)));
    }
  }
  summary.pixels = static_cast<Index>(region.size());
  if (options.how == Extension::Harmonic) extend_harmonically(region, result, summary, progress);
  if (options.how == Extension::Gerchberg) {
    extend_by_gerchberg(data, nearest, options, region, result, summary, threads, progress);
  }
  return result;
}

}  // namespace dwell
