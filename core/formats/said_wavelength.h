#pragma once

#include <string>
#include <string_view>

#include "core/formats/header_words.h"
#include "core/formats/map_header.h"

namespace dwell {

/// Whether a name is that of a wavelength, as in "wavelength_nm", WAVELEN or "Wellenlänge".
bool names_wavelength(std::string_view name);

/// Takes a wavelength of light that a file states [nm], `shown` for messages, into its header; of several that differ
/// none counts. False, and nothing is taken, of a length that no light has.
bool add_wavelength(double nm, const std::string& shown, MapHeader& header);

/// The same of a statement in a comment, "wavelength: 632.8 nm"; false of any other, and without a unit.
bool add_wavelength(const HeaderKey& key, std::string_view value, const std::string& place, MapHeader& header);

}  // namespace dwell
