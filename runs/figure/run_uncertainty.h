#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/figure/tool_lesson.h"
#include "runs/figure/tool_removal.h"
#include "runs/plan/part.h"
#include "solvers/fits/ceres_removal_registration.h"

namespace dwell {

/// By how much the next run may differ from what is thought of tool and machine: standard deviations.
struct RunUncertainty {
  double rate = 0.0;      // as a share
  double width = 0.0;     // as a share
  double shift = 0.0;     // in x and in y [mm]
  double rotation = 0.0;  // [mrad]

  bool any() const { return rate > 0.0 || width > 0.0 || shift > 0.0 || rotation > 0.0; }
};

/// What is uncertain after the runs so far, whose lessons are given in their order: of each figure the error of its
/// last fit and what of it was not taken over; of the rate, which drifts from run to run, also by how much it was found
/// changed after the first run. Nothing (all zero) before the first lesson: nothing has been learnt then. Cost O(runs).
RunUncertainty uncertainty_after(const std::vector<ToolLesson>& lessons);

/// What one standard deviation of each cause adds to the surface that a run leaves: maps without form terms on the
/// part's pixels [nm], to be added in squares.
struct UncertainSurface {
  std::string cause;  // "rate", "width", "shift in x", "shift in y", "rotation"
  HeightMap change;
};

/// The changes by each cause that is uncertain, to first order: of a motion on the part with the part's tool. Throws
/// Interrupted. Cost: up to nine simulations.
std::vector<UncertainSurface> uncertain_surfaces(const Part& part, const ToolRemoval& removal, const Program& motion,
                                                 const RunUncertainty& unsure, const Progress& progress = {});

}  // namespace dwell
