#include "runs/map_steps/map_pair_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"
#include "core/base/whole_file.h"
#include "core/map/map_arithmetic.h"
#include "core/map/map_warp.h"
#include "core/map/value_units.h"
#include "core/numerics/point_fit.h"
#include "solvers/fits/ceres_map_registration.h"

namespace dwell {
namespace {

std::optional<double> number_within(const MapStep& step, const std::string& name, const ValueRange& range) {
  const auto value = step.optional_number(name);
  if (value && !range.holds(*value)) step.refuse(fmt::format("{} = {}; required {}", name, *value, range.text()));
  return value;
}

/// A unit of its own: what the first map's options say of waves is not said of this one.
void take_unit(const std::string& unit, MapReadOptions& read) {
  read.waves = {is_wave_unit(unit), {}, {}};
  read.scale.reset();
  if (!read.waves.in_waves) read.scale = height_unit_nm(unit);
}

/// Another map, read as the first was unless the step has its own pixel, unit or origin; table and gridding are those
/// of the first map's file alone.
HeightMap read_other(const std::string& file, const MapStep& step, MapStepContext& context) {
  MapReadOptions read = context.read;
  read.table.reset();
  read.rows.reset();
  read.grid.reset();
  if (const auto pixel = step.pitch("pixel")) read.pitch = *pixel;
  if (const auto origin = step.point("origin")) read.origin = *origin;
  if (step.has("unit")) take_unit(step.word("unit"), read);
  if (const auto nm = number_within(step, "wavelength", ranges::kWavelength)) read.waves.wavelength = nm;
  if (const auto scale = number_within(step, "wave-scale", ranges::kWaveScale)) read.waves.scale = scale;
  HeightMap map = read_map(file, read, context.progress);
  context.inputs->push_back({step.record->name, file, sha256_of_file(file)});
  return map;
}

RegistrationOptions registration_options(const HeightMap& moving, const MapStep& step) {
  RegistrationOptions options;
  options.rotation = !step.has("no-rotation");
  options.scale = step.has("scale");
  options.level = !step.has("no-level");
  const double side = std::max(moving.grid.width(), moving.grid.height());
  options.range = {step.optional_number("shift").value_or(0.1 * side), step.optional_number("degrees").value_or(3.0)};
  if (!(options.range.shift >= 0.0 && options.range.degrees >= 0.0 && options.range.degrees <= 180.0)) {
    step.refuse("shift >= 0 mm and degrees from 0 to 180 are required");
  }
  return options;
}

std::string describe_registration(const MapRegistration& r, const RegistrationOptions& options) {
  return fmt::format(
      "looked {:.4g} mm and {:.4g} degrees each way; moved by {:.6g} +- {:.2g} mm in x and {:.6g} +- {:.2g} mm in y, "
      "turned by {:.6g} +- {:.2g} degrees, scaled by "
      "{:.8g} +- {:.2g}; difference {:.5g} nm RMS (robust {:.5g}) before, {:.5g} nm (robust {:.5g}) after, {}; "
      "lone "
      "spikes left out of the fit: {} of the map moved, {} of the other",
      options.range.shift, options.range.degrees, r.x.value, r.x.error, r.y.value, r.y.error, r.degrees.value,
      r.degrees.error, r.scale.value, r.scale.error, r.before.rms, r.before.scatter, r.after.rms, r.after.scatter,
      counted(r.points, "pixel"), r.spikes_moving, r.spikes_fixed);
}

std::vector<Point> points_of(const MapStep& step, const std::string& name) {
  std::vector<double> numbers;
  const std::string text = step.word(name);
  for (const std::string_view field : split(text, '/')) {
    const auto value = finite_number(field);
    if (!value) step.refuse(fmt::format("{}: '{}' is not a finite number; X/Y/X/Y/... in mm required", name, field));
    if (!ranges::kPlace.holds(*value))
      step.refuse(fmt::format("{}: '{}'; required {}", name, field, ranges::kPlace.text()));
    numbers.push_back(*value);
  }
  if (numbers.size() % 2 != 0) {
    step.refuse(fmt::format("{} has {}; X/Y/X/Y/... in mm required", name, counted(numbers.size(), "number")));
  }
  std::vector<Point> points;
  for (std::size_t i = 0; i < numbers.size(); i += 2) points.push_back({numbers[i], numbers[i + 1]});
  return points;
}

}  // namespace

std::string subtract_map(HeightMap& map, const MapStep& step, MapStepContext& context) {
  const std::string how = step.word("how");
  if (how != "strict" && how != "resample" && how != "register") {
    step.refuse(fmt::format("how = '{}'; accepted: strict, resample or register", how));
  }
  HeightMap other = read_other(step.word("file"), step, context);
  std::string what;
  if (how == "resample") {
    other = warp_map(other, {}, map.grid, context.threads, context.progress);
    what = "resampled; ";
  } else if (how == "register") {
    const RegistrationOptions options = registration_options(other, step);
    const MapRegistration found = register_maps(other, map, options, context.threads, context.progress);
    other = warp_map(other, found.transform, map.grid, context.threads, context.progress);
    what = describe_registration(found, options) + "; ";
  } else if (const std::string why = grid_difference(map.grid, other.grid); !why.empty()) {
    step.refuse(why + ", or give 'resample' or 'register'");
  }
  map = difference(map, other);
  return what + fmt::format("{} with data in both", counted(map.valid_pixels(), "pixel"));
}

std::string average_maps(HeightMap& map, const MapStep& step, MapStepContext& context) {
  const std::vector<std::string> files = step.values("files");
  const auto count = static_cast<Index>(files.size()) + 1;
  const Index least = step.has("least") ? step.whole("least", 1, count) : count;
  std::vector<HeightMap> maps{map};
  for (const std::string& file : files) {
    HeightMap other = read_other(file, step, context);
    if (step.has("resample")) other = warp_map(other, {}, map.grid, context.threads, context.progress);
    if (const std::string why = grid_difference(map.grid, other.grid); !why.empty()) {
      step.refuse(fmt::format("{}: {}, or give 'resample'", file, why));
    }
    maps.push_back(std::move(other));
  }
  map = mean_map(maps, least);
  return fmt::format("{}, {} with data in at least {}", counted(count, "map"), counted(map.valid_pixels(), "pixel"),
                     least);
}

std::string register_on_map(HeightMap& map, const MapStep& step, MapStepContext& context) {
  const HeightMap other = read_other(step.word("to"), step, context);
  const RegistrationOptions options = registration_options(map, step);
  const MapRegistration found = register_maps(map, other, options, context.threads, context.progress);
  map = warp_map(map, found.transform, other.grid, context.threads, context.progress);
  return describe_registration(found, options);
}

std::string move_by_fiducials(HeightMap& map, const MapStep& step, MapStepContext& context) {
  const std::vector<Point> from = points_of(step, "from"), to = points_of(step, "to");
  if (from.size() != to.size()) {
    step.refuse(fmt::format("{} in from, {} in to; equally many required", counted(from.size(), "point"), to.size()));
  }
  std::vector<PointPair> pairs;
  for (std::size_t i = 0; i < from.size(); ++i) pairs.push_back({from[i], to[i]});
  const PointFit fit = fit_points(pairs, parse_point_fit_kind(step.word("fit")));
  const PlaneTransform& t = fit.transform;
  map = warp_map(map, t, covering_grid(map.grid, t, context.limit()), context.threads, context.progress);
  const double degrees = std::atan2(t.yx - t.xy, t.xx + t.yy) * 180.0 / std::numbers::pi;
  std::string text =
      fmt::format("turned by {:.6g} degrees, scaled by {:.8g}, the origin to ({:.6g}, {:.6g}) mm; left: ", degrees,
                  std::sqrt(std::abs(t.determinant())), t.shift.x, t.shift.y);
  for (const Point& r : fit.residuals) text += fmt::format("({:.3g}, {:.3g}) ", r.x, r.y);
  return text + fmt::format("mm, {:.3g} mm RMS", fit.rms);
}

}  // namespace dwell
