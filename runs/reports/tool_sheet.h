#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

#include "core/tif/removal_analysis.h"
#include "core/tif/removal_function.h"

namespace dwell {

/// What every report says of the tool: its size, where it lies about its axis, and what its file says of it.
struct ToolSheet {
  std::string kind;             // kind_of the removal function, or the calibration that made it
  double radius = 0.0;          // no removal farther than this from the axis [mm]
  RemovalAnalysis shape;        // without its transfer function
  std::optional<TifFile> file;  // where it was read from a file of rates
  std::vector<std::string> notes;
};

/// "(x, y) mm" from the tool axis, without the digits that rounding leaves of a place on it.
std::string place_from_axis(Point p, double fwhm);

/// Cost: that of analyse_shape.
ToolSheet tool_sheet(const RemovalFunction& tif);

/// One line about its file, which it must have, with `head` in front.
std::string tool_file_line(const std::string& head, const ToolSheet& sheet);

/// The lines of the table, which begin with "tool", and one for every note.
std::string tool_lines(const ToolSheet& sheet);

/// The block "tool" of the JSON (docs/json.md).
nlohmann::ordered_json tool_block(const ToolSheet& sheet);

}  // namespace dwell
