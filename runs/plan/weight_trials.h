#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "solvers/weights/weight_goal.h"

namespace dwell {

/// One evaluation of a search of the weights.
struct TriedWeights {
  Weights weights;
  TradeOff trade_off;
  double objective = 0.0;          // [nm^2], with these weights
  long operator_applications = 0;  // of its solve, and the one that measured the residual
};

/// How the weights of a plan were found.
struct WeightTrials {
  std::vector<TriedWeights> trials;  // in order
  std::size_t chosen = 0;
  std::string criterion;            // in words
  std::string outcome;              // "met", "conflict" (each target can be met, not both), "missed" or "unfinished"
  std::vector<std::size_t> front;   // where two targets are missed: the trials between them (WeightSearchResult)
  std::vector<std::string> limits;  // what was not met, a sentence each
};

/// The text of search.csv (docs/formats.md).
std::string write_trials(const WeightTrials& search);

}  // namespace dwell
