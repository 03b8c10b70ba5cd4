#pragma once

#include <string>

#include "runs/plan/weight_trials.h"
#include "solvers/weights/weight_search.h"

namespace dwell {

/// By what the weights are chosen, in words.
std::string search_criterion(const WeightSearchOptions& how);

/// Sets the outcome of a search that has its trials and its front, and adds a sentence to its limits for whatever was
/// missed: that both targets conflict only where each was met without the other, and the search came to its end. What
/// it says of the nearest trial holds among all trials.
void judge_search(const WeightSearchOptions& how, SearchEnd end, WeightTrials& search);

}  // namespace dwell
