#include "core/tif/calibration/trench_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/rotation.h"
#include "core/base/units.h"
#include "core/base/value_range.h"
#include "core/map/robust_plane.h"
#include "core/numerics/median.h"
#include "core/tif/calibration/spot_finder.h"

namespace dwell {
namespace {

constexpr double kTrenchRadiusInExtents = 2.25;
constexpr double kTrenchRing = 1.6;

/// A pixel in the frame of the track.
struct TrackPixel {
  double u, v, depth;
};

/// Means of values over equal stretches of a coordinate.
struct Bins {
  double first = 0.0, width = 1.0;
  std::vector<double> sum, square, place;
  std::vector<Index> count;

  Bins(double from, double to, double w) : first(from), width(w) {
    const auto n = static_cast<std::size_t>(std::max(1.0, std::ceil((to - from) / w)));
    sum.assign(n, 0.0), square.assign(n, 0.0), place.assign(n, 0.0), count.assign(n, 0);
  }
  void add(double at, double value) {
    const double k = std::floor((at - first) / width);
    if (!(k >= 0.0 && k < static_cast<double>(sum.size()))) return;
    const auto i = static_cast<std::size_t>(k);
    sum[i] += value, square[i] += value * value, place[i] += at, ++count[i];
  }
  double mean(std::size_t i) const { return sum[i] / static_cast<double>(count[i]); }
  double at(std::size_t i) const { return place[i] / static_cast<double>(count[i]); }
};

void check(const TrenchOptions& o) {
  check_range("feed", units::mm_per_min(o.feed), ranges::kFeed);
  if (o.direction) check_range("direction", *o.direction, ranges::kAngle);
  if (o.radius) check_range("radius", *o.radius, ranges::kSize);
  if (!(o.noise_cut >= 0.0 && o.noise_cut <= 0.5)) {
    throw InputError("noise cut", fmt::format("{}", o.noise_cut), "a share of the peak from 0 to 0.5");
  }
}

/// The depth less the robust plane of the map.
HeightMap without_plane(const HeightMap& depth) {
  const std::vector<Index> pixels = finite_pixels(depth);
  if (pixels.size() < 100) {
    throw InputError(
        fmt::format("{} with data; at least 100 are required for a trench", counted(pixels.size(), "pixel")));
  }
  const Plane plane = robust_plane(depth, pixels, true);
  HeightMap result = depth;
  for (const Index i : pixels) result.values[static_cast<std::size_t>(i)] -= plane.at(depth.grid.centre(i));
  return result;
}

std::vector<TrackPixel> in_track_frame(const HeightMap& depth, double direction) {
  const Rotation turn(direction);
  std::vector<TrackPixel> result;
  for (const Index i : finite_pixels(depth)) {
    const Point q = turn.back(depth.grid.centre(i));
    result.push_back({q.x, q.y, depth.values[static_cast<std::size_t>(i)]});
  }
  return result;
}

/// Refuses what is higher after than before, by the extremes that one pixel in 200 exceeds.
void refuse_risen_trench(const HeightMap& depth) {
  constexpr std::size_t kOneIn = 200;
  std::vector<double> values;
  for (const Index i : finite_pixels(depth)) values.push_back(depth.values[static_cast<std::size_t>(i)]);
  const std::size_t away = values.size() / kOneIn;
  std::sort(values.begin(), values.end());
  const double rise = -values[away], fall = values[values.size() - 1 - away];
  if (rise > 2.0 * fall) refuse_rise(rise, fall);
  if (!(fall > 0.0)) throw InputError("no trench found: the map is flat");
}

/// The direction to work with: the fitted one, or a given one that agrees with it.
void choose_direction(const HeightMap& depth, const TrenchOptions& options, TrenchCalibration& trench) {
  trench.fitted = fit_trench_direction(depth);
  if (!trench.fitted && !options.direction) {
    throw InputError(
        "the map does not show the direction of the trench: what is deep is not longer than it is wide, or the map "
        "shows "
        "too little around it; give `direction` in degrees, counter-clockwise from +x");
  }
  trench.direction = options.direction ? *options.direction : trench.fitted->degrees;
  if (!trench.fitted || !options.direction) return;
  const double off = angle_between_tracks(*options.direction, trench.fitted->degrees),
               most = direction_tolerance(*trench.fitted);
  if (off <= most) return;
  throw InputError(
      fmt::format("`direction` = {:g} deg disagrees with the trench in the map, which runs at {:.4g} +- {:.2g} deg, by "
                  "{:.3g} deg; at most {:.2g} deg is accepted, or no `direction`: then the fitted one is taken",
                  *options.direction, trench.fitted->degrees, trench.fitted->standard_error, off, most));
}

/// Middle and half width of what is deeper than 30 % of the deepest, of the mean across all of the track.
void locate(const std::vector<TrackPixel>& pixels, double pitch, TrenchCalibration& trench, double& extent) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const TrackPixel& p : pixels) low = std::min(low, p.v), high = std::max(high, p.v);
  Bins across(low, high + 1e-9 * pitch, pitch);
  for (const TrackPixel& p : pixels) across.add(p.v, p.depth);
  double deepest = 0.0, highest = 0.0;
  const auto counts = [&](std::size_t i) { return across.count[i] >= 5; };
  for (std::size_t i = 0; i < across.sum.size(); ++i) {
    if (!counts(i)) continue;
    deepest = std::max(deepest, across.mean(i));
    highest = std::max(highest, -across.mean(i));
  }
  if (highest > 2.0 * deepest) refuse_rise(highest, deepest);
  if (!(deepest > 0.0)) throw InputError("no trench found: the map is flat");
  double sum = 0.0, moment = 0.0, left = HUGE_VAL, right = -HUGE_VAL;
  for (std::size_t i = 0; i < across.sum.size(); ++i) {
    if (!counts(i) || across.mean(i) < 0.3 * deepest) continue;
    sum += across.mean(i), moment += across.mean(i) * across.at(i);
    left = std::min(left, across.at(i)), right = std::max(right, across.at(i));
  }
  trench.middle = moment / sum;
  extent = std::max(0.5 * (right - left), pitch);
  if (left - low < 0.2 * extent || high - right < 0.2 * extent || right - left > 0.6 * (high - low)) {
    throw InputError(
        fmt::format("no trench found: what is deeper than 30 % of the deepest spans {:.4g} to {:.4g} mm of {:.4g} "
                    "to {:.4g} mm across the direction; check `direction`, or measure more of its surroundings",
                    left, right, low, high));
  }
}

/// The longest stretch of the track where the volume per length is within 5 % of its median.
void choose_stretch(const std::vector<TrackPixel>& pixels, TrenchCalibration& trench, double pitch) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const TrackPixel& p : pixels) {
    if (std::abs(p.v - trench.middle) > trench.radius) continue;
    low = std::min(low, p.u), high = std::max(high, p.u);
  }
  Bins along(low, high + 1e-9 * pitch, std::max(3.0 * pitch, trench.radius / 6.0));
  for (const TrackPixel& p : pixels) {
    if (std::abs(p.v - trench.middle) <= trench.radius) along.add(p.u, p.depth);
  }
  std::vector<double> volumes;
  const Index full = *std::max_element(along.count.begin(), along.count.end());
  const auto whole = [&](std::size_t i) { return along.count[i] * 2 >= full; };
  double most = 0.0;
  for (std::size_t i = 0; i < along.sum.size(); ++i) {
    if (whole(i)) most = std::max(most, along.mean(i));
  }
  for (std::size_t i = 0; i < along.sum.size(); ++i) {
    if (whole(i) && along.mean(i) > 0.5 * most) volumes.push_back(along.mean(i));
  }
  const double usual = volumes.empty() ? 0.0 : upper_median(volumes);
  std::size_t best_from = 0, best_to = 0;
  for (std::size_t i = 0, from = 0; i <= along.sum.size(); ++i) {
    const bool good = i < along.sum.size() && whole(i) && std::abs(along.mean(i) - usual) <= 0.05 * usual;
    if (good) continue;
    if (i - from > best_to - best_from) best_from = from, best_to = i;
    from = i + 1;
  }
  trench.from = along.first + along.width * static_cast<double>(best_from);
  trench.to = along.first + along.width * static_cast<double>(best_to);
  if (!(trench.to - trench.from >= trench.radius)) {
    throw InputError(
        fmt::format("the trench is even over only {:.4g} mm; at least its radius, {:.4g} mm, is required (check "
                    "`direction`, and that the feed was constant)",
                    trench.to - trench.from, trench.radius));
  }
}

/// The means of the bins, less a line, times the feed.
std::vector<LineIntegral> section_of(const Bins& across, const Plane& line, double feed) {
  std::vector<LineIntegral> section;
  for (std::size_t i = 0; i < across.sum.size(); ++i) {
    if (across.count[i] < 3) continue;
    const double v = across.at(i);
    section.push_back({v, feed * (across.mean(i) - line.at({v, 0.0})), static_cast<double>(across.count[i])});
  }
  return section;
}

/// The mean cross-section over the stretch, less the line through its surroundings, which it returns, times the feed.
Plane cut_section(const std::vector<TrackPixel>& pixels, TrenchCalibration& trench, double pitch, double feed) {
  const double outer = kTrenchRing * trench.radius;
  Bins across(trench.middle - outer, trench.middle + outer, pitch);
  for (const TrackPixel& p : pixels) {
    if (p.u >= trench.from && p.u <= trench.to) across.add(p.v, p.depth);
  }
  std::vector<double> places, means;
  double square = 0.0;
  Index count = 0;
  HeightMap ring(Grid{1, static_cast<Index>(across.sum.size()), pitch, pitch, {across.first, 0.0}});
  std::vector<Index> ring_pixels;
  for (std::size_t i = 0; i < across.sum.size(); ++i) {
    if (across.count[i] < 3 || std::abs(across.at(i) - trench.middle) < trench.radius) continue;
    ring.values[i] = across.mean(i);
    ring_pixels.push_back(static_cast<Index>(i));
    square += across.square[i] - across.sum[i] * across.mean(i);
    count += across.count[i] - 1;
  }
  if (ring_pixels.size() < 6) {
    throw InputError(
        fmt::format("the surroundings of the trench have data at only {} across beyond {:.4g} mm; at "
                    "least 6 are required (a smaller `radius`)",
                    counted(ring_pixels.size(), "place"), trench.radius));
  }
  const Plane line = robust_plane(ring, ring_pixels, true);
  trench.scatter = std::sqrt(std::max(0.0, square / static_cast<double>(count)));
  trench.section = section_of(across, line, feed);
  for (const LineIntegral& s : trench.section) trench.depth = std::max(trench.depth, s.value / feed);
  return line;
}

/// A section's value at a place between its own; 0 beyond.
double value_at(const std::vector<LineIntegral>& section, double v) {
  for (std::size_t i = 1; i < section.size(); ++i) {
    const LineIntegral &a = section[i - 1], &b = section[i];
    if (a.offset <= v && v <= b.offset) return a.value + (b.value - a.value) * (v - a.offset) / (b.offset - a.offset);
  }
  return 0.0;
}

/// Moves the middle to the centroid of the section.
void centre_section(TrenchCalibration& trench, double feed) {
  double sum = 0.0, moment = 0.0;
  for (const LineIntegral& s : trench.section) {
    const double above = s.value - 0.1 * feed * trench.depth;
    if (above <= 0.0 || std::abs(s.offset - trench.middle) > trench.radius) continue;
    sum += above, moment += above * s.offset;
  }
  trench.middle = moment / sum;
  for (LineIntegral& s : trench.section) s.offset -= trench.middle;
}

/// How odd the sections of both halves of the stretch are about the middle of the whole.
double asymmetry_of_halves(const std::vector<TrackPixel>& pixels, const TrenchCalibration& trench, const Plane& line,
                           double pitch, double feed) {
  const double outer = kTrenchRing * trench.radius, half = 0.5 * (trench.from + trench.to);
  double odd = 0.0, even = 0.0;
  for (const auto& [from, to] : {std::pair{trench.from, half}, {half, trench.to}}) {
    Bins across(trench.middle - outer, trench.middle + outer, pitch);
    for (const TrackPixel& p : pixels) {
      if (p.u >= from && p.u <= to) across.add(p.v, p.depth);
    }
    const std::vector<LineIntegral> section = section_of(across, line, feed);
    for (const LineIntegral& s : section) {
      if (std::abs(s.offset - trench.middle) > trench.radius) continue;
      const double mirror = value_at(section, 2.0 * trench.middle - s.offset);
      odd += std::pow(s.value - mirror, 2), even += std::pow(s.value + mirror, 2);
    }
  }
  return std::sqrt(odd / even);
}

HeightMap radial_map(const RadialProfile& profile, double radius, double pitch, double noise_cut) {
  const auto half = static_cast<Index>(std::ceil(radius / pitch));
  HeightMap map(Grid{2 * half + 1,
                     2 * half + 1,
                     pitch,
                     pitch,
                     {-pitch * static_cast<double>(half), -pitch * static_cast<double>(half)}});
  double peak = 0.0;
  for (const double v : profile.values) peak = std::max(peak, v);
  for (Index i = 0; i < map.grid.size(); ++i) {
    const double r = length(map.grid.centre(i));
    const double v = r <= radius ? profile(r) : 0.0;
    map.values[static_cast<std::size_t>(i)] = v < noise_cut * peak ? 0.0 : v;
  }
  map.quantity = MapQuantity::Rate;
  return map;
}

}  // namespace

TrenchCalibration calibrate_trench(const HeightMap& depth, const TrenchOptions& options) {
  check(options);
  const HeightMap flat = without_plane(depth);
  refuse_risen_trench(flat);
  const double pitch = std::max(depth.grid.pitch_x, depth.grid.pitch_y);
  TrenchCalibration trench;
  choose_direction(flat, options, trench);
  const std::vector<TrackPixel> pixels = in_track_frame(flat, trench.direction);
  double extent = 0.0;
  locate(pixels, pitch, trench, extent);
  trench.radius = options.radius.value_or(kTrenchRadiusInExtents * extent);
  choose_stretch(pixels, trench, pitch);
  const Plane line = cut_section(pixels, trench, pitch, options.feed);
  centre_section(trench, options.feed);
  trench.asymmetry = asymmetry_of_halves(pixels, trench, line, pitch, options.feed);
  const int steps = static_cast<int>(std::clamp(trench.radius / pitch, 8.0, 80.0));
  trench.profile = abel_inversion(trench.section, trench.radius, steps);
  trench.rates = radial_map(trench.profile, trench.radius, pitch, options.noise_cut);
  trench.rates.history = depth.history;
  trench.rates.history.push_back(
      fmt::format("tif: trench at {} mm/s along {:.6g} deg ({}), mean over {:.4g} mm, inverse Abel transform on {} "
                  "radii to {:.4g} mm",
                  options.feed, trench.direction, options.direction ? "given" : "fitted", trench.to - trench.from,
                  steps, trench.radius));
  return trench;
}

}  // namespace dwell
