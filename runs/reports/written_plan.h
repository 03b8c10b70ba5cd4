#pragma once

#include <string>
#include <vector>

#include "core/form/map_statistics.h"
#include "core/map/height_map.h"
#include "runs/base/json_blocks.h"

namespace dwell {

/// What was written, and what the program on disk does to the surface.
struct WrittenPlan {
  HeightMap residual;                 // that the simulated program leaves, form terms removed [nm]
  MapStatistics simulated;            // residual of it
  double program_seconds = 0.0;       // of program.nc, as read back
  ProgramFigures program;             // of it, for the summary
  bool table_has_same_steps = false;  // feed.csv as read back removes with the steps of program.nc; else simulated too
  std::vector<std::string> limits;    // of the plan, and those that its files reach on the way; a sentence each
  std::string summary;                // the text of summary.json
};

}  // namespace dwell
