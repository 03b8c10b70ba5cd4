#pragma once

#include <string>

#include "runs/plan/weight_trials.h"
#include "solvers/weights/weight_goal.h"

namespace dwell {

/// Where a search of two targets missed them: lines for people with some of the trials on the front between them, both
/// ends and the plan's own among them, at most seven. Each ends with a new line; empty if there is no front.
std::string front_lines(const WeightTrials& search, const WeightGoal& smoothness, const WeightGoal& price);

}  // namespace dwell
