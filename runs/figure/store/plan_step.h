#pragma once

#include <string>

#include "core/base/progress.h"
#include "runs/figure/store/figure_state.h"
#include "runs/figure/store/run_folder.h"
#include "runs/figure/target_plan.h"
#include "runs/reports/written_plan.h"

namespace dwell {

/// A plan that is a step of a run.
struct PlannedStep {
  TargetPlan target;
  WrittenPlan written;
  std::vector<SurfaceVerdict> verdicts;  // of the written program, with the margin in each value
  std::string setup;                     // the text of the setup sheet
  std::string folder;                    // of the step, as seen from here
};

/// Plans the next run and adds it to the folder: a plan's folder as `dwell plan` writes it, with job.toml, of which it
/// can be made again, and a setup sheet. `options` are the state's, or some of them others for this plan alone. The
/// caller holds the run's lock. Throws as plan_job; the run is then as before.
PlannedStep add_plan(RunFolder& run, const FigureState& state, const JobOptions& options,
                     const Progress& progress = {});

}  // namespace dwell
