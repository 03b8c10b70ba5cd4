#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/anatomy/residual_anatomy.h"
#include "core/form/map_statistics.h"
#include "core/removal/exact_residual.h"
#include "paths/feed/binding_limits.h"
#include "paths/feed/motion_nodes.h"
#include "runs/acceptance/surface_limits.h"
#include "runs/base/json_blocks.h"
#include "runs/plan/machine_program.h"
#include "runs/reports/plan_uncertainty.h"
#include "runs/reports/surface_sheet.h"

namespace dwell {

/// A program that was asked for besides feed.csv and program.nc, as read back.
struct WrittenExport {
  std::string word;       // as --export names it
  std::string file;       // the first, or the list of the others
  std::size_t files = 1;  // with it
  std::string sha256;     // of the first
  std::size_t steps = 0;
  double total_s = 0.0;    // of all steps
  MapStatistics residual;  // that it leaves
};

/// What was written, and the surface that the program on disk leaves.
struct WrittenPlan {
  ExactResidual exact;                     // what the program leaves, as read back, of the pixels that count
  HeightMap beside;                        // its surface with those that do not count; empty if all do [nm]
  ResidualAnatomy anatomy;                 // of that surface
  std::string advice;                      // what would help most, a sentence
  SurfaceSheet surface;                    // slopes and bands before, and of that surface
  std::vector<SurfaceVerdict> acceptance;  // how that surface stands to the job's limits
  double run_seconds = 0.0;                // of program.nc, as read back, lifted moves included
  TravelTimes travel;                      // besides the dwell; `travel.lifted` is what program.nc does not say
  std::vector<std::string> warnings;       // what a machine shop would question, a sentence each
  ProgramFigures program;                  // of it, for the summary
  std::string program_sha256;
  /// Whether feed.csv, read back, removes with the steps of program.nc; if not, it is simulated too. Nothing where the
  /// plan has no feed table.
  std::optional<bool> table_has_same_steps{};
  std::vector<WrittenExport> exports;
  std::optional<PlanUncertainty> uncertainty{};  // what it may leave, where that is asked for
  std::vector<MotionNode> nodes;      // of the machine's motion, where there is one, without what logs have taught
  std::vector<BindingLimit> binding;  // of every stretch between two of them
  std::string late_sha256, learnt_removal_sha256;  // of kLateFile and kLearntRemovalFile, where there are any
  std::vector<std::string> limits;  // of the plan, and those that reading its files back has shown; a sentence each
  std::string summary;              // the text of summary.json

  /// What the program leaves, to be shown [nm].
  const HeightMap& shown() const { return beside.values.empty() ? exact.surface : beside; }
};

}  // namespace dwell
