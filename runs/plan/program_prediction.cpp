#include "runs/plan/program_prediction.h"

#include <algorithm>

#include "core/removal/simulate.h"

namespace dwell {

bool lattice_too_coarse(const ExactResidual& exact, const MapStatistics& before) {
  constexpr double kTells = 1.5e-5;  // of the removal: errors of the table cancel along the path
  const double most =
      std::max(kWorstLatticeError * exact.statistics.rms_about_zero(), kTells * before.rms_about_zero());
  return !(exact.lattice_error <= most);
}

ExactResidual predict_program(const Part& part, const Program& program, const RemovalKernel& kernel,
                              const Progress& progress, ExactCheck check) {
  const HeightMap left = surface_after(part.map, simulate(program, part.map, kernel, part.threads));
  progress.check();
  const RemovingSteps removing = removing_steps(program);
  const RemovalProbe probe(part.map.grid, part.exact, removing.strokes, removing.seconds);
  return exact_residual(probe, part.map, left, part.form, part.threads, progress.of_part("exact residual"), check);
}

}  // namespace dwell
