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

struct RasterOptions {
  double pitch = 0.0;          // distance between neighbouring lines [mm], finite and > 0; required
  bool auto_pitch = false;     // plan_path finds the pitch: the widest whose ripple is at most `ripple`
  double ripple = 0.01;        // peak to valley over removal, > 0 and < 1; used with auto_pitch only
  std::optional<double> step;  // distance between dwell points of a line [mm], > 0; default = pitch
  double angle_deg = 0.0;      // direction of the lines, counter-clockwise from +x; finite
  std::optional<double>
      overrun;             // how far lines go on beyond the valid pixels [mm], >= 0; default 0 (plan_path: TIF radius)
  bool serpentine = true;  // every other line backwards; false = one-way, each line entered lifted
  TurnOptions turns;       // how lines are joined, and whether corners are rounded; default: straight, not
};

/// From "raster:pitch=MM,..."; throws InputError as SpecText does.
RasterOptions parse_raster_options(const SpecText& spec);

/// The distances of tracks and dwell points that these options ask for.
std::vector<PathDistance> raster_distances(const RasterOptions& options);

/// Straight parallel lines over the valid pixels of a map (NaN = outside).
///
/// Lines and dwell points lie on one lattice, `pitch` x `step`, in the frame rotated by the angle. It is symmetric
/// about the middle of the bounding box of the valid pixel centres in that frame, with as many lines (points) as fit
/// into the box widened by `overrun` on each side. A lattice point is wanted if it lies within `overrun` of a valid
/// pixel centre, or if it is the lattice point nearest to one; a line runs from its first to its last wanted point,
/// across whatever lies between (the tool stays down across holes). Lines without a wanted point are left out. So every
/// valid pixel is within pitch/2 of a line, whatever the overrun.
///
/// Lines follow each other in the direction 90 degrees counter-clockwise from theirs (angle 0: upwards). A
/// serpentine joins neighbouring lines on the part (turnarounds.h) and is lifted where a line between them was left
/// out. Throws InputError naming the option, its value and what is required; also above 50 million lattice points. Cost
/// O(pixels + lattice points).
ToolPath raster_path(const HeightMap& map, const RasterOptions& options, const Progress& progress = {});

}  // namespace dwell
