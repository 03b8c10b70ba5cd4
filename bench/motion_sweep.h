#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"

namespace dwell::bench {

/// What a machine of some acceleration makes of a path, planned without and with knowing it.
struct MotionLoss {
  std::string path;                             // as the table calls it
  double acceleration = 0.0;                    // along the path [mm/s^2]
  double ideal = 0.0, ideal_seconds = 0.0;      // planned without accelerations, and run without them [nm], [s]
  double unaware = 0.0, unaware_seconds = 0.0;  // the same feeds run on the machine
  double bounded = 0.0;                         // dwell times within what the machine can [nm]
  double aware = 0.0, aware_seconds = 0.0;      // planned for the machine and run on it
};

/// Plans a made-up mirror of 24 x 18 mm for a tool of 4 mm FWHM on machines of 50 mm/s that stop at corners, for every
/// path and acceleration of the table. Cost: some thirty plans of a second. Throws Interrupted.
std::vector<MotionLoss> sweep_motion(int threads, const Progress& progress);

/// Markdown of it, and a picture: what is left and the time of the run, over acceleration.
std::string motion_table_of(const std::vector<MotionLoss>& losses);
std::string motion_chart_of(const std::vector<MotionLoss>& losses);

}  // namespace dwell::bench
