#include "solvers/weights/weight_search.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "solvers/weights/corner_search.h"
#include "solvers/weights/target_search.h"

namespace dwell {
namespace {

// With which the corner of the time price is looked for where the smoothness has a target: that without any option.
constexpr double kUsualSmoothness = 0.1;

struct Choice {
  const WeightSearchOptions& options;
  const std::vector<WeightTrial>& trials;

  std::array<double, 2> excesses(std::size_t k) const {
    return {target_excess(options.smoothness, trials[k].trade_off),
            target_excess(options.time_price, trials[k].trade_off)};
  }
  double worst_excess(std::size_t k) const { return std::max(excesses(k)[0], excesses(k)[1]); }

  /// What is to be small among trials that meet the targets, without corners.
  double preference(std::size_t k) const {
    const WeightGoal &s = options.smoothness, &p = options.time_price;
    const WeightTrial& t = trials[k];
    if (is_target(s) && is_target(p)) {
      if (s.kind == GoalKind::ResidualAtMost) return t.trade_off.step_rms;
      return p.kind == GoalKind::ResidualAtMost ? t.trade_off.total : t.trade_off.residual_rms;
    }
    const double weight = is_target(s) ? t.weights.smoothness : t.weights.time_price;
    return s.kind == GoalKind::ResidualAtMost || p.kind == GoalKind::ResidualAtMost ? -weight : weight;
  }

  /// Of those that are wanted, the first of which is given.
  template <class Wanted>
  std::size_t best(std::size_t first, const Wanted& wanted) const {
    std::size_t chosen = first;
    for (std::size_t k = 0; k < trials.size(); ++k) {
      if (!wanted(trials[k])) continue;
      const bool meets = worst_excess(k) <= 0.0, chosen_meets = worst_excess(chosen) <= 0.0;
      const bool better = meets && chosen_meets   ? preference(k) < preference(chosen)
                          : meets == chosen_meets ? worst_excess(k) < worst_excess(chosen)
                                                  : meets;
      if (better) chosen = k;
    }
    return chosen;
  }

  /// See WeightSearchResult::front.
  std::vector<std::size_t> front() const {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < trials.size(); ++k) order.push_back(k);
    std::stable_sort(order.begin(), order.end(),
                     [this](std::size_t a, std::size_t b) { return excesses(a) < excesses(b); });
    std::vector<std::size_t> front;  // the smoothness target's excess rises, the other's falls
    for (const std::size_t k : order) {
      if (!front.empty() && excesses(k)[1] >= excesses(front.back())[1]) continue;
      if (!front.empty() && excesses(k)[0] <= 0.0) front.clear();  // an end nearer to the other target
      front.push_back(k);
      if (excesses(k)[1] <= 0.0) break;
    }
    return front;
  }
};

}  // namespace

WeightSearchResult search_weights(const WeightSearchOptions& options, const WeightEvaluator& evaluate) {
  const WeightGoal &s = options.smoothness, &p = options.time_price;
  const TargetWeight smoothness{&Weights::smoothness, s, options.smoothness_range};
  const TargetWeight price{&Weights::time_price, p, options.time_price_range};
  std::size_t free = 0;
  for (const TargetWeight& w : {smoothness, price}) {
    if (w.goal.kind == GoalKind::Fixed) continue;
    ++free;
    require_ordered(w.range);
  }
  if (free == 0) throw std::invalid_argument("no weight to search");
  if (s.kind == GoalKind::ResidualAtMost && p.kind == s.kind) {
    throw std::invalid_argument("both weights hold a residual");
  }
  TrialBook book(evaluate, free * static_cast<std::size_t>(std::max(options.evaluations_a_weight, 1)));
  const bool corner = s.kind == GoalKind::Corner || p.kind == GoalKind::Corner, target = is_target(s) || is_target(p);
  Weights given{s.kind == GoalKind::Fixed ? s.value : 0.0, p.kind == GoalKind::Fixed ? p.value : 0.0};
  WeightSearchResult result;
  bool ended = true;  // of itself
  if (corner) {
    if (is_target(s)) given.smoothness = kUsualSmoothness;
    result.chosen = search_corners(options, given, book);
    given = book.trials()[result.chosen].weights;
  }
  const std::size_t first = corner ? result.chosen : 0;  // of the trials that the target is chosen from
  if (is_target(s) && is_target(p)) {
    ended = search_two_targets(smoothness, price, options.tolerance, book);
  } else if (target) {
    search_one_target(is_target(s) ? smoothness : price, given, options.tolerance, book);
  }
  result.trials = book.trials();
  const Choice choice{options, result.trials};
  const auto has_corner = [&](const WeightTrial& t) {
    return is_target(s) ? t.weights.time_price == given.time_price : t.weights.smoothness == given.smoothness;
  };
  if (target) result.chosen = choice.best(first, [&](const WeightTrial& t) { return !corner || has_corner(t); });
  if (choice.worst_excess(result.chosen) > 0.0) {
    result.end = book.ended() || !ended ? SearchEnd::Unfinished : SearchEnd::Missed;
    if (is_target(s) && is_target(p)) result.front = choice.front();
  }
  return result;
}

}  // namespace dwell
