#include "solvers/weights/corner_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solvers/weights/nlopt_search.h"

namespace dwell {
namespace {

constexpr double kLeastChange = 0.01;     // of a logarithm over a corner range, that is: 1 %
constexpr double kSamePlace = 1e-4;       // trials nearer than this are one
constexpr double kPlaceTolerance = 5e-3;  // a corner is flat: its merit hardly changes over a tenth of a weight
constexpr int kScanOfOne = 7;             // points of the scan for one corner, ends included
constexpr int kScanOfEach = 3;            // and along each of two free weights

/// Logarithm of a quantity that may be zero.
double log_of(double value) { return std::log(std::max(value, 1e-12)); }

/// A weight that is searched: its place x in [0, 1] is logarithmic, but for the neighbourhood of weight 0 at x = 0.
class Axis {
 public:
  Axis(double Weights::*weight, double TradeOff::*cost, const WeightRange& range)
      : weight_(weight), cost_(cost), range_(range) {
    require_ordered(range);
    lower = place_of(range.corner_least);
    upper = place_of(range.corner_most);
  }

  void set(Weights& weights, double x) const { weights.*weight_ = weight_at(x); }
  double middle() const { return 0.5 * (lower + upper); }

  /// What is minimised: see search_corners.
  double merit(const TradeOff& t) const {
    return log_of(t.residual_rms) / residual_change_ + log_of(t.*cost_) / cost_change_;
  }

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
  WeightRange range_;
  double residual_change_ = 1.0, cost_change_ = 1.0;
};

using Place = std::vector<double>;  // one x an axis

class CornerSearch {
 public:
  CornerSearch(const WeightSearchOptions& options, const Weights& given, TrialBook& book)
      : options_(options), given_(given), book_(book) {
    if (options.smoothness.kind == GoalKind::Corner) {
      axes_.emplace_back(&Weights::smoothness, &TradeOff::step_rms, options.smoothness_range);
    }
    if (options.time_price.kind == GoalKind::Corner) {
      axes_.emplace_back(&Weights::time_price, &TradeOff::total, options.time_price_range);
    }
  }

  std::size_t run() {
    scan();
    if (!book_.ended()) refine();
    return best();
  }

 private:
  std::size_t steps() const { return static_cast<std::size_t>(axes_.size() == 1 ? kScanOfOne : kScanOfEach); }

  /// Along the corner weights, from the large ones, whose problems are the easiest, to the small ones, turning at the
  /// end of each line so that every trial has a neighbour to start from. The last axis changes fastest.
  void scan() {
    Place x;
    for (const Axis& axis : axes_) x.push_back(axis.middle());
    const Axis& last = axes_.back();
    bool down = true;
    for (std::size_t i = 0; i < steps(); ++i) {
      x.front() = scan_place(axes_.front(), i, true);
      if (axes_.size() == 1) {
        if (!trial_at(x)) return;
        continue;
      }
      for (std::size_t k = 0; k < steps(); ++k) {
        x.back() = scan_place(last, k, down);
        if (!trial_at(x)) return;
      }
      down = !down;
    }
    measure_ends();
  }

  double scan_place(const Axis& axis, std::size_t step, bool down) const {
    const double share = static_cast<double>(step) / static_cast<double>(steps() - 1);
    return down ? axis.upper - share * (axis.upper - axis.lower) : axis.lower + share * (axis.upper - axis.lower);
  }

  void measure_ends() {
    for (std::size_t a = 0; a < axes_.size(); ++a) {
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
      const double spacing = 1.0 / static_cast<double>(steps() - 1);
      problem.first_step.push_back(0.5 * spacing * (axis.upper - axis.lower));
    }
    problem.tolerance = kPlaceTolerance;
    // Trials that are repeated cost nothing.
    problem.max_evaluations = 4 * options_.evaluations_a_weight * static_cast<int>(axes_.size());
    problem.evaluate = [this](const Place& x, double& merit) {
      const auto k = trial_at(x);
      if (k) merit = merit_at(*k);
      return k && !book_.ended();
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
    // The book has room for a target's search after this one.
    if (places_.size() >= axes_.size() * static_cast<std::size_t>(options_.evaluations_a_weight)) return std::nullopt;
    Weights weights = given_;
    for (std::size_t a = 0; a < axes_.size(); ++a) axes_[a].set(weights, x[a]);
    const std::optional<std::size_t> k = book_.at(weights);
    if (k && *k == places_.size()) places_.push_back(x);
    return k;
  }

  double merit_at(std::size_t k) const {
    double sum = 0.0;
    for (const Axis& axis : axes_) sum += axis.merit(book_.trade_off(k));
    return sum;
  }

  std::size_t best() const {
    std::size_t chosen = 0;
    for (std::size_t k = 1; k < places_.size(); ++k) {
      if (merit_at(k) < merit_at(chosen)) chosen = k;
    }
    return chosen;
  }

  const WeightSearchOptions& options_;
  Weights given_;
  TrialBook& book_;
  std::vector<Axis> axes_;
  std::vector<Place> places_;  // of the trials
};

}  // namespace

std::size_t search_corners(const WeightSearchOptions& options, const Weights& given, TrialBook& book) {
  return CornerSearch(options, given, book).run();
}

}  // namespace dwell
