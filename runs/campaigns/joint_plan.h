#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/form/map_statistics.h"
#include "runs/base/output_folder.h"
#include "runs/job/planned_job.h"
#include "runs/reports/written_plan.h"
#include "runs/tools/tool_choice.h"

namespace dwell {

/// The run of one tool of several.
struct ToolRun {
  std::size_t tool = 0;        // its number among the tools
  std::string folder;          // of its plan, in that of the joint plan: "1-large"
  double price = 1.0;          // of a second with it, over the common price
  double change_over = 0.0;    // before it [s]
  double dwell = 0.0;          // as run [s]
  double seconds = 0.0;        // of its program, lifted moves included
  MapStatistics before, left;  // the surface before and after its program, as simulated, form terms removed [nm]
  std::vector<std::string> limits, warnings;
};

/// A plan for several tools on one surface.
struct JointPlan {
  Job job;  // of the first tool, with the whole job's options
  std::vector<std::string> names;
  std::vector<std::string> tif;      // of each, for people
  std::vector<double> fwhm;          // of each tool [mm]
  std::vector<double> smoothnesses;  // of each
  std::vector<double> prices, change_overs;
  ToolChoice choice;
  std::vector<ToolRun> runs;  // in the order of the work: wide tools first
  std::vector<SurfaceVerdict> acceptance;
  std::vector<std::string> limits;  // not empty = exit code 3

  double change_over() const;  // of all runs [s]
  double seconds() const;      // of all programs [s]
};

/// What the folder of such a plan holds: tools.json and, for each tool that pays, the folder of its plan.
const ResultFiles& joint_plan_files();

/// Plans the tools of options.tools together, and writes each one's plan into a folder of its own in `folder`, without
/// committing it.
///
/// First the dwell of all tools is found as one problem (JointProblem), and which of them pay (choose_tools). Then the
/// tools that do are planned one after the other, wide ones first, as any plan is: each on the surface that the
/// programs before it leave, as simulated from their files, less what the later tools are to remove. At the joint
/// optimum such a plan finds the dwell of the joint one (the optimum of all is that of each with the others held); and
/// what the machine makes of a program, the later tools take up.
///
/// Throws as plan_job. Cost: the joint solves, and a plan for each tool.
JointPlan plan_tools(const JobOptions& options, const OutputFolder& folder, const Progress& progress = {});

}  // namespace dwell
