#pragma once

#include <string>
#include <string_view>

#include "core/formats/map_header.h"

namespace dwell {

/// Whether a name or a remark calls data an optical path difference or a wavefront, in English, German or French: OPD,
/// WFR, WFE, wavefront, optical path, Wellenfront, front d'onde; alone or within a name ("opd_map", "WavefrontError").
/// What surface makes one depends on the test: mostly the path is twice the height. Cost O(length).
bool names_wavefront(std::string_view text);

/// Keeps as unclear, for whoever knows the options, that what `shown` says is no height of a surface; nothing if the
/// text does not call the data so. `place` begins the message.
void note_wavefront(std::string_view text, const std::string& place, const std::string& shown, MapHeader& header);

/// What a user can do about such values, to end the message; of a removal function no option helps.
const char* way_out_of_wavefront(bool is_map);

}  // namespace dwell
