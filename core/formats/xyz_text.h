#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/formats/map_header.h"
#include "core/map/height_map.h"

namespace dwell {

/// One line of an XYZ file.
struct XyzPoint {
  Point position;       // [mm]
  double height = 0.0;  // NaN = no data; in the file's unit
  long line = 0;
};

struct XyzText {
  std::vector<XyzPoint> points;  // in the order of the file, at least one
  MapHeader header;
};

/// Whether a line before the first number names the columns x, y and z (core/formats/xyz_columns.h).
bool names_xyz_columns(std::string_view text);

/// Reads lines `x y z` (docs/formats.md), separated by blanks, tabs, commas or semicolons; coordinates in another
/// unit than mm, which a header must name, become mm. `where` begins error messages. Throws InputError naming the line
/// of what is not such a point. Cost O(bytes).
XyzText parse_xyz_text(std::string_view text, const std::string& where);

/// The map as lines `x y z` with a header, in nm, every pixel (nan where there is no data), read back equal.
std::string xyz_text(const HeightMap& map);

}  // namespace dwell
