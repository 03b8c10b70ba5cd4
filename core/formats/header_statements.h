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

/// Units of heights that need a wavelength or a conversion which no text map states: "waves", "fringes", "rad".
bool is_optical_unit(std::string_view text);

/// Whether a number with a unit of length stands somewhere in the text.
bool holds_a_length(std::string_view text);

/// Whether the text names a unit beside a word for the values: "all heights of Tuesday in um", "surface error (um)".
bool mentions_value_unit(std::string_view text);

/// "dz [um]", "TIF [um/s]", "slope [urad]": a few words with a unit in brackets behind them, which may be that of the
/// values whatever the words are. Millimetres are those of lengths along the part.
bool is_caption_with_unit(std::string_view text);

}  // namespace dwell
