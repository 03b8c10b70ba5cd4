#include "runs/figure/expected_surface.h"

#include <cmath>
#include <utility>

#include "core/form/map_statistics.h"
#include "paths/feed/execution.h"
#include "runs/job/program_style.h"
#include "runs/plan/program_prediction.h"

namespace dwell {
namespace {

Program motion_of(const PlannedJob& plan, const Progress& progress) {
  Program program = plan.program.motion ? *plan.program.motion : program_of(plan.program.table);
  if (!plan.job.machine) return program;
  return execute(program, machine_for_program(plan.job.machine->machine, plan.job.options), progress).motion;
}

bool adds_in_squares(SurfaceQuantity quantity) {
  return quantity != SurfaceQuantity::Pv && quantity != SurfaceQuantity::Pvr;
}

}  // namespace

std::vector<SurfaceVerdict> judge_with_margin(const HeightMap& surface, const std::vector<UncertainSurface>& changes,
                                              const Part& part, const std::vector<SurfaceLimit>& limits,
                                              const Progress& progress) {
  std::vector<SurfaceVerdict> verdicts = judge_surface(surface, part.form, limits, part.threads, progress);
  std::vector<double> squares(limits.size(), 0.0);
  for (const UncertainSurface& change : changes) {
    const std::vector<SurfaceVerdict> of_change =
        judge_surface(change.change, part.form, limits, part.threads, progress);
    for (std::size_t i = 0; i < limits.size(); ++i) squares[i] += std::pow(of_change[i].value.value_or(0.0), 2);
  }
  for (std::size_t i = 0; i < limits.size(); ++i) {
    std::optional<double>& value = verdicts[i].value;
    if (!value) continue;
    const double margin = kMarginErrors * std::sqrt(squares[i]);
    value = adds_in_squares(limits[i].quantity) ? std::hypot(*value, margin) : *value + margin;
  }
  return verdicts;
}

ExpectedSurface expect_surface(const PlannedJob& plan, const RunUncertainty& unsure,
                               const std::vector<SurfaceLimit>& limits, const Progress& progress) {
  const Part& part = plan.part();
  ExpectedSurface expected;
  expected.motion = motion_of(plan, progress);
  const ExactResidual left =
      predict_program(part, expected.motion, plan.dwell.lattice.kernel, progress, ExactCheck::Lattice);
  expected.surface = left.surface;
  expected.statistics = left.statistics;
  expected.changes = uncertain_surfaces(part, ToolRemoval(part, plan.dwell.lattice.kernel), expected.motion, unsure,
                                        progress.of_part("margin"));
  double squares = 0.0;
  for (const UncertainSurface& change : expected.changes)
    squares += std::pow(map_statistics(change.change, part.form, part.threads).rms_about_zero(), 2);
  expected.margin = kMarginErrors * std::sqrt(squares);
  expected.verdicts = judge_with_margin(expected.surface, expected.changes, part, limits, progress);
  return expected;
}

}  // namespace dwell
