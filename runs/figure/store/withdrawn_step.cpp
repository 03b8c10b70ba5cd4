#include "runs/figure/store/withdrawn_step.h"

#include <fmt/format.h>

#include "core/base/errors.h"

namespace dwell {
namespace {

std::string accepted_steps(const RunFolder& run, const FigureState& state) {
  std::string list;
  for (const RunStep& step : run.steps()) {
    if (step.kind != step_kinds::kMeasured || state.withdrawn.contains(step.number)) continue;
    list += fmt::format("{}{}", list.empty() ? "" : ", ", step.number);
  }
  return list.empty() ? "none: nothing was measured" : list;
}

}  // namespace

const RunStep& withdraw_measurement(RunFolder& run, const FigureState& state, int number, const std::string& why) {
  const bool exists = number >= 1 && number <= static_cast<int>(run.steps().size());
  if (!exists || run.step(number).kind != step_kinds::kMeasured || state.withdrawn.contains(number)) {
    throw InputError(fmt::format("{}: step {} is no measurement that counts; accepted: {}", run.folder().string(),
                                 number, accepted_steps(run, state)));
  }
  if (number != state.map_step) {
    throw InputError(fmt::format("{}: step {}: the measurement of step {} rests on it; withdraw that first",
                                 run.folder().string(), number, state.map_step));
  }
  const int iteration = run.step(number).iteration;
  return run.append(step_kinds::kWithdrawn, iteration, [&](const OutputFolder&) {
    return nlohmann::ordered_json{{"step", number}, {"why", why}};
  });
}

}  // namespace dwell
