#pragma once

#include <Eigen/Core>

#include <memory>
#include <vector>

#include "runs/plan/fit_objective.h"
#include "runs/plan/part.h"
#include "solvers/problem/surface_rows.h"

namespace dwell {

/// The length L that makes heights of slopes [mm]: kHalfHeldWave equivalent FWHM / (2 pi). A wave of kHalfHeldWave
/// times the equivalent FWHM, about the shortest that the tool corrects, weighs the same in L times its slope as in
/// height; longer ones weigh less, shorter ones more. So the usual smoothness, which is made for that wave, holds for
/// every objective.
double slope_length(const Part& part);

/// That of the objective, or the part's where it says none [mm].
double slope_length(const Part& part, const FitObjective& objective);

/// The rows of an objective with slopes, and what goes with them in a dwell problem.
struct ObjectiveRows {
  std::shared_ptr<const SurfaceRows> rows;
  Vector weights;        // of the rows: roots of the shares, those of slopes times L [mm]
  Eigen::MatrixXd form;  // orthonormal, spans the weighted rows of the form terms; piston has no slope
};

/// pixels: those of the part's map that have data; `roots` of them: weight_roots, empty = all one. The weight of a
/// slope is the mean of its two pixels'. Cost O(pixels).
ObjectiveRows objective_rows(const Part& part, const std::vector<Index>& pixels, const std::vector<double>& roots,
                             const FitObjective& objective);

}  // namespace dwell
