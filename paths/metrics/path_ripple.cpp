#include "paths/metrics/path_ripple.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/removal/removal_once.h"
#include "core/tif/removal_kernel.h"

namespace dwell {
namespace {

constexpr double kMostPixels = 4096.0;     // a side
constexpr double kFinestDefault = 1024.0;  // pixels a side
constexpr double kUntouched = 1e-6;        // of the mean removal

[[noreturn]] void refuse(const char* option, double value, const char* unit, const std::string& required) {
  throw InputError(fmt::format("path ripple: {} = {} {}; required {}", option, value, unit, required));
}

void check_positive(const char* option, double value, const char* unit) {
  if (!(std::isfinite(value) && value > 0.0)) refuse(option, value, unit, "finite and > 0");
}

struct Extent {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  explicit Extent(const std::vector<Point>& points) {
    for (const Point p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  double shorter() const { return std::min(high.x - low.x, high.y - low.y); }
};

double default_side(const Extent& extent, double radius) {
  const double room = extent.shorter() - 2.0 * radius;
  if (!(room > 0.0)) {
    throw InputError(fmt::format(
        "path ripple: the path covers {:.4g} x {:.4g} mm, of which nothing is left within the removal function's "
        "radius of {:.4g} mm of its edge; required: a longer path, or a side of the patch in mm",
        extent.high.x - extent.low.x, extent.high.y - extent.low.y, radius));
  }
  return std::min(8.0 * radius, room);
}

/// The strokes that reach a patch, and the length of path within it.
struct Near {
  std::vector<Stroke> strokes;
  double length_inside = 0.0;
};

Near near_strokes(const ToolPath& path, Point centre, double side, double reach, const Progress& progress) {
  Poll poll(progress);
  const auto within = [&](const Stroke& s, double half) {
    const Point d = s.via - centre;
    return std::max(std::abs(d.x), std::abs(d.y)) <= half;
  };
  Near near;
  for (const Stroke& stroke : moving_strokes(path)) {
    poll.step();
    const double length = stroke.length();
    if (!(length > 0.0) || !within(stroke, 0.5 * side + reach + length)) continue;
    near.strokes.push_back(stroke);
    if (within(stroke, 0.5 * side)) near.length_inside += length;
  }
  return near;
}

double default_pixel(double spacing, double fwhm, double side) {
  return std::min(std::max(std::min(spacing, fwhm) / 8.0, side / kFinestDefault), fwhm / 8.0);
}

Grid patch_grid(Point centre, double side, double pixel) {
  const double count = std::max(1.0, std::round(side / pixel));
  if (!(count <= kMostPixels)) {
    throw InputError(fmt::format("path ripple: a side of {} mm has {:.0f} pixels of {} mm; at most {:.0f} accepted",
                                 side, count, pixel, kMostPixels));
  }
  const auto n = static_cast<Index>(count);
  const double half = 0.5 * pixel * (count - 1.0);
  return {n, n, pixel, pixel, {centre.x - half, centre.y - half}};
}

void summarise(PathRipple& ripple, double depth) {
  const std::vector<double>& values = ripple.removal.values;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  double square = 0.0;
  for (const double v : values) square += (v - depth) * (v - depth);
  ripple.pve = *high - *low;
  ripple.pvn = ripple.pve / depth;
  ripple.rms = std::sqrt(square / static_cast<double>(values.size()));
  if (*low < kUntouched * depth) {
    throw InputError(
        "path ripple: the path leaves part of the patch untouched (a hole of the part?); required: the centre of a "
        "patch "
        "that the path covers");
  }
}

}  // namespace

PathRipple path_ripple(const ToolPath& path, const RemovalFunction& tif, const PathRippleOptions& options,
                       const Progress& progress) {
  validate(path);
  check_positive("depth", options.depth, "nm");
  const Extent extent(path.points);
  const double side = options.side ? *options.side : default_side(extent, tif.radius);
  check_positive("side", side, "mm");
  const Point centre = options.centre.value_or(midpoint(extent.low, extent.high));
  const Near near = near_strokes(path, centre, side, 1.5 * tif.radius, progress);
  if (!(near.length_inside > 0.0)) {
    throw InputError(
        fmt::format("path ripple: the path has no moving stroke in the patch of {:.4g} mm about {:.6g}/{:.6g}; "
                    "required: a patch that the path covers",
                    side, centre.x, centre.y));
  }
  PathRipple ripple;
  ripple.spacing = side * side / near.length_inside;
  const double pixel = options.pixel.value_or(default_pixel(ripple.spacing, tif.fwhm, side));
  check_positive("pixel", pixel, "mm");
  ripple.removal = HeightMap(patch_grid(centre, side, pixel));
  const Grid& grid = ripple.removal.grid;

  std::vector<Index> pixels(static_cast<std::size_t>(grid.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<Index>(i);
  Vector seconds(static_cast<Index>(near.strokes.size()));  // at 1 mm/s
  for (std::size_t j = 0; j < near.strokes.size(); ++j) seconds[static_cast<Index>(j)] = near.strokes[j].length();
  progress.check();
  const Vector removal = removal_once(grid, pixels, removal_kernel(tif, pixel, pixel), near.strokes, seconds,
                                      std::max(options.threads, 1));
  ripple.feed = removal.mean() / options.depth;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    ripple.removal.values[i] = removal[static_cast<Index>(i)] / ripple.feed;
  }
  ripple.removal.history.push_back(fmt::format("removal of the path {} at {:.6g} mm/s", path.kind, ripple.feed));
  summarise(ripple, options.depth);
  progress.check();
  ripple.spectrum = ripple_spectrum(ripple.removal, options.band, options.threads);
  return ripple;
}

}  // namespace dwell
