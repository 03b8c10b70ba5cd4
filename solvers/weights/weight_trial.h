#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "solvers/weights/weight_goal.h"

namespace dwell {

struct WeightTrial {
  Weights weights;
  TradeOff trade_off;
};

/// Solves the dwell problem with these weights; nothing = end the search (not before the first trial). May throw.
using WeightEvaluator = std::function<std::optional<TradeOff>(const Weights&)>;

/// The trials of a search: no weights are evaluated twice, and not more of them than allowed.
class TrialBook {
 public:
  TrialBook(const WeightEvaluator& evaluate, std::size_t most) : evaluate_(evaluate), most_(most) {}

  /// The trial with these weights (to 0.1 %): an earlier one, or a new one; nothing if the search must end. Throws
  /// std::invalid_argument if a trade-off is not finite and >= 0, or nothing comes of the first trial.
  std::optional<std::size_t> at(const Weights& weights);

  const std::vector<WeightTrial>& trials() const { return trials_; }
  const TradeOff& trade_off(std::size_t k) const { return trials_[k].trade_off; }
  bool full() const { return trials_.size() >= most_; }
  /// Whether a trial was refused: by the evaluator, or because the book is full.
  bool ended() const { return ended_; }

 private:
  const WeightEvaluator& evaluate_;
  std::size_t most_;
  std::vector<WeightTrial> trials_;
  bool ended_ = false;
};

}  // namespace dwell
