#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/formats/header_words.h"

namespace dwell {

/// The statements of a comment: parted by ';', '|', tabs, unless a number follows, and by commas before a name of its
/// own ("pitch_mm: 0.1,0.2, unit: um" are two). Brackets are not parted.
std::vector<std::string> header_statements(std::string_view text);

/// The captions of a text that holds nothing else: names with their unit, parted by commas, as "Height [um]",
/// "x, y in mm, z in um". Empty if anything else stands there.
std::vector<HeaderKey> header_captions(std::string_view text);

/// Units of heights that need a conversion which no text map states: waves (is_wave_unit), "rad", "counts".
bool is_optical_unit(std::string_view text);

/// Whether a number with a unit of length stands somewhere in the text.
bool holds_a_length(std::string_view text);

/// "coordinates in inches": the name alone, without its unit.
bool speaks_of_coordinates(const HeaderKey& key);

/// "all in metres": x, y and z.
bool speaks_of_everything(const HeaderKey& key);

}  // namespace dwell
