#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// What the comment lines of a text map say about it: `# pitch_mm: 0.1` (or `0.1,0.2` for x and y),
/// `# origin_mm: x,y`, `# unit: nm`, and as often as there were steps `# made: step`. Any other comment means nothing.
struct MapHeader {
  std::optional<Point> pitch;   // in x and y [mm], both > 0
  std::optional<Point> origin;  // centre of pixel (0, 0) [mm]
  std::optional<std::string> unit;
  std::vector<std::string> history;  // how the map was made, a step each, oldest first
  double pitch_rounding = 1e-9;      // relative: how well a pitch that the user gives can agree with the file's
};

/// pitch_rounding of formats that hold the pitch in single precision.
inline constexpr double kSinglePitchRounding = 1e-6;

/// Takes one comment line (from its '#') into the header. `place` begins the message, as in "map a.csv, line 3".
/// Throws InputError for a known key whose value cannot be read or that comes a second time.
void read_header_line(std::string_view line, const std::string& place, MapHeader& header);

/// The comment lines that make a text map of this grid, quantity (in nm or nm/s) and history read back equal.
std::string header_lines(const HeightMap& map);

}  // namespace dwell
