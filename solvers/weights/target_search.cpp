#include "solvers/weights/target_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solvers/weights/monotone_root.h"

namespace dwell {
namespace {

constexpr double kDecade = 2.302585092994046;  // ln 10
constexpr double kResidualSlope = 0.6;         // about that of the logarithm of a residual over that of both weights
constexpr double kLargestRatio =
    6.0 * kDecade;  // of the weights, in the middle of their ranges; beyond, one of them is 0

/// The place of a weight on its scale: a logarithm above `least`, but with 0 at 0.
double place_on_scale(double weight, double least) { return std::log1p(weight / least); }
double weight_on_scale(double place, double least) { return least * std::expm1(place); }
/// The same for a weight itself, which rounding must not carry beyond the largest that a job may name.
double weight_on_scale(double place, const WeightRange& range) {
  return std::min(weight_on_scale(place, range.least), range.ceiling);
}

double middle_of(const WeightRange& range) { return std::sqrt(range.least * range.most); }
double excess_of(const TargetWeight& target, const TradeOff& t) { return target_excess(target.goal, t); }

/// A target is aimed at half the tolerance on the safe side, since it must be met in spite of noise. With this offset
/// it is met closely, if |offset excess| <= tolerance / 2.
double offset_excess(const TargetWeight& target, const TradeOff& t, double tolerance) {
  return excess_of(target, t) + 0.5 * tolerance;
}
bool is_close(double offset, double tolerance) { return std::abs(offset) <= 0.5 * tolerance; }

/// Rising in the weight's place: of a residual the excess, of a step or a total the reserve.
double rising(const TargetWeight& target, double excess) {
  return target.goal.kind == GoalKind::ResidualAtMost ? excess : -excess;
}

class TwoTargets {
 public:
  TwoTargets(const TargetWeight& smoothness, const TargetWeight& price, double tolerance, TrialBook& book)
      : on_rays_(smoothness.goal.kind == GoalKind::ResidualAtMost || price.goal.kind == GoalKind::ResidualAtMost),
        held_(smoothness.goal.kind == GoalKind::ResidualAtMost ? smoothness : price),
        other_(smoothness.goal.kind == GoalKind::ResidualAtMost ? price : smoothness),
        tolerance_(tolerance),
        book_(book) {
    least_scale_ = std::min(held_.range.least / middle_of(held_.range), other_.range.least / middle_of(other_.range));
  }

  bool run() {
    MonotoneRoot outer;
    outer.first_step = 2.0 * kDecade;
    outer.start = on_rays_ ? kLargestRatio : place_on_scale(middle_of(other_.range), other_.range.least);
    outer.ceiling = outer_ceiling();
    outer.ordinary_end = on_rays_ ? outer.ceiling : place_on_scale(other_.range.most, other_.range.least);
    outer.value = [this](double y) -> std::optional<double> {
      const std::optional<std::size_t> k = hold(y);
      if (!k) return std::nullopt;
      const bool done = settled(*k) || (as_large_as_useful_ && meets(book_.trade_off(*k)));
      return done ? 0.0 : -offset_excess(other_, book_.trade_off(*k), tolerance_);
    };
    const RootEnd end = find_monotone_root(outer);
    const auto& trials = book_.trials();
    if (std::any_of(trials.begin(), trials.end(), [this](const auto& t) { return meets(t.trade_off); })) return true;
    // Stopped before the book ended: the held target is out of reach, or a conflict is shown.
    if (book_.ended() || end == RootEnd::Found) return false;
    if (on_rays_) {
      follow_front();
    } else {
      search_one_target(other_, {}, tolerance_, book_);  // shows whether it can be met alone
    }
    return !book_.ended();
  }

 private:
  bool meets(const TradeOff& t) const { return excess_of(held_, t) <= 0.0 && excess_of(other_, t) <= 0.0; }

  /// Both met, and each closely, or by a weight of 0.
  bool settled(std::size_t k) const {
    const TradeOff& t = book_.trade_off(k);
    const Weights& w = book_.trials()[k].weights;
    if (!meets(t)) return false;
    const bool held =
        is_close(offset_excess(held_, t, tolerance_), tolerance_) || (!on_rays_ && w.*held_.weight == 0.0);
    return held && (is_close(offset_excess(other_, t, tolerance_), tolerance_) || w.*other_.weight == 0.0);
  }

  /// Allowing for the solver's noise.
  bool exceeds_both(std::size_t k) const {
    const TradeOff& t = book_.trade_off(k);
    return excess_of(held_, t) > tolerance_ && excess_of(other_, t) > tolerance_;
  }

  /// Where a trial exceeds both targets, one more without the weight of the held target may prove that no dwell times
  /// meet both (search_two_targets). It is tried a few times only: far from such a pair it says nothing.
  bool shows_conflict(std::size_t k) {
    constexpr int kMostProofs = 2;
    if (!on_rays_ || !exceeds_both(k)) return false;
    Weights alone = book_.trials()[k].weights;
    if (alone.*held_.weight == 0.0) return true;
    if (proofs_tried_++ >= kMostProofs) return false;
    alone.*held_.weight = 0.0;
    const std::optional<std::size_t> proof = book_.at(alone);
    return proof && exceeds_both(*proof);
  }

  double outer_ceiling() const {
    return on_rays_ ? 2.0 * kLargestRatio : place_on_scale(other_.range.ceiling, other_.range.least);
  }

  /// The shares that both weights have in their common scale, of which the larger is 1, at the outer place y.
  struct Shares {
    double held, other;
  };
  static Shares shares_at(double y) {
    const double ratio = y - kLargestRatio;  // logarithm of other to held
    if (ratio <= -kLargestRatio) return {1.0, 0.0};
    if (ratio >= kLargestRatio) return {0.0, 1.0};
    return {std::min(1.0, std::exp(-ratio)), std::min(1.0, std::exp(ratio))};
  }

  Weights weights_at(double y, double x) const {
    Weights w;
    if (on_rays_) {
      const double scale = weight_on_scale(x, least_scale_);
      const Shares shares = shares_at(y);
      w.*held_.weight = std::min(scale * shares.held * middle_of(held_.range), held_.range.ceiling);
      w.*other_.weight = std::min(scale * shares.other * middle_of(other_.range), other_.range.ceiling);
    } else {
      w.*held_.weight = weight_on_scale(x, held_.range);
      w.*other_.weight = weight_on_scale(y, other_.range);
    }
    return w;
  }

  /// The inner place where the first of the weights is `end` (WeightRange::most or ceiling).
  double place_of_end(double y, double WeightRange::*end) const {
    if (!on_rays_) return place_on_scale(held_.range.*end, held_.range.least);
    const Shares shares = shares_at(y);
    double scale = std::numeric_limits<double>::infinity();
    if (shares.held > 0.0) scale = std::min(scale, held_.range.*end / (shares.held * middle_of(held_.range)));
    if (shares.other > 0.0) scale = std::min(scale, other_.range.*end / (shares.other * middle_of(other_.range)));
    return place_on_scale(scale, least_scale_);
  }

  /// Where the inner root is to be expected, from the roots at the nearest outer places.
  double expected_place(double y) const {
    if (roots_.empty()) {
      return on_rays_ ? place_on_scale(1.0, least_scale_) : place_on_scale(middle_of(held_.range), held_.range.least);
    }
    std::vector<Root> near = roots_;
    std::stable_sort(near.begin(), near.end(),
                     [y](const Root& a, const Root& b) { return std::abs(a.y - y) < std::abs(b.y - y); });
    if (near.size() == 1 || near[0].y == near[1].y) return near[0].x;
    const double slope = (near[1].x - near[0].x) / (near[1].y - near[0].y);
    return near[0].x + std::clamp(slope * (y - near[0].y), -kDecade, kDecade);
  }

  /// The trial at the outer place y that holds its target as closely as the other target's excess asks for; nothing if
  /// the search must end, or the held target is out of reach.
  std::optional<std::size_t> hold(double y) {
    const bool at_end = y <= 0.0 || y >= outer_ceiling();  // there the outer search makes up its mind
    std::optional<std::size_t> nearest;
    double least = std::numeric_limits<double>::infinity(), place = 0.0;
    MonotoneRoot inner;
    inner.start = expected_place(y);
    inner.first_step = roots_.empty() ? kDecade : 0.1 * kDecade;
    if (on_rays_) inner.usual_slope = kResidualSlope;
    inner.ceiling = place_of_end(y, &WeightRange::ceiling);
    inner.ordinary_end = place_of_end(y, &WeightRange::most);
    inner.value = [&](double x) -> std::optional<double> {
      const std::optional<std::size_t> k = book_.at(weights_at(y, x));
      if (!k) return std::nullopt;
      const TradeOff& t = book_.trade_off(*k);
      const double held = offset_excess(held_, t, tolerance_), other = offset_excess(other_, t, tolerance_);
      if (std::abs(held) < least) {
        least = std::abs(held);
        nearest = k;
        place = x;
      }
      constexpr double kShareOfOther = 0.1;
      const bool enough = is_close(held, tolerance_) || (!at_end && std::abs(held) <= kShareOfOther * std::abs(other));
      if (enough || settled(*k)) return 0.0;
      return shows_conflict(*k) ? std::nullopt : std::optional(rising(held_, held));
    };
    const RootEnd end = find_monotone_root(inner);
    if (end == RootEnd::Stopped) return std::nullopt;
    const bool out_of_reach = end == (held_.goal.kind == GoalKind::ResidualAtMost ? RootEnd::AtZero : RootEnd::AtMost);
    if (out_of_reach) return std::nullopt;
    as_large_as_useful_ = on_rays_ && end == RootEnd::AtMost;
    roots_.push_back({y, place});
    return nearest;
  }

  /// With the weight of the held target left out, the curve of residual against the other quantity is the front of all
  /// dwell times in these two.
  void follow_front() {
    const auto at = [this](double x) {
      Weights w;
      w.*other_.weight = weight_on_scale(x, other_.range);
      return book_.at(w);
    };
    double balanced = place_on_scale(last_other_weight(), other_.range.least);
    MonotoneRoot balance;
    balance.start = balanced;
    balance.first_step = 0.5 * kDecade;
    balance.ordinary_end = place_on_scale(other_.range.most, other_.range.least);
    balance.ceiling = place_on_scale(other_.range.ceiling, other_.range.least);
    balance.value = [&](double x) -> std::optional<double> {
      const std::optional<std::size_t> k = at(x);
      if (!k) return std::nullopt;
      balanced = x;
      const TradeOff& t = book_.trade_off(*k);
      const double difference = excess_of(held_, t) - excess_of(other_, t);
      return std::abs(difference) <= tolerance_ ? 0.0 : difference;
    };
    if (find_monotone_root(balance) == RootEnd::Stopped) return;
    search_one_target(other_, {}, tolerance_, book_, weight_on_scale(balanced, other_.range));
    if (!held_end_is_known()) reach_held(balanced);
    fill_front(balanced);
  }

  /// Whether a trial on the front meets the held target about closely.
  bool held_end_is_known() const {
    constexpr double kAbout = 0.05;
    const auto& trials = book_.trials();
    return std::any_of(trials.begin(), trials.end(), [this](const auto& t) {
      const double excess = excess_of(held_, t.trade_off);
      return t.weights.*held_.weight == 0.0 && excess <= 0.0 && excess >= -kAbout;
    });
  }

  /// Looks for the end of the front where the held target is met, from the balanced place down to weights that do next
  /// to nothing: below, solves take ever longer and hardly lower the residual.
  void reach_held(double balanced) {
    const double floor = place_on_scale(other_.range.corner_least, other_.range.least);
    MonotoneRoot root;
    root.start = root.ordinary_end = root.ceiling = std::max(balanced - floor, 0.0);
    root.first_step = kDecade;
    root.usual_slope = kResidualSlope;
    root.value = [&](double x) -> std::optional<double> {
      Weights w;
      w.*other_.weight = weight_on_scale(floor + x, other_.range);
      const std::optional<std::size_t> k = book_.at(w);
      if (!k) return std::nullopt;
      const double offset = offset_excess(held_, book_.trade_off(*k), tolerance_);
      return is_close(offset, tolerance_) ? 0.0 : offset;
    };
    find_monotone_root(root);
  }

  /// Of the last trial in which it stood alone; without one, from the middle of the range.
  double last_other_weight() const {
    double weight = middle_of(other_.range);
    for (const WeightTrial& t : book_.trials()) {
      if (t.weights.*held_.weight == 0.0 && t.weights.*other_.weight > 0.0) weight = t.weights.*other_.weight;
    }
    return weight;
  }

  /// A trial between the balanced one and each end of the front.
  void fill_front(double balanced) {
    double held_end = 0.0, other_end = std::numeric_limits<double>::infinity();
    for (const WeightTrial& t : book_.trials()) {
      if (t.weights.*held_.weight != 0.0) continue;
      const double x = place_on_scale(t.weights.*other_.weight, other_.range.least);
      if (excess_of(held_, t.trade_off) <= 0.0) held_end = std::max(held_end, x);
      if (excess_of(other_, t.trade_off) <= 0.0) other_end = std::min(other_end, x);
    }
    for (const double end : {held_end, other_end}) {
      if (!std::isfinite(end)) continue;
      Weights w;
      w.*other_.weight = weight_on_scale(0.5 * (balanced + end), other_.range);
      if (!book_.at(w)) return;
    }
  }

  struct Root {
    double y, x;
  };

  bool on_rays_;  // a residual is held: both weights grow in a fixed ratio
  TargetWeight held_, other_;
  double tolerance_;
  TrialBook& book_;
  double least_scale_ = 0.0;
  std::vector<Root> roots_;          // of the inner search
  bool as_large_as_useful_ = false;  // the last inner search ended where the residual does not rise any more
  int proofs_tried_ = 0;
};

}  // namespace

void search_one_target(const TargetWeight& target, const Weights& given, double tolerance, TrialBook& book,
                       std::optional<double> start) {
  const WeightRange& range = target.range;
  const bool largest = target.goal.kind == GoalKind::ResidualAtMost;
  MonotoneRoot root;
  root.start = place_on_scale(start.value_or(middle_of(range)), range.least);
  root.first_step = kDecade;
  root.ordinary_end = place_on_scale(range.most, range.least);
  root.ceiling = largest ? root.ordinary_end : place_on_scale(range.ceiling, range.least);
  root.value = [&](double x) -> std::optional<double> {
    Weights w = given;
    w.*target.weight = x >= root.ordinary_end && largest ? range.most : weight_on_scale(x, range);
    const std::optional<std::size_t> k = book.at(w);
    if (!k) return std::nullopt;
    const double offset = offset_excess(target, book.trade_off(*k), tolerance);
    return is_close(offset, tolerance) ? 0.0 : rising(target, offset);
  };
  find_monotone_root(root);
}

bool search_two_targets(const TargetWeight& smoothness, const TargetWeight& price, double tolerance, TrialBook& book) {
  return TwoTargets(smoothness, price, tolerance, book).run();
}

}  // namespace dwell
