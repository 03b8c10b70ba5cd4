#include "runs/plan/program_prediction.h"

#include <algorithm>

#include "core/removal/simulate.h"
#include "paths/feed/plan_program.h"

namespace dwell {

bool lattice_too_coarse(const ExactResidual& exact, const MapStatistics& before) {
  const double most =
      std::max(kWorstLatticeError * exact.statistics.rms_about_zero(), kProbeError * before.rms_about_zero());
  return !(exact.lattice_error <= most);
}

ExactResidual predict_dwell(const Part& part, const LaidPath& laid, const Vector& dwell, const HeightMap& left,
                            double max_feed, ExactCheck check, const Progress& progress) {
  std::vector<double> seconds(dwell.data(), dwell.data() + dwell.size());
  std::vector<Stroke> strokes = laid.strokes;
  if (laid.motion == Motion::Stop) {
    // The tool removes while it moves from stop to stop as well.
    const RemovingSteps moves =
        removing_steps(program_of(laid.path, std::vector<double>(seconds.size(), 0.0), laid.motion, max_feed));
    strokes.insert(strokes.end(), moves.strokes.begin(), moves.strokes.end());
    seconds.insert(seconds.end(), moves.seconds.begin(), moves.seconds.end());
  }
  const RemovalProbe probe(part.map.grid, part.exact, strokes, seconds);
  return exact_residual(probe, part.map, left, part.form, part.threads, progress, check);
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
