#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/map/height_map.h"

namespace dwell {

/// The nm in one of the unit of length that the text names: nm, um, mm, cm, m, pm, angstrom, inch, each by its sign or
/// its word, British or American, German or French, one or many ("µm" with either mu and in Latin-1 too, "micron",
/// "Micrometres"), in any case, in brackets or quotes or not. Nothing if it names none.
std::optional<double> known_length_unit(std::string_view text);

/// The nm/s in one of the unit of rate that the text names: a length per second, minute or hour, written "um/min",
/// "microns per minute", "nm s-1" or "nm*s^-1". Nothing if it names none.
std::optional<double> known_rate_unit(std::string_view text);

/// The factor of a unit of length or, if it is none, of rate; for places that may name either. Nothing if it is
/// neither.
std::optional<double> known_value_unit(std::string_view text);

/// Whether the text names waves as a unit: wave, fringe, lambda, Wellenlänge, frange, one or many, in any case, in
/// brackets or quotes or not. A fringe is a wave of path difference. How high one is depends on wavelength and test.
bool is_wave_unit(std::string_view text);

/// Factor from a unit of height (known_length_unit) to nm. Throws InputError naming accepted ones, and saying so of a
/// rate.
double height_unit_nm(const std::string& unit);

/// Factor from a unit of removal rate (known_rate_unit) to nm/s. Throws InputError likewise.
double rate_unit_nm_per_s(const std::string& unit);

/// The one of the two that the quantity asks for.
double unit_factor(const std::string& unit, MapQuantity quantity);

/// The unit inside: "nm" or "nm/s".
std::string unit_of(MapQuantity quantity);

}  // namespace dwell
