#include "runs/reports/plan_files.h"

#include "runs/job/learnt_files.h"
#include "runs/programs/gcode_parts.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/program_template.h"
#include "runs/reports/another_surface.h"
#include "runs/reports/resume_plan.h"

namespace dwell {
namespace {

ResultFiles make_plan_files() {
  ResultFiles files{"plan",
                    "summary.json",
                    {"residual.npy", "residual.npy.json", "dwell.npy", "search.csv", kLateFile, kLearntRemovalFile,
                     kLearntRemovalSidecar, kRemainingMap, kRemainingSidecar, kToolSurface, kToolSurfaceSidecar},
                    {"before", "after", "residual", "dwell", "path", "path_detail", "limits", "motion", "uncertainty"},
                    nullptr};
  for (const ProgramFormat& format : program_formats()) {
    if (!format.file.empty()) files.others.emplace_back(format.file);
  }
  files.any_ending = {kTemplateProgram};
  files.others.push_back(kGcodePartsFile);
  files.numbered = {{"program_", ".trj"}, {"program_", ".pmc"}, {"program_", ".nc"}};
  return files;
}

}  // namespace

const ResultFiles& plan_files() {
  static const ResultFiles kFiles = make_plan_files();
  return kFiles;
}

}  // namespace dwell
