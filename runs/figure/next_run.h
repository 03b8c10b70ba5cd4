#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "runs/acceptance/surface_limits.h"
#include "runs/figure/run_uncertainty.h"
#include "runs/job/job_options.h"

namespace dwell {

/// What a next run could leave for a time.
struct NextRunPoint {
  double seconds = 0.0;  // of dwell
  double rms = 0.0;      // left, form terms removed [nm]
};

/// Whether another run pays.
struct NextRun {
  std::vector<NextRunPoint> curve;       // by time, ascending; as the solver has it, without the machine's motion
  double rms = 0.0;                      // what the run with the usual price is expected to leave [nm]
  double margin = 0.0;                   // RMS that what is uncertain may add [nm]
  double seconds = 0.0;                  // of dwell of that run
  std::vector<SurfaceVerdict> now;       // the surface as it is, to the limits
  std::vector<SurfaceVerdict> expected;  // that run, with the margin
  std::string advice;                    // a sentence
};

/// What the next run of a job could do: the plan with the usual price of time and its neighbours at other prices.
/// `options` are those of that plan. A run pays if it is expected to bring the surface into the limits, or to lower its
/// RMS by kWorthARun. Throws as plan_job. Cost: a plan, five solves, and expect_surface.
NextRun look_at_next_run(const JobOptions& options, const std::vector<SurfaceLimit>& limits,
                         const RunUncertainty& unsure, const Progress& progress = {});

/// The share by which a run must lower the RMS to be worth setting up.
inline constexpr double kWorthARun = 0.1;

}  // namespace dwell
