#include "paths/lines/multi_pitch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "paths/domain/box_mean.h"
#include "paths/domain/feed_direction.h"
#include "paths/domain/point_limit.h"
#include "paths/lines/region_raster.h"

namespace dwell {
namespace {

constexpr int kMostRanges = 100;
constexpr double kPositioning = 0.01;  // how finely a machine positions [mm]

[[noreturn]] void refuse(const char* option, double value, const char* unit, const char* required) {
  throw InputError(fmt::format("multi-pitch: {} = {}{}; required {}", option, value, unit, required));
}

void check_positive(const char* option, double value, const char* unit) {
  if (!(value > 0.0)) refuse(option, value, unit, "> 0");
  if (!std::isfinite(value)) refuse(option, value, unit, "finite");
}

void check_at_least_zero(const char* option, double value) {
  if (!(value >= 0.0)) refuse(option, value, " mm", ">= 0");
  if (!std::isfinite(value)) refuse(option, value, " mm", "finite");
}

/// The options, with defaults for those that are not given.
struct Settings {
  std::size_t ranges;
  double min_pitch, max_pitch, step, overrun, smooth;
};

void check_lists(const MultiPitchOptions& o) {
  for (const double pitch : o.pitches) check_positive("pitches", pitch, " mm");
  for (std::size_t k = 0; k < o.depths.size(); ++k) {
    check_positive("depths", o.depths[k], " nm");
    if (k > 0 && !(o.depths[k] > o.depths[k - 1])) {
      throw InputError(fmt::format("multi-pitch: depths = {} nm; required ascending", fmt::join(o.depths, "/")));
    }
  }
  if (!o.pitches.empty() && (o.min_pitch || o.max_pitch)) {
    throw InputError("multi-pitch: pitches are given; min-pitch and max-pitch are accepted without them only");
  }
  if (!o.pitches.empty() && !o.depths.empty() && o.pitches.size() != o.depths.size() + 1) {
    throw InputError(
        fmt::format("multi-pitch: {} pitches and {} depths between them; required one pitch more than depths",
                    o.pitches.size(), o.depths.size()));
  }
}

Settings settings_of(const MultiPitchOptions& o, const RemovalFunction& tif, double max_feed) {
  check_lists(o);
  const double size = 2.0 * tif.radius;
  Settings s{};
  if (o.ranges < 1 || o.ranges > kMostRanges) {
    throw InputError(fmt::format("multi-pitch: ranges = {}; required 1 to {}", o.ranges, kMostRanges));
  }
  s.ranges = !o.pitches.empty()  ? o.pitches.size()
             : !o.depths.empty() ? o.depths.size() + 1
                                 : static_cast<std::size_t>(o.ranges);
  if (s.ranges > static_cast<std::size_t>(kMostRanges)) {
    throw InputError(fmt::format("multi-pitch: {} ranges; at most {} accepted", s.ranges, kMostRanges));
  }
  s.max_pitch = o.max_pitch.value_or(size / 6.0);
  check_positive("max-pitch", s.max_pitch, " mm");
  s.min_pitch = o.min_pitch.value_or(std::min(std::max(kPositioning, size / 60.0), s.max_pitch));
  check_positive("min-pitch", s.min_pitch, " mm");
  if (s.min_pitch > s.max_pitch) {
    throw InputError(
        fmt::format("multi-pitch: min-pitch = {} mm; required at most max-pitch, {:.6g} mm", s.min_pitch, s.max_pitch));
  }
  s.step = o.step.value_or(size / 12.0);
  check_positive("step", s.step, " mm");
  s.overrun = o.overrun.value_or(tif.radius);
  check_at_least_zero("overrun", s.overrun);
  s.smooth = o.smooth.value_or(size / 6.0);
  check_at_least_zero("smooth", s.smooth);
  if (!std::isfinite(o.angle_deg)) refuse("angle", o.angle_deg, " degrees", "finite");
  if (!(o.lift >= 1.0)) refuse("lift", o.lift, " pitches", ">= 1");
  if (o.pitches.empty() && !(std::isfinite(max_feed) && max_feed > 0.0)) {
    throw InputError(
        fmt::format("multi-pitch: the pitches follow from the fastest feed, which is {} mm/s; required: a fastest feed "
                    "of the machine "
                    "(`max feed` MM/MIN), or pitches=D1/D2/... in mm, shallowest first",
                    max_feed));
  }
  return s;
}

std::vector<double> borders_of(const MultiPitchOptions& o, std::size_t ranges, double highest) {
  std::vector<double> borders{0.0};
  for (std::size_t k = 1; k < ranges; ++k) {
    borders.push_back(o.depths.empty() ? highest * static_cast<double>(k) / static_cast<double>(ranges)
                                       : o.depths[k - 1]);
  }
  borders.push_back(std::max(highest, borders.back()));
  return borders;
}

std::vector<PitchRegion> ranges_of(const MultiPitchOptions& o, const Settings& s, double highest, double volume,
                                   double max_feed) {
  const std::vector<double> borders = borders_of(o, s.ranges, highest);
  if (o.pitches.empty()) return pitches_by_depth(borders, volume, max_feed, s.min_pitch, s.max_pitch);
  std::vector<PitchRegion> ranges = pitches_by_depth(borders, 1.0, 1.0, 1.0, 1.0);
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    ranges[k].pitch = o.pitches[k];
    ranges[k].limit = PitchRegion::Limit::Given;
  }
  return ranges;
}

/// Joins neighbouring ranges of equal pitch, drops ranges without a pixel, and fills in the region of every pixel.
std::vector<PitchRegion> merged(const std::vector<PitchRegion>& ranges, const std::vector<double>& depth,
                                const std::vector<Index>& pixels, std::vector<std::int32_t>& region_of,
                                const Progress& progress) {
  Poll poll(progress);
  std::vector<std::size_t> pixels_in(ranges.size(), 0);
  std::vector<std::size_t> range_of(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    poll.step();
    const auto above = std::upper_bound(ranges.begin() + 1, ranges.end(), depth[i],
                                        [](double d, const PitchRegion& r) { return d < r.from; });
    range_of[i] = static_cast<std::size_t>(above - ranges.begin()) - 1;
    ++pixels_in[range_of[i]];
  }
  std::vector<PitchRegion> regions;
  std::vector<std::int32_t> region_of_range(ranges.size(), 0);
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    if (pixels_in[k] == 0) continue;
    if (regions.empty() || regions.back().pitch != ranges[k].pitch) {
      regions.push_back(ranges[k]);
    } else {
      regions.back().to = ranges[k].to;
    }
    regions.back().pixels += pixels_in[k];
    region_of_range[k] = static_cast<std::int32_t>(regions.size());
  }
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    region_of[static_cast<std::size_t>(pixels[i])] = region_of_range[range_of[i]];
  }
  return regions;
}

const char* said(PitchRegion::Limit limit) {
  switch (limit) {
    case PitchRegion::Limit::Narrowest:
      return " (narrowest accepted)";
    case PitchRegion::Limit::Widest:
      return " (widest accepted)";
    case PitchRegion::Limit::Given:
      return " (given)";
    case PitchRegion::Limit::None:
      break;
  }
  return "";
}

std::string note_of(const MultiPitchPath& result, std::size_t ranges) {
  std::vector<std::string> parts;
  for (const PitchRegion& r : result.regions) {
    parts.push_back(fmt::format("{:.4g} to {:.4g} nm, pitch {:.4g} mm{}", r.from, r.to, r.pitch, said(r.limit)));
  }
  return fmt::format(
      "{} range{} of removal depth above {:.4g} nm, in {} region{} of {:.4g} mm between dwell points: {}", ranges,
      ranges == 1 ? "" : "s", result.lowest, result.regions.size(), result.regions.size() == 1 ? "" : "s", result.step,
      fmt::join(parts, "; "));
}

/// The middle of the valid pixels' centres along the lines.
double middle_along(const Grid& grid, const std::vector<std::int32_t>& region_of, double angle_deg) {
  const Point along = feed_direction(angle_deg);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < region_of.size(); ++i) {
    if (region_of[i] == 0) continue;
    const Point p = grid.centre(static_cast<Index>(i));
    low = std::min(low, p.x * along.x + p.y * along.y);
    high = std::max(high, p.x * along.x + p.y * along.y);
  }
  return 0.5 * (low + high);
}

void raster_regions(const HeightMap& map, const MultiPitchOptions& options, const Settings& s,
                    const std::vector<std::int32_t>& region_of, MultiPitchPath& result, const Progress& progress) {
  std::vector<double> reaches;
  const double pixel = 0.5 * std::hypot(map.grid.pitch_x, map.grid.pitch_y);
  for (const PitchRegion& r : result.regions) {
    reaches.push_back(std::max({s.overrun, 0.5 * std::hypot(r.pitch, s.step), pixel}));
  }
  const RegionLabels labels(map, region_of, reaches, "multi-pitch", progress);
  progress.check();
  std::vector<std::vector<Index>> pixels(result.regions.size());
  for (std::size_t i = 0; i < region_of.size(); ++i) {
    if (region_of[i] > 0) pixels[static_cast<std::size_t>(region_of[i] - 1)].push_back(static_cast<Index>(i));
  }
  const double anchor = middle_along(map.grid, region_of, options.angle_deg);
  for (std::size_t k = 0; k < result.regions.size(); ++k) {
    PitchRegion& region = result.regions[k];
    region.first_point = result.path.size();
    const double link = options.lift * std::max(region.pitch, s.step);
    const RegionLines lines{static_cast<std::int32_t>(k + 1),
                            region.pitch,
                            s.step,
                            options.angle_deg,
                            anchor,
                            reaches[k],
                            link,
                            kMaxPathPoints - static_cast<double>(result.path.size())};
    region.lifts = append_region(labels, map.grid, pixels[k], lines, result.path, progress);
    region.points = result.path.size() - region.first_point;
  }
}

std::vector<double> numbers_of(const SpecText& spec, const char* key) {
  std::vector<double> numbers;
  const std::optional<std::string> word = spec.word(key);
  for (std::size_t begin = 0; word && begin <= word->size();) {
    const std::size_t end = std::min(word->find('/', begin), word->size());
    const std::optional<double> number = parse_number(word->substr(begin, end - begin));
    if (!number || std::isnan(*number)) spec.reject(key, "numbers with slashes between, for instance 0.8/0.4/0.2");
    numbers.push_back(*number);
    begin = end + 1;
  }
  return numbers;
}

}  // namespace

MultiPitchOptions parse_multi_pitch_options(const SpecText& spec) {
  spec.accept_only(
      {"ranges", "pitches", "depths", "min-pitch", "max-pitch", "step", "angle", "overrun", "lift", "smooth"});
  MultiPitchOptions options;
  options.pitches = numbers_of(spec, "pitches");
  options.depths = numbers_of(spec, "depths");
  if (spec.has("ranges")) {
    const double ranges = spec.number("ranges");
    if (!(ranges >= 1.0 && ranges <= kMostRanges && ranges == std::floor(ranges))) {
      spec.reject("ranges", fmt::format("a whole number, 1 to {}", kMostRanges));
    }
    if (!options.pitches.empty() || !options.depths.empty()) {
      spec.reject("ranges", "none: pitches or depths say how many ranges there are");
    }
    options.ranges = static_cast<int>(ranges);
  }
  options.min_pitch = spec.optional_number("min-pitch");
  options.max_pitch = spec.optional_number("max-pitch");
  options.step = spec.optional_number("step");
  options.angle_deg = spec.number("angle", options.angle_deg);
  options.overrun = spec.optional_number("overrun");
  options.lift = spec.number("lift", options.lift);
  options.smooth = spec.optional_number("smooth");
  return options;
}

std::vector<PathDistance> multi_pitch_distances(const MultiPitchOptions& options) {
  std::vector<PathDistance> distances{{"step", options.step.value_or(0.0)},
                                      {"min-pitch", options.min_pitch.value_or(0.0)},
                                      {"max-pitch", options.max_pitch.value_or(0.0)}};
  for (const double pitch : options.pitches) distances.push_back({"pitches", pitch});
  return distances;
}

std::vector<double> MultiPitchPath::pitch_of_points() const {
  std::vector<double> pitch(path.size());
  for (const PitchRegion& region : regions) {
    std::fill_n(pitch.begin() + static_cast<std::ptrdiff_t>(region.first_point), region.points, region.pitch);
  }
  return pitch;
}

std::vector<PitchRegion> pitches_by_depth(const std::vector<double>& borders, double volume, double max_feed,
                                          double min_pitch, double max_pitch) {
  std::vector<PitchRegion> ranges;
  for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
    PitchRegion range;
    range.from = borders[k];
    range.to = borders[k + 1];
    range.depth = k == 0 ? 0.5 * borders[1] : borders[k];
    range.pitch = range.depth > 0.0 ? volume / (range.depth * max_feed) : std::numeric_limits<double>::infinity();
    if (range.pitch > max_pitch) {
      range.pitch = max_pitch;
      range.limit = PitchRegion::Limit::Widest;
    } else if (range.pitch < min_pitch) {
      range.pitch = min_pitch;
      range.limit = PitchRegion::Limit::Narrowest;
    }
    ranges.push_back(range);
  }
  return ranges;
}

MultiPitchPath multi_pitch_path(const HeightMap& map, const RemovalFunction& tif, double max_feed,
                                const MultiPitchOptions& options, const Progress& progress) {
  const Settings settings = settings_of(options, tif, max_feed);
  const std::vector<Index> pixels = finite_pixels(map);
  if (pixels.empty()) throw InputError("multi-pitch: the map has no finite pixel; at least one is required");
  const HeightMap smoothed = box_mean(map, settings.smooth, progress);
  std::vector<double> depth;
  depth.reserve(pixels.size());
  for (const Index i : pixels) depth.push_back(smoothed.values[static_cast<std::size_t>(i)]);
  const auto [low, high] = std::minmax_element(depth.begin(), depth.end());
  const double lowest = *low, highest = *high - *low;
  for (double& d : depth) d -= lowest;

  MultiPitchPath result;
  result.path.kind = "multi-pitch";
  result.lowest = lowest;
  result.step = settings.step;
  std::vector<std::int32_t> region_of(map.values.size(), 0);
  result.regions =
      merged(ranges_of(options, settings, highest, tif.volume, max_feed), depth, pixels, region_of, progress);
  raster_regions(map, options, settings, region_of, result, progress);
  result.path.notes.push_back(note_of(result, settings.ranges));
  return result;
}

}  // namespace dwell
