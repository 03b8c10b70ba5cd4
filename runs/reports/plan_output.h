#pragma once

#include "runs/base/output_folder.h"
#include "runs/job/planned_job.h"
#include "runs/reports/written_plan.h"

namespace dwell {

/// Writes feed.csv, program.nc, the pictures (before, after, dwell, path and its detail), residual.npy with its
/// sidecar, dwell.npy, summary.json and, if the weights were searched, search.csv into `folder` (docs/formats.md)
/// without committing it. program.nc is read back from disk and simulated with continuous motion; where that differs
/// from the solver's prediction by more than kSimulationTolerance, or the two files disagree, a sentence is added to
/// the limits. feed.csv is read back as well: its steps are compared with those of program.nc, and simulated where
/// they are not the same.
WrittenPlan write_plan(const PlannedJob& plan, const OutputFolder& folder, const Progress& progress);

/// The relative difference of residual RMS between simulated program and solver up to which no limit is reported.
inline constexpr double kSimulationTolerance = 0.03;

}  // namespace dwell
