#include "paths/feed/lift_rests.h"

#include <algorithm>

namespace dwell {
namespace {

constexpr double kLeastHalt = 1e-6;  // [s]

bool comes_down(const std::vector<ProgramStep>& steps, std::size_t i) {
  return steps[i].removes && (i == 0 || !steps[i - 1].removes);
}

void add_rest(std::vector<ProgramStep>& rests, Point at, double seconds, bool removes) {
  if (seconds > 0.0) rests.push_back({at, at, seconds, removes});
}

}  // namespace

LiftRests::LiftRests(const Program& program, const Machine& machine) : steps_(program.steps), times_(machine.lift) {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (steps_[i].removes) work_end_ = i + 1;
  }
}

std::vector<ProgramStep> LiftRests::before(std::size_t step) const {
  std::vector<ProgramStep> rests;
  const Point at = steps_[step].start;
  if (comes_down(steps_, step)) {
    add_rest(rests, at, times_.plunge, false);
    add_rest(rests, at, times_.settle, true);
  } else if (step > 0 && step < work_end_ && steps_[step - 1].removes && !steps_[step].removes) {
    add_rest(rests, at, times_.lift, false);
  }
  return rests;
}

Program with_lift_rests(Program program, const Machine& machine) {
  if (machine.lift == LiftTimes{}) return program;
  const LiftRests rests(program, machine);
  std::vector<ProgramStep> steps;
  steps.reserve(program.steps.size());
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    for (const ProgramStep& rest : rests.before(i)) steps.push_back(rest);
    steps.push_back(program.steps[i]);
  }
  program.steps = std::move(steps);
  program.path_modes.clear();
  return program;
}

LiftTotals lift_totals(const Program& program, const Machine& machine) {
  LiftTotals totals;
  std::size_t ups = 0;  // one of them after the last of the work, which is no part of the run
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    totals.plunges += static_cast<std::size_t>(comes_down(program.steps, i));
    ups += static_cast<std::size_t>(i > 0 && program.steps[i - 1].removes && !program.steps[i].removes);
  }
  totals.lifts = totals.plunges > 0 ? std::min(ups, totals.plunges - 1) : 0;
  totals.lift = static_cast<double>(totals.lifts) * machine.lift.lift;
  totals.plunge = static_cast<double>(totals.plunges) * machine.lift.plunge;
  totals.settle = static_cast<double>(totals.plunges) * machine.lift.settle;
  return totals;
}

Eigen::VectorXd settling_of_strokes(const StrokeMoves& moves, const Machine& machine) {
  Eigen::VectorXd settling = Eigen::VectorXd::Zero(moves.strokes);
  if (machine.lift.settle == 0.0) return settling;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (comes_down(moves.steps, i) && moves.stroke[i] != StrokeMoves::kNoStroke)
      settling[moves.stroke[i]] += machine.lift.settle;
  }
  return settling;
}

double commanded_halt(double dwell, double settling) {
  return settling > 0.0 ? std::max(dwell - settling, kLeastHalt) : dwell;
}

}  // namespace dwell
