#pragma once

#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "paths/domain/path_distance.h"
#include "paths/lines/turnarounds.h"

namespace dwell {

struct CrossHatchOptions {
  double pitch = 0.0;             // distance between neighbouring lines [mm], finite and > 0; required
  std::optional<double> step;     // distance between dwell points of a line [mm], finite and > 0; default = pitch
  double angle_deg = 0.0;         // direction of the first lines, counter-clockwise from +x; finite
  double crossing_deg = 90.0;     // from the first lines to the second, counter-clockwise; > 0, < 180
  std::optional<double> overrun;  // how far lines go on beyond the valid pixels [mm], finite and >= 0; default 0
                                  // (plan_path: TIF radius)
  TurnOptions turns;              // how lines are joined, and whether corners are rounded
};

/// From "cross-hatch:pitch=MM,..."; throws InputError as SpecText does.
CrossHatchOptions parse_cross_hatch_options(const SpecText& spec);

/// The distances of tracks and dwell points that these options ask for.
std::vector<PathDistance> cross_hatch_distances(const CrossHatchOptions& options);

/// Two serpentine rasters (raster.h) whose lines cross, one after the other. The second can be run in four ways (first
/// or last line first, from either end); the one that begins nearest to the end of the first raster is taken. The tool
/// is lifted in between. What raster.h says about points and coverage holds for each of the two.
///
/// Throws InputError naming the option, its value and what is required; also above 50 million lattice points of both.
/// Cost O(pixels + lattice points).
ToolPath cross_hatch_path(const HeightMap& map, const CrossHatchOptions& options, const Progress& progress = {});

}  // namespace dwell
