#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

#include "core/motion/program.h"
#include "paths/feed/machine.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

/// The rests of a machine where a program lifts and lowers the tool, beside the ways up and down that the program says
/// itself. Where the tool comes down, at the beginning of the work too, the machine rests with the tool up for the
/// plunge, and then with the tool down until it has settled: that removes. Where the tool goes up and comes down again
/// later, it rests with the tool up for the lift.
class LiftRests {
 public:
  LiftRests(const Program& program, const Machine& machine);

  /// The rests before a step of the program, in their order; mostly none.
  std::vector<ProgramStep> before(std::size_t step) const;

 private:
  const std::vector<ProgramStep>& steps_;
  LiftTimes times_;
  std::size_t work_end_ = 0;  // one past the last step that removes
};

/// A program with these rests as steps of their own; of its path modes, which stand at steps, none. Cost O(steps).
Program with_lift_rests(Program program, const Machine& machine);

/// What these rests come to in a run [s].
struct LiftTotals {
  std::size_t lifts = 0, plunges = 0;
  double lift = 0.0, plunge = 0.0, settle = 0.0;

  bool any() const { return lift + plunge + settle > 0.0; }
};

/// Cost O(steps).
LiftTotals lift_totals(const Program& program, const Machine& machine);

/// The settling that every stroke of a path begins with [s]: its first after each time that the tool comes down. n
/// values.
Eigen::VectorXd settling_of_strokes(const StrokeMoves& moves, const Machine& machine);

/// What is left of the dwell of a halt to command [s] where the machine settles there: at least 1 us, since a halt of
/// no time is no step of a program, and the tool would not come down at all.
double commanded_halt(double dwell, double settling);

}  // namespace dwell
