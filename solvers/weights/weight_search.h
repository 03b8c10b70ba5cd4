#pragma once

#include <cstddef>
#include <vector>

#include "solvers/weights/weight_search_options.h"
#include "solvers/weights/weight_trial.h"

namespace dwell {

/// How a search ended.
enum class SearchEnd {
  Met,         // the chosen trial meets every target
  Missed,      // no weights do
  Unfinished,  // no trial did before the evaluator or the number of evaluations ended the search
};

struct WeightSearchResult {
  std::vector<WeightTrial> trials;  // in the order evaluated; never empty
  std::size_t chosen = 0;
  SearchEnd end = SearchEnd::Met;
  /// Where two targets are missed: the trials between them that no other dominates in their two quantities, from the
  /// one that meets the smoothness target, or comes nearest to it, to the one that does so with the other.
  std::vector<std::size_t> front;

  bool met() const { return end == SearchEnd::Met; }
};

/// Chooses the weights (docs/math.md, "Choosing the weights"): by search_one_target, search_two_targets, or
/// search_corners where a weight is at its corner. With a target for the other weight, the corner is found first, and
/// its weight held while the target's is searched. The answer is one of the trials. Of those that meet every target it
/// is the one with the least weight of a step or a total alone, the largest of a residual alone, the least third
/// quantity of two targets; without targets, the best corner. If none does, it is the one that exceeds its targets by
/// the smallest factor at the worst. Deterministic; at most evaluations_a_weight evaluations a free weight. Throws
/// std::invalid_argument if no weight is free, both goals are residuals, a range is not ordered, or a trade-off is not
/// finite and >= 0.
WeightSearchResult search_weights(const WeightSearchOptions& options, const WeightEvaluator& evaluate);

}  // namespace dwell
