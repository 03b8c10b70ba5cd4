#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "core/height_map.h"
#include "core/tool_path.h"
#include "paths/nearest_neighbour.h"
#include "paths/raster.h"

namespace dwell {

/// A path that the user brings (docs/formats.md, "Path files").
struct PathFromFile {
  std::filesystem::path file;
};

/// Which planner, and its options.
using PathSpec = std::variant<RasterOptions, NearestOptions, PathFromFile>;

/// Parses
///   raster:pitch=MM[,step=MM][,angle=DEGREES][,overrun=MM][,order=serpentine|one-way]
///   nearest:cell=MM[,critical=NM][,lift=CELLS|inf][,start=X/Y]        (X, Y in mm)
///   file:PATH.csv                                                     (all after the colon is the name)
/// Throws InputError naming the text, the key or kind that is unknown or missing, and those accepted. Ranges are
/// checked where the path is planned.
PathSpec parse_path_spec(const std::string& text);

/// Runs the planner on the map [nm, NaN = outside]. tif_radius [mm], finite and > 0: default overrun of a raster; and a
/// path from a file that comes nowhere within the TIF's reach of a valid pixel is refused. Throws InputError as the
/// planners do.
ToolPath plan_path(const PathSpec& spec, const HeightMap& target, double tif_radius);

}  // namespace dwell
