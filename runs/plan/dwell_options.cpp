#include "runs/plan/dwell_options.h"

#include <fmt/format.h>

#include "core/base/errors.h"
#include "solvers/weights/weight_option.h"

namespace dwell {

bool weights_are_searched(const DwellOptions& options) {
  const WeightGoal &smoothness = options.smoothness, &price = options.time_price;
  if (smoothness.kind == GoalKind::ResidualAtMost && price.kind == GoalKind::ResidualAtMost) {
    throw InputError(fmt::format(
        "`smoothness` '{}' and `time price` '{}' leave open which weight takes up the residual; required for one of "
        "them: a number, auto, corner, 'step<=S' (smoothness) or 'total<=S' (time price)",
        to_string(smoothness), to_string(price)));
  }
  const auto searched = [](const WeightGoal& goal) { return goal.kind == GoalKind::Corner || is_target(goal); };
  return searched(smoothness) || searched(price);
}

}  // namespace dwell
