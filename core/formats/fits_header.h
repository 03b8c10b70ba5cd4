#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/formats/fits_handle.h"
#include "core/formats/map_fields.h"

namespace dwell {

/// What the header of the image that is open says, for messages that begin with `where`.
struct FitsHeader {
  SaidOfMap said;
  std::optional<double> blank;  // BLANK, as stored
};

/// Reads every keyword of the image: pitch and origin from the world coordinates (CDELT or CD, CUNIT, CRPIX, CRVAL) or
/// from what other programs write (PITCHMM, PUPLSCAL in m as poppy has it, PIXELSCL with PIXUNIT, any other with its
/// unit in brackets at the beginning of the comment), the unit from BUNIT or its kin, the history from MADE1, MADE2,
/// ... What looks like a unit, a factor, a marker or an origin is honoured, or refused by its name. Throws InputError.
FitsHeader read_fits_header(fitsfile* file, const std::string& where);

}  // namespace dwell
