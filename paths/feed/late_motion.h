#pragma once

#include <Eigen/Core>

#include <vector>

#include "core/base/grid.h"
#include "core/motion/program.h"
#include "paths/feed/execution.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

/// The motion of an execution whose steps take longer by `late` [s], one value a step of the program that was executed;
/// negative: shorter. What is added is spread over the step as its time is, so that places stay. A step without time
/// keeps none, and the rests at lifts stay. `late` must leave every step a time >= 0. Cost O(steps).
Program late_motion(const Execution& execution, const std::vector<double>& late);

/// The stroke of every step of a program that was read back from a file, kNoStroke for moves between stops and lifted
/// ones. Files hold no halts of no time and round places to about 1e-6 mm. Throws InputError naming the first step that
/// is not of this path, or the stroke that the program lacks.
std::vector<Index> strokes_of_steps(const Program& program, const StrokeMoves& moves);

/// A sum over every stroke's steps: of seconds [s], for instance. `stroke`, `values`: of every step.
Eigen::VectorXd sum_of_strokes(const std::vector<Index>& stroke, const std::vector<double>& values, Index strokes);

/// What every stroke is late [s], shared among its steps as `seconds`, their times, are.
std::vector<double> late_of_steps(const std::vector<Index>& stroke, const std::vector<double>& seconds,
                                  const Eigen::VectorXd& late);

}  // namespace dwell
