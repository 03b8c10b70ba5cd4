#include "solvers/problem/lower_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solvers/problem/bounded_chain.h"

namespace dwell {
namespace {

// Up to this share of the objective, what is charged is rounding.
constexpr double kLittleCharged = 1e-6;
constexpr int kMostTrials = 24;
constexpr double kFromEnds = 0.3;  // of the interval in which the best theta lies
// The search ends when no theta can give more than this share of what is between bound and objective.
constexpr double kLittleMore = 0.02;

/// What the penalty without the price asks of the surplus: 1/2 s'T s + b's + constant.
struct SurplusPenalty {
  BoundedChain chain;
  Vector linear;
  double constant = 0.0;
};

void add_smoothness(const DwellProblem& p, Vector& diagonal, Vector& off) {
  for_parts(p, [&](const DwellPart& part, Index first, Index points) {
    const double alpha = p.alpha_of(part);
    if (!(alpha > 0.0) || part.smoothness.empty()) return;
    for (Index j = 1; j < points; ++j) {
      if (!part.smoothness.linked(j)) continue;
      const double before = part.smoothness.scale(j - 1), here = part.smoothness.scale(j);
      diagonal[first + j - 1] += alpha * before * before;
      diagonal[first + j] += alpha * here * here;
      off[first + j] -= alpha * before * here;
    }
  });
}

SurplusPenalty surplus_penalty(const DwellProblem& p) {
  const Index n = p.points();
  Vector diagonal = Vector::Constant(n, p.beta), off = Vector::Zero(n), linear = Vector::Zero(n);
  add_smoothness(p, diagonal, off);
  double constant = 0.0;
  if (p.beta > 0.0) {
    linear = p.beta * p.lower;
    if (p.reference.size() != 0) linear -= p.beta * p.reference;
    constant = 0.5 * linear.squaredNorm() / p.beta;
  }
  Vector room = p.upper;
  if (room.size() != 0) room -= p.lower;
  return {BoundedChain(std::move(diagonal), std::move(off), std::move(room)), std::move(linear), constant};
}

/// The bound as a function of theta.
class ScaledDual {
 public:
  ScaledDual(const DwellProblem& problem, const Vector& t, double objective, const Vector& gradient)
      : p_(problem), penalty_(surplus_penalty(problem)), objective_(objective) {
    worth_ = gradient;
    price_.setZero(t.size());
    add_penalty_gradient(p_, t, price_);
    worth_ -= price_;  // a
    square_ = 2.0 * (objective - dwell::penalty(p_, t));
    linear_ = square_ - worth_.dot(t - problem.lower);
    prices_.setZero(t.size());
    add_prices(p_, 1.0, prices_);
    least_total_ = priced_total(p_, p_.lower);
    constant_ = p_.gamma * least_total_ + penalty_.constant;
    best_ = p_.gamma * least_total_;  // no term is below 0
  }

  /// Concave: where the slope at a theta is known, no theta beyond can give more than the tangent.
  double best() {
    double low = 0.0, high = most_theta(), low_slope = linear_, high_slope = -kInfinite;
    double theta = high;
    for (int k = 0; k < kMostTrials && high > low; ++k) {
      const Trial trial = at(theta);
      best_ = std::max(best_, trial.value);
      const bool rises = trial.proves && trial.slope >= 0.0;
      // By the tangent up to the end; and the parabola of the residual's own square, which the chain only sharpens.
      const double more = std::min((rises ? high - theta : low - theta) * trial.slope,
                                   square_ > 0.0 ? 0.5 * trial.slope * trial.slope / square_ : kInfinite);
      if (trial.proves && more <= kLittleMore * (objective_ - best_)) break;
      (rises ? low : high) = theta;
      (rises ? low_slope : high_slope) = trial.proves ? trial.slope : -kInfinite;
      // The slope falls ever faster towards 1, so that where it would vanish on a straight line is only a hint.
      theta = low + std::clamp(low_slope / (low_slope - high_slope), kFromEnds, 1.0 - kFromEnds) * (high - low);
    }
    return best_;
  }

 private:
  struct Trial {
    double value, slope;
    bool proves;  // nothing of note was charged, so that the slope is the value's
  };

  /// The largest theta in [0, 1] at which no stretch of the path that is free to move as a whole is worth more than it
  /// costs: beyond it the chain has no minimum. s_j times its scale is then the same for all its points.
  double most_theta() const {
    double most = 1.0;
    if (p_.beta > 0.0) return most;
    double costs = 0.0, worth = 0.0;
    const auto end_stretch = [&] {
      if (worth < 0.0) most = std::min(most, costs / -worth);
      costs = worth = 0.0;
    };
    const auto add = [&](Index j, double step) {
      const bool held = std::isfinite(penalty_.chain.room(j));
      costs += held ? kInfinite : p_.gamma * prices_[j] * step;
      worth += worth_[j] * step;
    };
    for (Index j = 0; j < p_.points() && p_.parts.empty(); ++j) add(j, 1.0), end_stretch();
    for_parts(p_, [&](const DwellPart& part, Index first, Index points) {
      const bool smooth = p_.alpha_of(part) > 0.0 && !part.smoothness.empty();
      for (Index j = 0; j < points; ++j) {
        if (!smooth || !part.smoothness.linked(j)) end_stretch();
        add(first + j, smooth ? 1.0 / part.smoothness.scale(j) : 1.0);
      }
      end_stretch();
    });
    return most;
  }

  Trial at(double theta) {
    price_ = penalty_.linear + theta * worth_;
    price_ += p_.gamma * prices_;
    penalty_.chain.minimise(price_, s_);
    const double value = linear_ * theta - 0.5 * square_ * theta * theta + constant_ + least();
    const double charged = charge();
    return {std::isfinite(value) ? value - charged : -kInfinite, linear_ - square_ * theta + worth_.dot(s_),
            std::isfinite(value) && charged <= kLittleCharged * objective_};
  }

  /// The least of the chain at these prices, but for charge(): its tangent at s_, over the whole box.
  double least() {
    penalty_.chain.multipliers(price_, s_, multipliers_);
    double sum = penalty_.chain.value(price_, s_);
    for (Index j = 0; j < s_.size(); ++j) {
      sum -= multipliers_[j] * s_[j];
      const double room = penalty_.chain.room(j);
      if (multipliers_[j] < 0.0 && std::isfinite(room)) sum += multipliers_[j] * room;
    }
    return sum;
  }

  /// What the multipliers of points without upper bound are below 0, each against its price, times the most priced
  /// surplus that the optimum can have.
  double charge() const {
    double lacking = 0.0;
    for (Index j = 0; j < s_.size(); ++j)
      if (!std::isfinite(penalty_.chain.room(j))) lacking = std::max(lacking, -multipliers_[j] / prices_[j]);
    if (!(lacking > 0.0)) return 0.0;
    return p_.gamma > 0.0 ? lacking * (objective_ / p_.gamma - least_total_) : kInfinite;
  }

  static constexpr double kInfinite = std::numeric_limits<double>::infinity();

  const DwellProblem& p_;
  SurplusPenalty penalty_;
  Vector worth_, price_, multipliers_, s_;
  Vector prices_;  // of a second at each point, over gamma
  double least_total_ = 0.0;
  double objective_, square_ = 0.0, linear_ = 0.0, constant_ = 0.0, best_ = 0.0;
};

}  // namespace

double lower_bound(const DwellProblem& problem, const Vector& t, double objective, const Vector& gradient) {
  return ScaledDual(problem, t, objective, gradient).best();
}

}  // namespace dwell
