#include "core/formats/wave_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr std::string_view kScaleApplied = "wave scale ";  // begins the step of a history that says so
constexpr const char* kWhatScaleIs =
    "`wave scale`, the height of the surface for each of them: 0.5 for a mirror measured at normal incidence, 1 where "
    "they are heights of the surface";

bool scale_was_applied(const MapHeader& header) {
  return std::any_of(header.history.begin(), header.history.end(),
                     [](const std::string& step) { return step.starts_with(kScaleApplied); });
}

bool is_in_waves(const MapHeader& header) { return header.unit && is_wave_unit(*header.unit); }

/// The wavelength of file and option [nm], which must agree as well as wavelengths are rounded (633 for 632.8).
std::optional<double> known_wavelength(const WaveOptions& options, const MapHeader& header, bool in_waves,
                                       const std::string& name, const std::string& where) {
  constexpr double kSameWavelength = 1e-3;
  if (!options.wavelength) return header.wavelength;
  if (!in_waves && !header.from_waves) {
    throw InputError(
        fmt::format("{}: `wavelength` is {} nm, but the values are not in waves; leave it out, or give "
                    "`{} unit` waves",
                    where, *options.wavelength, name));
  }
  if (header.wavelength &&
      !(std::abs(*header.wavelength - *options.wavelength) <= kSameWavelength * *header.wavelength)) {
    throw InputError(
        fmt::format("{}: {} says a wavelength of {:.6g} nm, but `wavelength` {} nm; they must agree (or "
                    "the option be left out)",
                    where, header.wave_field, *header.wavelength, *options.wavelength));
  }
  return options.wavelength;
}

/// Refuses an option that says another scale than the file, or one more after the file's own.
void check_stated_scale(const WaveOptions& options, const MapHeader& header, const std::string& where) {
  constexpr double kSameScale = 1e-5;  // single precision
  if (!options.scale) return;
  if (header.wave_scale && !(std::abs(*header.wave_scale - *options.scale) <= kSameScale * *options.scale)) {
    throw InputError(
        fmt::format("{}: {} says {} wavelengths of height to a wave, but `wave scale` {}; they must agree (or the "
                    "option be left out)",
                    where, header.wave_field, fewest_digits(*header.wave_scale), *options.scale));
  }
  if (!header.wave_scale && scale_was_applied(header)) {
    throw InputError(
        fmt::format("{}: `wave scale` is {}, but the file's history says that one was applied when it was made; its "
                    "values are heights: leave the option out",
                    where, *options.scale));
  }
}

void require_wave_options(const std::optional<double>& wavelength, const WaveOptions& options, const MapHeader& header,
                          const std::string& name, const std::string& where) {
  if (wavelength && options.scale) return;
  const std::string unit =
      header.unit ? fmt::format("header says unit {}", *header.unit) : fmt::format("`{} unit` says waves", name);
  if (name != "map") {
    throw InputError(
        fmt::format("{}: {}; nm, um, mm or m is required here: of surfaces with spots, only the command "
                    "tif reads maps in waves",
                    where, unit));
  }
  throw InputError(fmt::format("{}: {}; required: {}{}{}", where, unit, wavelength ? "" : "`wavelength` [nm]",
                               wavelength || options.scale ? "" : " and ", options.scale ? "" : kWhatScaleIs));
}

}  // namespace

bool states_wave_scale(const MapHeader& header) { return header.wave_scale.has_value() || scale_was_applied(header); }

void check_wave_options(const WaveOptions& options, const std::string& where) {
  for (const auto& [what, value] : {std::pair("wavelength", options.wavelength), {"wave scale", options.scale}}) {
    if (!value || (std::isfinite(*value) && *value > 0.0)) continue;
    throw InputError(what, fmt::format("{}", *value), "a finite number > 0",
                     fmt::format("`{}` = {} for {}; a finite number > 0 is required", what, *value, where));
  }
}

WaveReading read_waves(const WaveOptions& options, MapHeader& header, MapQuantity quantity, const std::string& name,
                       const std::string& where) {
  if (quantity == MapQuantity::Rate) {
    if (!options.in_waves && !options.wavelength && !options.scale) return {};
    throw InputError(
        fmt::format("{}: waves, `wavelength` and `wave scale` are for heights, but these are rates", where));
  }
  const bool in_waves = is_in_waves(header) || (options.in_waves && !header.unit);
  if (options.in_waves && !in_waves && !header.from_waves) {
    throw InputError(fmt::format("{}: header says unit {}, but `{} unit` says waves; they must agree: leave it out",
                                 where, *header.unit, name));
  }
  const std::optional<double> wavelength = known_wavelength(options, header, in_waves, name, where);
  check_stated_scale(options, header, where);
  if (header.wave_scale) return {};
  if (in_waves) require_wave_options(wavelength, options, header, name, where);
  const double scale = options.scale.value_or(1.0);
  if (in_waves) {
    header.history.push_back(
        fmt::format("{}{}: the values were waves of {:.9g} nm", kScaleApplied, scale, *wavelength));
    return {wavelength, scale};
  }
  if (options.scale)
    header.history.push_back(fmt::format("{}{}: heights are the values times it", kScaleApplied, scale));
  return {std::nullopt, scale};
}

}  // namespace dwell
