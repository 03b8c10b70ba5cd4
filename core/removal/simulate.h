#pragma once

#include "core/map/height_map.h"
#include "core/motion/program.h"
#include "core/motion/tool_path.h"
#include "core/tif/removal_kernel.h"

namespace dwell {

/// The strokes and times with which a program removes: every removing move at its constant speed, and every halt. A
/// step whose speed changes is cut into parts, each with its exact time and ends.
struct RemovingSteps {
  std::vector<Stroke> strokes;
  std::vector<double> seconds;
};
RemovingSteps removing_steps(const Program& program);

/// The removal [nm] that a program makes on the finite pixels of a map (NaN elsewhere). The tool moves continuously as
/// the program says; steps that do not remove count nothing. Cost: that of removal_once.
HeightMap simulate(const Program& program, const HeightMap& map, const RemovalKernel& kernel, int threads);

/// The surface left: map - removal on the map's finite pixels [nm].
HeightMap surface_after(const HeightMap& map, const HeightMap& removal);

}  // namespace dwell
