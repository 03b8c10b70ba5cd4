#include "runs/example/example.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/base/errors.h"
#include "core/base/numbers.h"
#include "core/base/random_numbers.h"
#include "core/base/value_range.h"

namespace dwell {
namespace {

constexpr double kLargestEdge = 4096.0;  // pixels
constexpr int kModes = 400;
constexpr double kHuge = ranges::kHeight.most;  // amplitudes

void require(bool accepted, const char* owner, const char* field, double value, const char* what) {
  if (!accepted) throw InputError(fmt::format("{}.{} = {}; required {}", owner, field, value, what));
}

/// The same for what the command line can give: the message names the option.
void require_option(bool accepted, const char* option, double value, const char* what) {
  if (!accepted) throw InputError(option, fmt::format("{} mm", value), what);
}

struct Field {
  const char* name;
  double value;
};

void check(const ExampleOptions& o) {
  constexpr const char* kOwner = "ExampleOptions";
  for (const Field f :
       {Field{"power", o.power}, Field{"astigmatism", o.astigmatism}, Field{"astigmatism45", o.astigmatism45},
        Field{"coma_x", o.coma_x}, Field{"coma_y", o.coma_y}, Field{"trefoil", o.trefoil},
        Field{"spherical", o.spherical}, Field{"bump", o.bump}, Field{"edge_rolloff", o.edge_rolloff}}) {
    require(std::abs(f.value) <= kHuge, kOwner, f.name, f.value, "finite, at most 1e9 in magnitude");
  }
  for (const Field f : {Field{"width", o.width}, Field{"height", o.height}, Field{"pitch", o.pitch}}) {
    require_option(ranges::kSize.holds(f.value), f.name, f.value, "> 0, from 1e-6 to 1e6 mm");
  }
  require(ranges::kSize.holds(o.edge_width), kOwner, "edge_width", o.edge_width, "> 0, from 1e-6 to 1e6 mm");
  for (const Field f : {Field{"roughness_rms", o.roughness_rms}, Field{"noise_rms", o.noise_rms}}) {
    require(f.value >= 0.0 && f.value <= kHuge, kOwner, f.name, f.value, ">= 0 and at most 1e9");
  }
  require(o.roughness_slope >= -6.0 && o.roughness_slope <= 0.0, kOwner, "roughness_slope", o.roughness_slope,
          "from -6 to 0");
  const bool round = o.shape == ExampleOptions::Shape::Round;
  const double least = round ? o.width : std::min(o.width, o.height);
  const double most = round ? o.width : std::max(o.width, o.height);
  require_option(o.pitch <= 0.5 * least && o.pitch >= most / kLargestEdge, "pitch", o.pitch,
                 "such that both edges have 2 to 4096 pixels");
  require_option(o.hole >= 0.0 && (round ? o.hole <= o.width - 2.0 * o.pitch : o.hole == 0.0), "hole", o.hole,
                 "from 0 to the width less two pitches for a round mirror, 0 for a rectangle");
}

Grid centred_grid(double width, double height, double pitch) {
  Grid grid;
  grid.cols = std::lround(width / pitch);
  grid.rows = std::lround(height / pitch);
  grid.pitch_x = grid.pitch_y = pitch;
  grid.origin = {-0.5 * pitch * static_cast<double>(grid.cols - 1), -0.5 * pitch * static_cast<double>(grid.rows - 1)};
  return grid;
}

// Distance from a point to the nearest edge of the mirror, negative outside [mm].
double depth(const ExampleOptions& o, Point p) {
  if (o.shape == ExampleOptions::Shape::Rectangle) {
    return std::min(0.5 * o.width - std::abs(p.x), 0.5 * o.height - std::abs(p.y));
  }
  const double to_rim = 0.5 * o.width - length(p);
  return o.hole > 0.0 ? std::min(to_rim, length(p) - 0.5 * o.hole) : to_rim;
}

// The polynomials in Cartesian form; each is divided by its PV on the unit disc (3/2 for spherical, else 2).
double form(const ExampleOptions& o, Point p) {
  const double radius = o.shape == ExampleOptions::Shape::Round ? 0.5 * o.width : 0.5 * std::hypot(o.width, o.height);
  const double x = p.x / radius;
  const double y = p.y / radius;
  const double rr = x * x + y * y;
  const double doubled = o.power * (2.0 * rr - 1.0) + o.astigmatism * (x * x - y * y) + o.astigmatism45 * 2.0 * x * y +
                         (o.coma_x * x + o.coma_y * y) * (3.0 * rr - 2.0) + o.trefoil * x * (x * x - 3.0 * y * y);
  return 0.5 * doubled + o.spherical * (6.0 * rr * rr - 6.0 * rr + 1.0) / 1.5;
}

double bump(const ExampleOptions& o, Point p) {
  const double high = o.shape == ExampleOptions::Shape::Round ? o.width : o.height;
  const double r = distance(p, {0.25 * o.width, 0.15 * high});
  return o.bump * std::exp2(-4.0 * (r * r) / (0.12 * o.width * 0.12 * o.width));
}

// Sum of cosines of random direction and phase at frequencies spaced evenly in log f. The band of one mode has the
// power C(f) 2 pi f df, and df is proportional to f: hence amplitude^2 ~ f^(slope + 2). Along a row each cosine is
// the real part of a phasor that turns by a fixed angle.
std::vector<double> roughness(const ExampleOptions& o, const Grid& grid, RandomNumbers& random,
                              const Progress& progress) {
  std::vector<double> sum(static_cast<std::size_t>(grid.size()), 0.0);
  const double lowest = 1.0 / std::max(grid.width(), grid.height());
  const double highest = 0.5 / o.pitch;
  for (int m = 0; m < kModes; ++m) {
    progress.step(fmt::format("roughness: {} of {} waves", m, kModes));
    const double f = lowest * std::pow(highest / lowest, (m + random.uniform()) / kModes);
    const double direction = 2.0 * kPi * random.uniform();
    const double phase = 2.0 * kPi * random.uniform();
    const double amplitude = std::pow(f / lowest, 0.5 * (o.roughness_slope + 2.0));
    const double fx = f * std::cos(direction);
    const double fy = f * std::sin(direction);
    const std::complex<double> turn = std::polar(1.0, 2.0 * kPi * fx * grid.pitch_x);
    std::size_t i = 0;
    for (Index r = 0; r < grid.rows; ++r) {
      std::complex<double> phasor = std::polar(amplitude, phase + 2.0 * kPi * (fx * grid.x(0) + fy * grid.y(r)));
      for (Index c = 0; c < grid.cols; ++c) {
        sum[i++] += phasor.real();
        phasor *= turn;
      }
    }
  }
  return sum;
}

// Shifts and scales to mean 0 and the given RMS over these pixels.
void normalise(std::vector<double>& values, const std::vector<Index>& pixels, double rms) {
  double mean = 0.0;
  for (const Index i : pixels) mean += values[static_cast<std::size_t>(i)];
  mean /= static_cast<double>(pixels.size());
  double square = 0.0;
  for (const Index i : pixels) square += std::pow(values[static_cast<std::size_t>(i)] - mean, 2);
  const double found = std::sqrt(square / static_cast<double>(pixels.size()));
  const double factor = found > 0.0 ? rms / found : 0.0;
  for (double& v : values) v = factor * (v - mean);
}

void check(const ExampleTifOptions& o) {
  constexpr const char* kOwner = "ExampleTifOptions";
  for (const Field f :
       {Field{"peak", o.peak}, Field{"fwhm", o.fwhm}, Field{"pitch", o.pitch}, Field{"half_width", o.half_width}}) {
    require(f.value > 0.0 && f.value <= kHuge, kOwner, f.name, f.value, "> 0 and at most 1e9");
  }
  require(o.half_width >= 0.5 * o.fwhm, kOwner, "half_width", o.half_width, "at least half the fwhm");
  require(o.pitch <= 0.5 * o.fwhm && 2.0 * o.half_width / o.pitch + 1.0 <= kLargestEdge, kOwner, "pitch", o.pitch,
          "at most half the fwhm, and such that an edge has at most 4096 pixels");
  require(o.ellipticity >= 1.0 && o.ellipticity <= 10.0, kOwner, "ellipticity", o.ellipticity, "from 1 to 10");
  require(std::abs(o.angle) <= 360.0, kOwner, "angle", o.angle, "from -360 to 360 degrees");
  require(std::abs(o.shear) <= 1.0, kOwner, "shear", o.shear, "from -1 to 1");
  require(std::abs(o.skew) <= 0.5, kOwner, "skew", o.skew, "from -0.5 to 0.5");
  for (const Field f : {Field{"offset_x", o.offset_x}, Field{"offset_y", o.offset_y}}) {
    require(std::abs(f.value) <= o.half_width, kOwner, f.name, f.value, "at most half_width in magnitude");
  }
  require(o.noise_rms >= 0.0 && o.noise_rms <= kHuge, kOwner, "noise_rms", o.noise_rms, ">= 0 and at most 1e9");
}

// Rate of the spot without noise at a displacement from its peak.
double spot(const ExampleTifOptions& o, Point d) {
  const double angle = o.angle * kPi / 180.0;
  const double stretch = std::sqrt(o.ellipticity);
  // None of the three steps changes an area: turn, slant, stretch one axis and shrink the other.
  const double along = std::cos(angle) * d.x + std::sin(angle) * d.y;
  const double across = -std::sin(angle) * d.x + std::cos(angle) * d.y - o.shear * along;
  const double half = 0.5 * o.fwhm;
  const double u = along / (half * stretch);
  const double v = across * stretch / half;
  const double skewed = u / (1.0 + o.skew * std::tanh(u));
  return o.peak * std::exp2(-(skewed * skewed + v * v));
}

}  // namespace

HeightMap example_mirror(const ExampleOptions& options, const Progress& progress) {
  check(options);
  const bool round = options.shape == ExampleOptions::Shape::Round;
  HeightMap map(centred_grid(options.width, round ? options.width : options.height, options.pitch));
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    const double inside = depth(options, p);
    // The middle of a pixel on the very edge may fall outside by rounding.
    if (inside < -1e-9 * options.width) continue;
    map.values[static_cast<std::size_t>(i)] =
        form(options, p) + bump(options, p) -
        options.edge_rolloff * std::exp(-std::max(0.0, inside) / options.edge_width);
  }
  const std::vector<Index> pixels = finite_pixels(map);
  if (pixels.empty()) {
    throw InputError("pitch", fmt::format("{} mm", options.pitch), "a finer one: no pixel lies on the mirror");
  }
  RandomNumbers random(options.seed);
  std::vector<double> rough(map.values.size(), 0.0);
  if (options.roughness_rms > 0.0) {
    rough = roughness(options, map.grid, random, progress);
    normalise(rough, pixels, options.roughness_rms);
  }
  for (const Index i : pixels) {
    map.values[static_cast<std::size_t>(i)] += rough[static_cast<std::size_t>(i)] + options.noise_rms * random.normal();
  }
  return map;
}

HeightMap example_tif(const ExampleTifOptions& options) {
  check(options);
  const double edge = options.pitch * (2.0 * std::floor(options.half_width / options.pitch + 1e-9) + 1.0);
  HeightMap map(centred_grid(edge, edge, options.pitch));
  map.quantity = MapQuantity::Rate;
  RandomNumbers random(options.seed);
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point d = map.grid.centre(i) - Point{options.offset_x, options.offset_y};
    map.values[static_cast<std::size_t>(i)] = spot(options, d) + options.noise_rms * random.normal();
  }
  return map;
}

}  // namespace dwell
