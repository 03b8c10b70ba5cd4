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

void check_weights(const DwellOptions& options) {
  weights_are_searched(options);
  if (options.time_price.kind == GoalKind::Auto || options.time_worth == TimeWorth{}) return;
  throw InputError("time worth", to_string(options.time_worth), "`time price` auto",
                   fmt::format("`time worth` {} rules the price where that is auto; `time price` is {}: leave one of "
                               "them out",
                               to_string(options.time_worth), to_string(options.time_price)));
}

}  // namespace dwell
