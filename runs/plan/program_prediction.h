#pragma once

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "core/removal/exact_residual.h"
#include "runs/plan/lattice_choice.h"
#include "runs/plan/part.h"

namespace dwell {

/// The share of what is left that the lattice's own error may come to.
inline constexpr double kWorstLatticeError = 0.05;

/// Whether the lattice is too coarse for this residual of a part that was `before` nm about zero: its error is more
/// than kWorstLatticeError of what is left, and more than the probe itself can tell.
bool lattice_too_coarse(const ExactResidual& exact, const MapStatistics& before);

/// What a program leaves of a part, on this lattice and, from the removal function itself, exactly. Throws Interrupted.
/// Cost: removal_once and exact_residual.
ExactResidual predict_program(const Part& part, const Program& program, const RemovalKernel& kernel,
                              const Progress& progress, ExactCheck check = ExactCheck::Figure);

}  // namespace dwell
