#include "solvers/weights/weight_goal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dwell {

bool is_target(const WeightGoal& goal) {
  return goal.kind != GoalKind::Fixed && goal.kind != GoalKind::Auto && goal.kind != GoalKind::Corner;
}

double target_excess(const WeightGoal& goal, const TradeOff& trade_off) {
  constexpr double kNothing = 1e-12;  // stands for a quantity of zero
  if (!is_target(goal)) return -std::numeric_limits<double>::infinity();
  const double quantity = goal.kind == GoalKind::StepAtMost    ? trade_off.step_rms
                          : goal.kind == GoalKind::TotalAtMost ? trade_off.total
                                                               : trade_off.residual_rms;
  return std::log(std::max(quantity, kNothing)) - std::log(std::max(goal.value, kNothing));
}

WeightRange time_price_range(double highest) {
  constexpr double kLeast = 1e-6, kCornerLeast = 1e-5, kCornerMost = 1e-1, kCeiling = 1e3;  // of the highest
  return {kLeast * highest, highest, kCornerLeast * highest, kCornerMost * highest, kCeiling * highest};
}

void require_ordered(const WeightRange& r) {
  const bool ordered = 0.0 < r.least && r.least <= r.corner_least && r.corner_least < r.corner_most &&
                       r.corner_most <= r.most && r.most <= r.ceiling;
  if (!ordered || !std::isfinite(r.ceiling)) throw std::invalid_argument("the range of a weight is out of order");
}

}  // namespace dwell
