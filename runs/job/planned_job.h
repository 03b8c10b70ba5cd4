#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runs/job/job.h"
#include "runs/job/resumed_run.h"
#include "runs/plan/block_plan.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/machine_program.h"

namespace dwell {

/// A job and the values planned for it, before anything is written.
struct PlannedJob {
  Job job;
  LaidPath laid;
  DwellPlan dwell;
  MachineProgram program;
  std::optional<DwellPlan> plain{};      // with a robust plan: the one without that, whose weights it has
  std::optional<BlockMerging> blocks{};  // for a controller with a block rate
  std::optional<ResumedRun> resumed{};   // what the program had done of which this is the rest

  const Part& part() const { return *job.part; }
  /// Limits that were reached, one sentence each, with the flags of the options; not empty = exit code 3.
  std::vector<std::string> limits() const;
};

/// Throws InputError before any work for programs (`export`) that a plan with these options cannot have: without a
/// machine, and with one whose velocity jumps.
void check_exports(const JobOptions& options);

/// Plans a job. Throws InputError for anything the user gave that cannot be used, Interrupted. Cost: the solver's
/// operator applications dominate (docs/math.md).
PlannedJob plan_job(const JobOptions& options, const Progress& progress = {});

/// The same for a job that is loaded, on a path that is laid.
PlannedJob plan_job(Job job, JobPath path, const Progress& progress = {});

/// A job that is loaded with a path that is laid and the dwell on it, `commanded` as keep_dwell has it: nothing is
/// solved. With a schedule of constant feeds. Throws as keep_dwell and check_exports.
PlannedJob keep_plan(Job job, LaidPath laid, const Weights& weights, const std::vector<double>& commanded,
                     const Progress& progress = {});

}  // namespace dwell
