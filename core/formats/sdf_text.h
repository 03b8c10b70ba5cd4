#pragma once

#include <string>
#include <string_view>

#include "core/base/grid_limit.h"
#include "core/formats/map_source.h"
#include "core/map/height_map.h"

namespace dwell {

/// Whether the file is a surface data file (SDF), text or binary, by its first bytes.
bool is_sdf(std::string_view bytes);

/// Reads an ASCII surface data file: ISO 25178-71 (aISO-1.0, aISO-2.0) or its forerunner (aBCR-1.0, EUR 15178 EN).
/// Heights are value * Zscale [m], given here in nm; BAD is no data. Profiles run along x; their pitch is Xscale, that
/// of the profiles Yscale [m] (of a single profile it may be 0, and is then taken as Xscale). The first profile has the
/// smallest y by the ISO standard, which sets y = (i - 1) Yscale; BCR leaves it open and is taken as the programs that
/// read it show it, with the first profile on top (largest y). Origin and history are read from the trailer if
/// `sdf_text` wrote them there. Fields that the standard does not have are skipped unless they look like a unit, a
/// factor, an origin or a marker of no data: a unit must be the metre, the rest is refused by name. `where` begins
/// error messages. Throws InputError naming a field that is missing, given twice or not acceptable, or the line.
MapSource parse_sdf_text(std::string_view text, const std::string& where, const PixelLimit& limit = {});

/// The map as aISO-1.0, heights in nm (Zscale 1e-9), every number with the digits that read back equal. The date
/// fields hold one fixed date, so that the same map gives the same bytes. Pitch, origin and history are also in the
/// trailer, where an asterisk and characters outside printable ASCII become '?'.
/// Throws InputError for a map of removal rates, which the format has no word for.
std::string sdf_text(const HeightMap& map);

}  // namespace dwell
