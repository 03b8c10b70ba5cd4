#pragma once

#include <string>

#include "runs/base/json_blocks.h"
#include "runs/base/output_folder.h"
#include "runs/plan/plan.h"

namespace dwell {

/// What was written, and what the program on disk does to the surface.
struct WrittenPlan {
  HeightMap residual;                 // that the simulated program leaves, form terms removed [nm]
  MapStatistics simulated;            // residual of it
  double program_seconds = 0.0;       // of program.nc, as read back
  ProgramFigures program;             // of it, for the summary
  bool table_has_same_steps = false;  // feed.csv as read back removes with the steps of program.nc; else simulated too
  std::string summary;                // the text of summary.json
};

/// Writes feed.csv, program.nc, the pictures (before, after, dwell, path and its detail), residual.npy with its
/// sidecar, dwell.npy, summary.json and, if the weights were searched, search.csv into `folder` (docs/formats.md)
/// without committing it. program.nc is read back from disk and simulated with continuous motion; where that differs
/// from the solver's prediction by more than kSimulationTolerance, or the two files disagree, a sentence is added to
/// plan.limits. feed.csv is read back as well: its steps are compared with those of program.nc, and simulated where
/// they are not the same.
WrittenPlan write_plan(Plan& plan, const OutputFolder& folder, const Progress& progress);

/// Relative difference of residual RMS between simulated program and solver that is accepted without a remark.
inline constexpr double kSimulationTolerance = 0.03;

}  // namespace dwell
