#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/motion/program_frame.h"
#include "runs/acceptance/surface_limits.h"
#include "runs/figure/run_uncertainty.h"
#include "runs/figure/store/run_folder.h"
#include "runs/figure/tool_lesson.h"
#include "runs/job/job_options.h"

namespace dwell {

/// The kinds of steps that a run has.
namespace step_kinds {
inline const std::string kNew = "new", kPlan = "plan", kMeasured = "measured", kWithdrawn = "withdrawn";
}

/// Whether an option says how a map is read: what an instrument's files are like is told once, with the first of them.
bool is_map_convention(const std::string& key);

/// Options with the map, and how it is read, of others.
JobOptions with_map_of(const JobOptions& options, const JobOptions& map);

/// The limits of a target, whose `mid` is of these bands; both as text. Throws InputError.
std::vector<SurfaceLimit> limits_of_target(const std::string& target, const std::string& bands);

/// What a run has come to: its steps in their order, without those that were withdrawn.
struct FigureState {
  JobOptions options;      // of the next plan: with the last map, and tool and frame as learnt; files as seen from here
  JobOptions conventions;  // how the next map is read: as the last one, but for steps that were of that map alone
  ProgramFrame as_set_up;  // how the part lies on the machine: the frame of the first run
  std::string target;      // as it was given; empty: none
  std::vector<SurfaceLimit> limits;
  std::vector<ToolLesson> lessons;  // of the runs so far
  int runs = 0;                     // measured
  int map_step = 1;                 // of the map that is the surface now
  std::optional<int> plan_step;     // the last plan for that map
  std::set<int> withdrawn;

  RunUncertainty uncertainty() const { return uncertainty_after(lessons); }
};

/// The state that the steps make together. Throws InputError for a step that this version cannot read. Cost O(steps):
/// reads the job file of the first step.
FigureState figure_state(const RunFolder& run);

}  // namespace dwell
