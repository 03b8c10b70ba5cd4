#pragma once

#include <string>
#include <string_view>

#include "core/base/grid_limit.h"
#include "core/formats/map_source.h"

namespace dwell {

/// Whether the text is a Code V interferogram by its content: the second line that is no comment (the first is the
/// title) begins with GRD or ZFR or ZRN.
bool is_codev_int(std::string_view text);

/// Reads a surface grid of a Code V interferogram file (.int):
///
///   ! comment lines
///   title
///   GRD columns rows SUR|WFR WVL wavelength_um [NNB] SSZ scale [NDA no_data] [XSC 1]
///   values
///
/// height [nm] = value * wavelength / scale; the first value is at the smallest x and the largest y, then along x. A
/// value equal to NDA (32767 if not given) is no data. The file says no pitch. Of WFR, a wavefront, the values are path
/// differences [nm], and the header says that whoever reads them must know the height of each. `where` begins error
/// messages. Throws InputError for anything but a surface or a wavefront on square pixels, and naming the field, value
/// or line that is wrong.
/// Source: the manual of CODE V is not public; fields and scale are as the readers of prysm (io.read_codev_gridint) and
/// Gwyddion (codevfile.c) agree on, the order of the rows as prysm has it (Gwyddion's is the other way up).
MapSource parse_codev_int(std::string_view text, const std::string& where, const PixelLimit& limit = {});

}  // namespace dwell
