#include "runs/plan/dwell_options.h"

#include <fmt/format.h>

#include <utility>

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

namespace {

/// What speaks of heights, or knows nothing of slopes.
void check_slopes(const DwellOptions& options) {
  for (const auto& [name, goal] :
       {std::pair("smoothness", &options.smoothness), std::pair("time price", &options.time_price)}) {
    if (goal->kind != GoalKind::ResidualAtMost) continue;
    throw InputError(name, to_string(*goal), "another goal, or `objective` height",
                     fmt::format("`{}` '{}' is a target in heights, but `objective` is {}; required another goal, or "
                                 "height",
                                 name, to_string(*goal), to_string(options.objective)));
  }
  if (options.solver != SolverKind::Fourier) return;
  throw InputError("objective", to_string(options.objective), "height",
                   fmt::format("`objective` {} with `solver` fourier, which divides spectra of heights; required "
                               "another solver, or height",
                               to_string(options.objective)));
}

void check_robust(const DwellOptions& options) {
  const auto refuse = [](const std::string& what, const std::string& accepted) {
    throw InputError(fmt::format("`robust plan` with {}; required {}", what, accepted));
  };
  for (const auto& [name, goal] :
       {std::pair("smoothness", &options.smoothness), std::pair("time price", &options.time_price)}) {
    if (is_target(*goal)) {
      refuse(fmt::format("`{}` '{}', a target that would hold for the plan without it alone", name, to_string(*goal)),
             "a number, auto or corner");
    }
  }
  if (options.objective.has_slopes())
    refuse(fmt::format("`objective` {}, whose slopes are not expected", to_string(options.objective)), "height");
  if (options.solver == SolverKind::Fourier)
    refuse("`solver` fourier, which divides by the spectrum of one removal function", "another solver");
  constexpr double kNothing = 0.0;
  UncertaintySpec of_dwell = *options.robust;
  of_dwell.metrology = of_dwell.drift = kNothing;
  if (of_dwell == UncertaintySpec{}) {
    refuse("an `uncertainty` of metrology alone, which no dwell changes",
           "a size of tif-rate, tif-width, position, offset or rotation");
  }
}

}  // namespace

void check_weights(const DwellOptions& options) {
  weights_are_searched(options);
  if (options.objective.has_slopes()) check_slopes(options);
  if (options.robust) check_robust(options);
  if (options.time_price.kind == GoalKind::Auto || options.time_worth == TimeWorth{}) return;
  throw InputError("time worth", to_string(options.time_worth), "`time price` auto",
                   fmt::format("`time worth` {} rules the price where that is auto; `time price` is {}: leave one of "
                               "them out",
                               to_string(options.time_worth), to_string(options.time_price)));
}

}  // namespace dwell
