#include "paths/raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/errors.h"
#include "core/number_text.h"
#include "paths/distance_map.h"

namespace dwell {
namespace {

constexpr double kMaxPoints = 50e6;
constexpr double kRounding = 1e-9;  // of a lattice step: points exactly `overrun` away must not depend on rounding

[[noreturn]] void refuse(const char* option, double value, const char* unit, const char* required) {
  throw InputError(fmt::format("raster: {} = {}{}; required {}", option, value, unit, required));
}

void check(const RasterOptions& o, double step, double overrun) {
  if (!(o.pitch > 0.0)) refuse("pitch", o.pitch, " mm", "> 0");
  if (!std::isfinite(o.pitch)) refuse("pitch", o.pitch, " mm", "finite");
  if (!(step > 0.0)) refuse("step", step, " mm", "> 0");
  if (!std::isfinite(step)) refuse("step", step, " mm", "finite");
  if (!std::isfinite(o.angle_deg)) refuse("angle", o.angle_deg, " degrees", "finite");
  if (!(overrun >= 0.0)) refuse("overrun", overrun, " mm", ">= 0");
  if (!std::isfinite(overrun)) refuse("overrun", overrun, " mm", "finite");
}

/// (cos, sin), exact for multiples of 90 degrees.
Point direction(double angle_deg) {
  const double angle = std::remainder(angle_deg, 360.0);
  if (angle == 0.0) return {1.0, 0.0};
  if (angle == 90.0) return {0.0, 1.0};
  if (angle == -90.0) return {0.0, -1.0};
  if (std::abs(angle) == 180.0) return {-1.0, 0.0};
  const double radians = angle * std::numbers::pi / 180.0;
  return {std::cos(radians), std::sin(radians)};
}

double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
};

/// Equidistant positions symmetric about the middle of an interval, as many as fit.
struct Ticks {
  double middle = 0.0;
  double step = 1.0;
  double count = 1.0;  // integral; a double so that an absurd one can be compared and reported

  Ticks(const Interval& range, double overrun, double tick) : middle(0.5 * (range.low + range.high)), step(tick) {
    count = std::floor((range.high - range.low + 2.0 * overrun) / step + kRounding) + 1.0;
  }
  double at(Index i) const { return middle + step * (static_cast<double>(i) - 0.5 * (count - 1.0)); }
  Index nearest(double v) const {
    return static_cast<Index>(std::clamp(std::floor((v - at(0)) / step + 0.5), 0.0, count - 1.0));
  }
};

struct Lattice {
  Point along;   // unit vector of the lines
  Point across;  // 90 degrees counter-clockwise from it
  Ticks steps;
  Ticks lines;

  Point at(Index line, Index step) const { return steps.at(step) * along + lines.at(line) * across; }
};

Lattice make_lattice(const HeightMap& map, const std::vector<Index>& pixels, const RasterOptions& options, double step,
                     double overrun) {
  const Point along = direction(options.angle_deg);
  const Point across{-along.y, along.x};
  Interval u, v;
  for (const Index i : pixels) {
    const Point p = map.grid.centre(i);
    u.include(dot(p, along));
    v.include(dot(p, across));
  }
  const Lattice lattice{along, across, Ticks(u, overrun, step), Ticks(v, overrun, options.pitch)};
  const double count = lattice.lines.count * lattice.steps.count;
  if (!(count <= kMaxPoints)) {
    throw InputError(
        fmt::format("raster: pitch = {} mm and step = {} mm make {:.0f} lines of {:.0f} points, {:.3g} in "
                    "all; at most {:.0e} accepted, make pitch or step larger",
                    options.pitch, step, lattice.lines.count, lattice.steps.count, count, kMaxPoints));
  }
  return lattice;
}

/// First and last wanted point of a line; first > last if it has none.
struct Run {
  Index first = std::numeric_limits<Index>::max();
  Index last = -1;

  void include(Index i) {
    first = std::min(first, i);
    last = std::max(last, i);
  }
  bool empty() const { return last < first; }
};

std::vector<Run> wanted_runs(const HeightMap& map, const std::vector<Index>& pixels, const Lattice& lattice,
                             double overrun) {
  const auto line_count = static_cast<Index>(lattice.lines.count);
  const auto step_count = static_cast<Index>(lattice.steps.count);
  std::vector<Run> runs(static_cast<std::size_t>(line_count));
  for (const Index i : pixels) {
    const Point p = map.grid.centre(i);
    const Index line = lattice.lines.nearest(dot(p, lattice.across));
    runs[static_cast<std::size_t>(line)].include(lattice.steps.nearest(dot(p, lattice.along)));
  }
  const DistanceMap distance(map, overrun);
  const double reach = overrun + kRounding * std::min(lattice.steps.step, lattice.lines.step);
  for (Index line = 0; line < line_count; ++line) {
    Run& run = runs[static_cast<std::size_t>(line)];
    const auto wanted = [&](Index i) { return distance.within(lattice.at(line, i), reach); };
    Index first = 0;
    while (first < std::min(run.first, step_count) && !wanted(first)) ++first;
    if (first == step_count) continue;
    run.include(first);
    Index last = step_count - 1;
    while (last > run.last && !wanted(last)) --last;
    run.include(last);
  }
  return runs;
}

}  // namespace

RasterOptions parse_raster_options(const SpecText& spec) {
  spec.accept_only({"pitch", "ripple", "step", "angle", "overrun", "order"});
  RasterOptions options;
  const std::optional<std::string> pitch = spec.word("pitch");
  options.auto_pitch = pitch == "auto";
  if (pitch && !options.auto_pitch && !parse_number(*pitch)) spec.reject("pitch", "a number in mm, or auto");
  if (!options.auto_pitch) options.pitch = spec.number("pitch");
  if (!options.auto_pitch && spec.has("ripple")) spec.reject("ripple", "pitch=auto with it");
  options.ripple = spec.number("ripple", options.ripple);
  options.step = spec.optional_number("step");
  options.angle_deg = spec.number("angle", options.angle_deg);
  options.overrun = spec.optional_number("overrun");
  options.serpentine = spec.choice("order", {"serpentine", "one-way"}) == "serpentine";
  return options;
}

ToolPath raster_path(const HeightMap& map, const RasterOptions& options) {
  const double step = options.step.value_or(options.pitch);
  const double overrun = options.overrun.value_or(0.0);
  check(options, step, overrun);
  const std::vector<Index> pixels = finite_pixels(map);
  if (pixels.empty()) throw InputError("raster: the map has no finite pixel; at least one is required");
  const Lattice lattice = make_lattice(map, pixels, options, step, overrun);
  const std::vector<Run> runs = wanted_runs(map, pixels, lattice, overrun);

  ToolPath path;
  path.kind = "raster";
  bool backwards = false;
  bool gap = true;
  for (Index line = 0; line < static_cast<Index>(runs.size()); ++line) {
    const Run& run = runs[static_cast<std::size_t>(line)];
    if (run.empty()) {
      gap = true;
      continue;
    }
    const bool lifted = gap || !options.serpentine;
    for (Index k = 0; k <= run.last - run.first; ++k) {
      path.points.push_back(lattice.at(line, backwards ? run.last - k : run.first + k));
      path.lifted.push_back(k == 0 && lifted ? 1 : 0);
    }
    backwards = options.serpentine && !backwards;
    gap = false;
  }
  return path;
}

}  // namespace dwell
