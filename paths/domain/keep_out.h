#pragma once

#include <vector>

#include "core/map/aperture.h"
#include "core/motion/motion.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// Whether a straight move from a to b comes into an area or touches its boundary (within 1e-6 mm, the rounding of
/// coordinates in files). Cost: the edges of a polygon.
bool enters(const Aperture& area, Point a, Point b);

/// A path that keeps the tool's axis out of zones while it is down.
struct SparedPath {
  ToolPath path;                // its notes say what was done
  std::size_t left_out = 0;     // dwell points in a zone, or whose stroke would come into one
  std::size_t lifted_over = 0;  // moves that are lifted because a zone lies between their ends
};

/// Leaves out the dwell points that lie in a zone and lifts the tool where the way from point to point would cross one.
/// A stroke at a cut is extended straight on by half a step; where that would come into a zone, its point is left out
/// as well. Throws InputError if no point is left. Cost: a few times points x zones.
SparedPath keep_out_of(const ToolPath& path, Motion motion, const std::vector<Aperture>& zones);

}  // namespace dwell
