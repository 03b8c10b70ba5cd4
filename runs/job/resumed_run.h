#pragma once

#include <cstddef>
#include <string>

#include "core/base/point.h"
#include "core/form/map_statistics.h"

namespace dwell {

/// What a program had done when it was stopped, of a plan that is the rest of it.
struct ResumedRun {
  std::string plan;      // folder of the plan whose program was stopped
  std::string by;        // what says where: "line 1234 of program.nc", "the log run.csv"
  std::size_t step = 0;  // in which it stopped, from 1 on
  std::size_t steps = 0;
  Point place;                                // of the stop [mm]
  double seconds = 0.0, whole_seconds = 0.0;  // at work, run and of the whole program
  double way = 0.0, whole_way = 0.0;          // at work, likewise [mm]
  MapStatistics removed;                      // the removal so far over the part, nothing taken out [nm]
  MapStatistics measured, remaining;          // the surface before the program and now, form terms removed [nm]
  double block_seconds = 0.0;                 // of the block in which it stopped, by which its place is uncertain
  double block_depth = 0.0;                   // that the block removes at its deepest [nm]
};

}  // namespace dwell
