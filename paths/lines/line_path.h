#pragma once

#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "paths/domain/path_distance.h"

namespace dwell {

struct LinePathOptions {
  double step = 0.0;              // distance between dwell points [mm], finite and > 0; required
  double y = 0.0;                 // where the line lies [mm]
  std::optional<double> overrun;  // how far it goes on beyond the valid pixels [mm], finite and >= 0; default 0
                                  // (plan_path: TIF radius)
};

/// From "line:step=MM,..."; throws InputError as SpecText does.
LinePathOptions parse_line_path_options(const SpecText& spec);

/// The distances of dwell points that these options ask for.
std::vector<PathDistance> line_path_distances(const LinePathOptions& options);

/// One straight track along x, for a part that is a line or a strip: a profile of a mirror, or the same extruded over a
/// width. It runs once from the low end to the high one, over all valid pixels (NaN = outside) whose rows touch the
/// line and `overrun` beyond, across whatever holes lie between. Dwell points are `step` apart, symmetric about the
/// middle of these pixels, as many as fit.
///
/// Throws InputError naming the option, its value and what is required: also where the line meets no valid pixel, and
/// above 50 million points. Cost O(pixels of the rows + points).
ToolPath line_path(const HeightMap& map, const LinePathOptions& options, const Progress& progress = {});

}  // namespace dwell
