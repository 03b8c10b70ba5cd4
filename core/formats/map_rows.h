#pragma once

#include <optional>
#include <string>

#include "core/formats/map_source.h"

namespace dwell {

/// At which edge of the part the first row of a file lies, as the user says.
enum class MapRows {
  Bottom,  // the smallest y: rows stay as they are
  Top,     // the largest y: rows are turned over
};

/// "bottom" or "top". Throws InputError naming what is accepted.
MapRows parse_map_rows(const std::string& text);

/// The text that parses to it again.
std::string to_string(MapRows rows);

/// Turns the rows over if the first is that of the largest y, and says so in the history. Pitch and origin stay: the
/// origin is the centre of the pixel of the smallest x and y. Cost O(pixels).
void apply_map_rows(MapSource& source, const std::optional<MapRows>& rows);

}  // namespace dwell
