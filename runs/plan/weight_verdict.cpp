#include "runs/plan/weight_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "solvers/weights/weight_option.h"

namespace dwell {
namespace {

constexpr const char* kPriceUnit = " nm^2/s";

/// A free weight as messages name it.
struct NamedGoal {
  const char* name;
  const WeightGoal& goal;
  const WeightRange& range;
  double Weights::*weight;
  const char* unit;

  std::string text() const { return fmt::format("`{}` '{}'", name, to_string(goal)); }
  std::string quantity(const TradeOff& t) const {
    return fmt::format("{} {:.6g} {}", quantity_of(goal.kind), quantity_of(goal.kind, t), unit_of(goal.kind));
  }
  bool met_by(const TriedWeights& t) const { return target_excess(goal, t.trade_off) <= 0.0; }
  /// The weights that were tried, from the least to the largest.
  std::string tried(const WeightTrials& search) const {
    const auto [least, most] =
        std::minmax_element(search.trials.begin(), search.trials.end(),
                            [this](const auto& a, const auto& b) { return a.weights.*weight < b.weights.*weight; });
    return fmt::format("{} from {:.4g} to {:.4g}{}", name, least->weights.*weight, most->weights.*weight, unit);
  }
};

NamedGoal smoothness_of(const WeightSearchOptions& how) {
  return {"smoothness", how.smoothness, how.smoothness_range, &Weights::smoothness, ""};
}
NamedGoal price_of(const WeightSearchOptions& how) {
  return {"time price", how.time_price, how.time_price_range, &Weights::time_price, kPriceUnit};
}

std::string criterion_of(const NamedGoal& g) {
  switch (g.goal.kind) {
    case GoalKind::Fixed:
      return fmt::format("{}: {}{}", g.name, g.goal.value, g.unit);
    case GoalKind::Corner:
      return fmt::format("{}: corner of the L-curve (largest distance from its chord, log-log) from {:.3g} to {:.3g}{}",
                         g.name, g.range.corner_least, g.range.corner_most, g.unit);
    case GoalKind::ResidualAtMost:
      return fmt::format("{}: largest up to {:.3g}{} with residual RMS <= {} nm", g.name, g.range.most, g.unit,
                         g.goal.value);
    default:
      return fmt::format("{}: least up to {:.3g}{} with {} <= {} s", g.name, g.range.ceiling, g.unit,
                         quantity_of(g.goal.kind), g.goal.value);
  }
}

std::string weights_text(const Weights& w) {
  return fmt::format("smoothness {:.4g}, time price {:.4g}{}", w.smoothness, w.time_price, kPriceUnit);
}

/// Of a target that no trial meets: how near its quantity came.
std::string unreached(const NamedGoal& g, const WeightTrials& search) {
  const TriedWeights& nearest =
      *std::min_element(search.trials.begin(), search.trials.end(), [&g](const auto& a, const auto& b) {
        return quantity_of(g.goal.kind, a.trade_off) < quantity_of(g.goal.kind, b.trade_off);
      });
  return fmt::format("{} is not met: {} weights tried, {}; the nearest has {} ({})", g.text(), search.trials.size(),
                     g.tried(search), g.quantity(nearest.trade_off), weights_text(nearest.weights));
}

/// The plan's weights, where two targets are missed.
std::string nearest_to_both(const NamedGoal& a, const NamedGoal& b, const WeightTrials& search) {
  const TriedWeights& t = search.trials[search.chosen];
  const double worst = std::exp(std::max(target_excess(a.goal, t.trade_off), target_excess(b.goal, t.trade_off)));
  return fmt::format("the plan is the nearest of the solves, at most {:.4g} times a target: {}, {} ({})", worst,
                     a.quantity(t.trade_off), b.quantity(t.trade_off), weights_text(t.weights));
}

/// Both targets missed by every trial.
void judge_both(const NamedGoal& a, const NamedGoal& b, SearchEnd end, WeightTrials& search) {
  const auto reached = [&search](const NamedGoal& g) {
    return std::any_of(search.trials.begin(), search.trials.end(), [&g](const auto& t) { return g.met_by(t); });
  };
  const bool both = reached(a) && reached(b);
  if (end == SearchEnd::Unfinished) {
    search.outcome = "unfinished";
    search.limits.push_back(
        fmt::format("{} and {} are not met together by {}; whether some weights meet both is open; {}", a.text(),
                    b.text(), counted(search.trials.size(), "solve"), nearest_to_both(a, b, search)));
    return;
  }
  search.outcome = both ? "conflict" : "missed";
  if (both) {
    search.limits.push_back(fmt::format(
        "{} and {} are in conflict: each can be met, but no weights meet both ({}, {}, {}); {}", a.text(), b.text(),
        counted(search.trials.size(), "solve"), a.tried(search), b.tried(search), nearest_to_both(a, b, search)));
    return;
  }
  for (const NamedGoal* g : {&a, &b}) {
    if (!reached(*g)) search.limits.push_back(unreached(*g, search));
  }
  search.limits.back() += "; " + nearest_to_both(a, b, search);
}

}  // namespace

std::string search_criterion(const WeightSearchOptions& how) {
  const NamedGoal a = smoothness_of(how), b = price_of(how);
  if (!is_target(a.goal) || !is_target(b.goal)) return criterion_of(a) + "; " + criterion_of(b);
  const char* least = a.goal.kind == GoalKind::ResidualAtMost   ? "step RMS"
                      : b.goal.kind == GoalKind::ResidualAtMost ? "total dwell"
                                                                : "residual RMS";
  return fmt::format(
      "smoothness up to {:.3g} and time price up to {:.3g}{}: the least {} with {} <= {} {} and {} <= {} {}",
      a.range.ceiling, b.range.ceiling, kPriceUnit, least, quantity_of(a.goal.kind), a.goal.value, unit_of(a.goal.kind),
      quantity_of(b.goal.kind), b.goal.value, unit_of(b.goal.kind));
}

void judge_search(const WeightSearchOptions& how, SearchEnd end, WeightTrials& search) {
  const NamedGoal a = smoothness_of(how), b = price_of(how);
  search.outcome = "met";
  if (end == SearchEnd::Met) return;
  if (is_target(a.goal) && is_target(b.goal)) {
    judge_both(a, b, end, search);
    return;
  }
  search.outcome = end == SearchEnd::Unfinished ? "unfinished" : "missed";
  for (const NamedGoal* g : {&a, &b}) {
    if (is_target(g->goal)) search.limits.push_back(unreached(*g, search));
  }
}

}  // namespace dwell
