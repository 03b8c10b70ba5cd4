#include "solvers/weights/corner_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solvers/weights/nlopt_search.h"

namespace dwell {
namespace {

constexpr double kLeastChange = 0.01;     // of a logarithm over a corner range, that is: 1 %
constexpr double kLeastGain = 1e-3;       // of a logarithm a decade beyond the range, or it is no use
constexpr double kSamePlace = 1e-4;       // trials nearer than this are one
constexpr double kPlaceTolerance = 5e-3;  // a corner is flat: its merit hardly changes over a tenth of a weight
constexpr std::size_t kTrialsBeforeEnd = 3;
constexpr int kScanOfOne = 7;   // points of the scan for one corner, ends included
constexpr int kScanOfEach = 3;  // and along each of two free weights

/// Logarithm of a quantity that may be zero.
double log_of(double value) { return std::log(std::max(value, 1e-12)); }

/// A weight that is searched: its place x in [0, 1] is logarithmic, but for the neighbourhood of weight 0 at x = 0.
class Axis {
 public:
  Axis(double Weights::*weight, double TradeOff::*cost, const WeightGoal& goal, const WeightRange& range)
      : weight_(weight), cost_(cost), goal_(goal), range_(range) {
    require_ordered(range);
    lower = corner() ? place_of(range.corner_least) : 0.0;
    upper = corner() ? place_of(range.corner_most) : 1.0;
  }

  bool corner() const { return goal_.kind == GoalKind::Corner; }
  void set(Weights& weights, double x) const { weights.*weight_ = weight_at(x); }
  double middle() const { return 0.5 * (lower + upper); }

  double excess(const TradeOff& t) const { return target_excess(goal_, t); }
  bool meets(const TradeOff& t) const { return excess(t) <= 0.0; }

  /// What is minimised: see search_corners.
  double merit(double x, const TradeOff& t) const {
    if (corner()) return log_of(t.residual_rms) / residual_change_ + log_of(t.*cost_) / cost_change_;
    return goal_.kind == GoalKind::ResidualAtMost ? -x : x;
  }
  /// Moves the upper end of a step or a total by a decade; false at the ceiling, or where none is wanted.
  bool widen() {
    if (corner() || goal_.kind == GoalKind::ResidualAtMost || upper >= place_of(range_.ceiling)) return false;
    upper = std::min(upper + std::log(10.0) / span(), place_of(range_.ceiling));
    return true;
  }
  double easiest_end() const { return goal_.kind == GoalKind::ResidualAtMost ? lower : upper; }

  /// The trade-offs at both ends of the corner range.
  void set_ends(const TradeOff& least, const TradeOff& most) {
    const auto change = [&](double TradeOff::*q) {
      return std::max(std::abs(log_of(least.*q) - log_of(most.*q)), kLeastChange);
    };
    residual_change_ = change(&TradeOff::residual_rms);
    cost_change_ = change(cost_);
  }

  double lower = 0.0, upper = 1.0;

 private:
  double span() const { return std::log1p(range_.most / range_.least); }
  double place_of(double weight) const { return std::log1p(weight / range_.least) / span(); }
  double weight_at(double x) const {
    if (x == 1.0) return range_.most;
    return std::min(range_.least * std::expm1(x * span()), range_.ceiling);
  }

  double Weights::*weight_;
  double TradeOff::*cost_;
  WeightGoal goal_;
  WeightRange range_;
  double residual_change_ = 1.0, cost_change_ = 1.0;
};

using Place = std::vector<double>;  // one x an axis

class CornerSearch {
 public:
  CornerSearch(const WeightSearchOptions& options, TrialBook& book) : options_(options), book_(book) {
    if (options.smoothness.kind != GoalKind::Fixed) {
      axes_.emplace_back(&Weights::smoothness, &TradeOff::step_rms, options.smoothness, options.smoothness_range);
    }
    if (options.time_price.kind != GoalKind::Fixed) {
      axes_.emplace_back(&Weights::time_price, &TradeOff::total, options.time_price, options.time_price_range);
    }
  }

  std::size_t run() {
    scan();
    if (!book_.ended()) refine();
    if (!book_.ended() && !meets(book_.trade_off(best()))) {
      widen();
      if (!book_.ended() && meets(book_.trade_off(best()))) refine();
    }
    return best();
  }

 private:
  std::size_t steps(const Axis& axis) const {
    if (!axis.corner()) return 1;
    return static_cast<std::size_t>(axes_.size() == 1 ? kScanOfOne : kScanOfEach);
  }

  /// Along the corner weights, from the large ones, whose problems are the easiest, to the small ones, turning at the
  /// end of each line so that every trial has a neighbour to start from. The last axis changes fastest.
  void scan() {
    Place x;
    for (const Axis& axis : axes_) x.push_back(axis.middle());
    const Axis& last = axes_.back();
    bool down = true;
    for (std::size_t i = 0; i < steps(axes_.front()); ++i) {
      x.front() = scan_place(axes_.front(), i, true);
      if (axes_.size() == 1) {
        if (!trial_at(x)) return;
        continue;
      }
      for (std::size_t k = 0; k < steps(last); ++k) {
        x.back() = scan_place(last, k, down);
        if (!trial_at(x)) return;
      }
      down = !down;
    }
    measure_ends();
  }

  double scan_place(const Axis& axis, std::size_t step, bool down) const {
    const std::size_t count = steps(axis);
    if (count == 1) return axis.middle();
    const double share = static_cast<double>(step) / static_cast<double>(count - 1);
    return down ? axis.upper - share * (axis.upper - axis.lower) : axis.lower + share * (axis.upper - axis.lower);
  }

  void measure_ends() {
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      if (!axes_[a].corner()) continue;
      Place least, most;
      for (const Axis& axis : axes_) least.push_back(axis.middle());
      most = least;
      least[a] = axes_[a].lower;
      most[a] = axes_[a].upper;
      const auto low = trial_at(least), high = trial_at(most);  // both scanned already
      if (low && high) axes_[a].set_ends(book_.trade_off(*low), book_.trade_off(*high));
    }
  }

  void refine() {
    FewVariableProblem problem;
    problem.start = places_[best()];
    for (const Axis& axis : axes_) {
      problem.lower.push_back(axis.lower);
      problem.upper.push_back(axis.upper);
      const double spacing = axis.corner() ? 1.0 / static_cast<double>(steps(axis) - 1) : 0.5;
      problem.first_step.push_back(0.5 * spacing * (axis.upper - axis.lower));
    }
    problem.constraints =
        static_cast<int>(std::count_if(axes_.begin(), axes_.end(), [](const Axis& a) { return !a.corner(); }));
    problem.tolerance = kPlaceTolerance;
    // Trials that are repeated cost nothing.
    problem.max_evaluations = 4 * options_.evaluations_a_weight * static_cast<int>(axes_.size());
    problem.evaluate = [this](const Place& x, double& merit, std::vector<double>& excess) {
      const auto k = trial_at(x);
      if (!k) return false;
      const TradeOff& t = book_.trade_off(*k);
      merit = merit_at(*k);
      // Half the tolerance on the safe side, since what is found must meet the target in spite of noise.
      std::size_t c = 0;
      for (const Axis& axis : axes_) {
        if (!axis.corner()) excess[c++] = axis.excess(t) + 0.5 * options_.tolerance;
      }
      try_easiest_end();
      return !book_.ended();
    };
    search_few_variables(problem);
  }

  /// The trial at x: an earlier one, or a new one; nothing if the search must end.
  std::optional<std::size_t> trial_at(const Place& x) {
    for (std::size_t k = 0; k < places_.size(); ++k) {
      double distance = 0.0;
      for (std::size_t a = 0; a < x.size(); ++a) distance = std::max(distance, std::abs(x[a] - places_[k][a]));
      if (distance <= kSamePlace) return k;
    }
    Weights weights{options_.smoothness.value, options_.time_price.value};
    for (std::size_t a = 0; a < axes_.size(); ++a) axes_[a].set(weights, x[a]);
    const std::optional<std::size_t> k = book_.at(weights);
    if (k && *k == places_.size()) places_.push_back(x);
    return k;
  }

  bool meets(const TradeOff& t) const {
    return std::all_of(axes_.begin(), axes_.end(), [&](const Axis& a) { return a.meets(t); });
  }

  double merit_at(std::size_t k) const {
    double sum = 0.0;
    for (std::size_t a = 0; a < axes_.size(); ++a) sum += axes_[a].merit(places_[k][a], book_.trade_off(k));
    return sum;
  }

  double excess_at(std::size_t k) const {
    double worst = -std::numeric_limits<double>::infinity();
    for (const Axis& axis : axes_) worst = std::max(worst, axis.excess(book_.trade_off(k)));
    return worst;
  }

  /// If no trial has met the target yet, tries the end of its range where it is easiest to meet, since the curves are
  /// flat there and the search itself would only creep towards it.
  void try_easiest_end() {
    if (places_.size() < kTrialsBeforeEnd * axes_.size() || meets(book_.trade_off(best()))) return;
    Place end;
    for (const Axis& axis : axes_) end.push_back(axis.corner() ? axis.middle() : axis.easiest_end());
    trial_at(end);
  }

  /// Where a step or a total is missed, goes on to larger weights, decade by decade, until it is met, no longer
  /// changes, or the ceiling is reached.
  void widen() {
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      Place x = places_[best()];
      double excess = axes_[a].excess(book_.trade_off(best())), gain = std::numeric_limits<double>::infinity();
      while (excess > 0.0 && gain > kLeastGain && axes_[a].widen()) {
        x[a] = axes_[a].upper;
        const auto k = trial_at(x);
        if (!k) return;
        gain = excess - axes_[a].excess(book_.trade_off(*k));
        excess = axes_[a].excess(book_.trade_off(*k));
      }
    }
  }

  std::size_t best() const {
    std::size_t chosen = 0;
    for (std::size_t k = 1; k < places_.size(); ++k) {
      const bool meets_k = meets(book_.trade_off(k)), meets_chosen = meets(book_.trade_off(chosen));
      const bool better = meets_k && meets_chosen   ? merit_at(k) < merit_at(chosen)
                          : meets_k == meets_chosen ? excess_at(k) < excess_at(chosen)
                                                    : meets_k;
      if (better) chosen = k;
    }
    return chosen;
  }

  const WeightSearchOptions& options_;
  TrialBook& book_;
  std::vector<Axis> axes_;
  std::vector<Place> places_;  // of the trials
};

}  // namespace

std::size_t search_corners(const WeightSearchOptions& options, TrialBook& book) {
  return CornerSearch(options, book).run();
}

}  // namespace dwell
