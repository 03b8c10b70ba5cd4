#pragma once

#include <string>
#include <string_view>

#include "core/base/grid_limit.h"
#include "core/formats/map_source.h"

namespace dwell {

/// Whether the bytes begin as a Zygo MetroPro binary file does.
bool is_zygo_dat(std::string_view bytes);

/// Reads the heights of a Zygo MetroPro binary file (.dat), formats 1, 2 (header of 834 bytes) and 3 (4096 bytes), big
/// endian. A stored number n is a height of n S W O / R, with S interferometric scale factor, W wavelength, O obliquity
/// factor and R the numbers to a fringe; 2147483640 and above are no data. The file's first row is the top of the
/// picture: it becomes the largest y. Heights are in nm; the pitch is the lateral resolution, left open if that is 0;
/// the place on the camera counts from the centre of its upper left pixel, with y up.
/// `where` begins error messages. Throws InputError naming the field, its byte, its value and what is accepted; a file
/// of inverted data is refused, because readers disagree whether its heights are stored inverted.
/// Sources: MetroPro Reference Guide OMP-0347, chapter 12; the same layout in Gwyddion's metropro.c and prysm's io.py.
MapSource parse_zygo_dat(std::string_view bytes, const std::string& where, const PixelLimit& limit = {});

}  // namespace dwell
