#pragma once

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "core/removal/exact_residual.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/lattice_choice.h"
#include "runs/plan/part.h"

namespace dwell {

/// The share of what is left that the lattice's own error may come to.
inline constexpr double kWorstLatticeError = 0.05;

/// The RMS of the part before, times this, is what an exact residual is known to: errors of the table of the removal
/// function cancel along the path to about this.
inline constexpr double kProbeError = 1.5e-5;

/// Whether the lattice is too coarse for this residual of a part that was `before` nm about zero: its error is more
/// than kWorstLatticeError of what is left, and more than the probe itself can tell.
bool lattice_too_coarse(const ExactResidual& exact, const MapStatistics& before);

/// The exact residual of dwell times [s] on a laid path. `left` is what the lattice says that they leave, form terms
/// included [nm]; `max_feed` [mm/s] is that of moves between stops. Throws Interrupted. Cost: exact_residual.
ExactResidual predict_dwell(const Part& part, const LaidPath& laid, const Vector& dwell, const HeightMap& left,
                            double max_feed, ExactCheck check, const Progress& progress);

/// What a program leaves of a part, on this lattice and, from the removal function itself, exactly. Throws Interrupted.
/// Cost: removal_once and exact_residual.
ExactResidual predict_program(const Part& part, const Program& program, const RemovalKernel& kernel,
                              const Progress& progress, ExactCheck check = ExactCheck::Figure);

}  // namespace dwell
