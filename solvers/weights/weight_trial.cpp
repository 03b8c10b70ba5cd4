#include "solvers/weights/weight_trial.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dwell {
namespace {

bool same_weight(double a, double b) {
  constexpr double kSame = 1e-3;
  return std::abs(a - b) <= kSame * std::min(a, b);
}

}  // namespace

std::optional<std::size_t> TrialBook::at(const Weights& weights) {
  for (std::size_t k = 0; k < trials_.size(); ++k) {
    const Weights& w = trials_[k].weights;
    if (same_weight(w.smoothness, weights.smoothness) && same_weight(w.time_price, weights.time_price)) return k;
  }
  ended_ = ended_ || full();
  if (ended_) return std::nullopt;
  const std::optional<TradeOff> t = evaluate_(weights);
  if (!t && trials_.empty()) throw std::invalid_argument("a search ended before its first trial");
  ended_ = !t;
  if (!t) return std::nullopt;
  for (const double q : {t->residual_rms, t->total, t->step_rms}) {
    if (!(std::isfinite(q) && q >= 0.0)) throw std::invalid_argument("a trade-off is not finite and >= 0");
  }
  trials_.push_back({weights, *t});
  return trials_.size() - 1;
}

}  // namespace dwell
