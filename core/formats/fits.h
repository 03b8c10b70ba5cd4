#pragma once

#include <string>
#include <string_view>

#include "core/base/grid_limit.h"
#include "core/formats/map_source.h"
#include "core/map/height_map.h"

namespace dwell {

/// Whether the bytes begin as a FITS file does.
bool is_fits(std::string_view bytes);

/// Reads the only image of a FITS file that has two axes (or more, all but the first two of length 1): BITPIX 8, 16,
/// 32, 64, -32, -64, scaled by BSCALE and BZERO; BLANK and NaN are no data. Of several images, the message lists
/// number, name and size. FITS counts rows from the bottom: its first row has the smallest y. What keywords mean, all
/// of them optional: core/formats/fits_header.h. `where` begins error messages. Throws InputError naming keyword or
/// size. Tile-compressed images are refused. Source: FITS standard 4.0, sections 4.4 and 8. Reading is by CFITSIO, in a
/// process of its own (core/formats/isolated_reader.h).
MapSource parse_fits(std::string_view bytes, const std::string& where, const PixelLimit& limit = {});

/// Reads the image of that number (0 = the primary one, as CFITSIO's file.fits[0]) or name (EXTNAME, in any case).
MapSource parse_fits_at(std::string_view bytes, const std::string& image, const std::string& where,
                        const PixelLimit& limit = {});

/// A FITS file that reads back equal: BITPIX -64, CDELT, CRPIX, CRVAL in mm, BUNIT nm, and the history as MADE1, MADE2,
/// ..., in which characters outside printable ASCII become '?'.
std::string fits_bytes(const HeightMap& map);

}  // namespace dwell
