#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/motion/program.h"
#include "runs/acceptance/surface_limits.h"
#include "runs/figure/run_uncertainty.h"
#include "runs/job/planned_job.h"

namespace dwell {

/// How many standard deviations of what is uncertain a plan leaves as a margin.
inline constexpr double kMarginErrors = 2.0;

/// What a plan is expected to leave, before its files are written.
struct ExpectedSurface {
  Program motion;                         // as the machine executes it
  HeightMap surface;                      // [nm]
  MapStatistics statistics;               // of it, form terms removed
  std::vector<UncertainSurface> changes;  // by one standard deviation of each cause
  double margin = 0.0;                    // RMS of kMarginErrors standard deviations of all causes together [nm]
  std::vector<SurfaceVerdict> verdicts;   // of the limits, with the margin in each value
  bool meets() const { return all_pass(verdicts); }
};

/// How a surface stands to limits when tool and machine differ from what is thought by kMarginErrors standard
/// deviations: squares of an RMS, a slope or a band add up over independent causes, E q^2 = q0^2 + k^2 sum q_i^2, and
/// to a PV the root of the sum is added. Throws Interrupted. Cost: judge_surface of the surface and of each change.
std::vector<SurfaceVerdict> judge_with_margin(const HeightMap& surface, const std::vector<UncertainSurface>& changes,
                                              const Part& part, const std::vector<SurfaceLimit>& limits,
                                              const Progress& progress = {});

/// The surface that a plan leaves by simulation of its program on its machine, and its verdicts with the margin. Throws
/// Interrupted. Cost: a simulation, uncertain_surfaces, and judge_with_margin.
ExpectedSurface expect_surface(const PlannedJob& plan, const RunUncertainty& unsure,
                               const std::vector<SurfaceLimit>& limits, const Progress& progress = {});

}  // namespace dwell
