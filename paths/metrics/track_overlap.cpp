#include "paths/metrics/track_overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/grid.h"

namespace dwell {
namespace {

constexpr double kNarrowest = 0.02;  // of the diameter
constexpr double kGrowth = 1.01;
constexpr double kMostOverlap = 0.99;

double highest(const TrackProfile& profile) {
  constexpr Index kSamples = 4096;
  double most = 0.0;
  for (Index i = 0; i <= kSamples; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kSamples);
    most = std::max(most, profile.value(profile.low + share * (profile.high - profile.low)));
  }
  return most;
}

void check_diameter(double diameter) {
  if (std::isfinite(diameter) && diameter > 0.0) return;
  throw InputError(fmt::format("overlap: diameter = {} mm; required finite and > 0", diameter));
}

double rounded_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return unit * std::floor(value / unit * (1.0 + 1e-12));
}

}  // namespace

TrackOverlap track_overlap(const TrackProfile& section, double diameter, double overlap) {
  check_diameter(diameter);
  if (!(overlap >= 0.0 && overlap <= kMostOverlap)) {
    throw InputError(fmt::format("overlap = {}; required 0 to {}", overlap, kMostOverlap));
  }
  const double pitch = (1.0 - overlap) * diameter;
  return {overlap, pitch, periodic_sum(section, pitch, "overlap: pitch").deviation / highest(section)};
}

TrackOverlap best_overlap(const TrackProfile& section, double diameter, const std::vector<double>& overlaps) {
  if (overlaps.empty()) throw InputError("overlap: none to choose from; at least one is required");
  std::vector<TrackOverlap> tracks;
  tracks.reserve(overlaps.size());
  for (const double overlap : overlaps) tracks.push_back(track_overlap(section, diameter, overlap));
  return *std::min_element(tracks.begin(), tracks.end(),
                           [](const auto& a, const auto& b) { return a.deviation < b.deviation; });
}

AutoPitch widest_pitch(const TrackProfile& line, double diameter, double most) {
  check_diameter(diameter);
  if (!(most > 0.0 && most < 1.0)) {
    throw InputError(fmt::format("raster: ripple = {}; required > 0 and < 1 (peak to valley over removal)", most));
  }
  const auto even = [&](double pitch) { return raster_ripple(line, pitch, 1.0).pvn <= most; };
  double good = kNarrowest * diameter;
  if (!even(good)) {
    throw InputError(fmt::format(
        "raster: ripple = {}: lines {:.4g} mm apart, a fiftieth of the removal function's size, leave {:.3g} of "
        "the removal; required: a larger ripple, or a pitch in mm",
        most, good, raster_ripple(line, good, 1.0).pvn));
  }
  double bad = good * kGrowth;
  while (bad < diameter && even(bad)) {
    good = bad;
    bad *= kGrowth;
  }
  while (bad > good * (1.0 + 1e-4)) {
    const double middle = 0.5 * (good + bad);
    (even(middle) ? good : bad) = middle;
  }
  const double pitch = rounded_down(std::min(good, diameter));
  return {raster_ripple(line, pitch, 1.0), track_overlap(line, diameter, std::max(0.0, 1.0 - pitch / diameter))};
}

}  // namespace dwell
