#include "solvers/problem/lower_bound.h"

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

/// The bound as a function of theta: concave, as it is the least of concave functions.
class ScaledDual {
 public:
  ScaledDual(const DwellProblem& problem, const Vector& t, double objective, const Vector& gradient)
      : p_(problem), gradient_(gradient), square_(2.0 * (objective - problem.gamma * t.sum())) {
    double moved = 0.0;  // s'M'(M s + q)
    for (Index j = 0; j < t.size(); ++j) {
      const double worth = gradient_[j] - p_.gamma;
      moved += (t[j] - p_.lower[j]) * worth;
      bounded_ = bounded_ || std::isfinite(p_.upper_at(j));
      if (!std::isfinite(p_.upper_at(j)) && worth < 0.0) most_ = std::min(most_, p_.gamma / -worth);
    }
    linear_ = square_ - moved;
    constant_ = p_.gamma * p_.lower.sum();
  }

  double operator()(double theta) const {
    double value = theta * linear_ - 0.5 * theta * theta * square_ + constant_;
    for (Index j = 0; bounded_ && j < p_.points(); ++j) {
      const double worth = theta * (gradient_[j] - p_.gamma) + p_.gamma;
      if (worth < 0.0 && std::isfinite(p_.upper_at(j))) value += worth * (p_.upper[j] - p_.lower[j]);
    }
    return value;
  }

  double best() const {
    if (!bounded_) return (*this)(square_ > 0.0 ? std::clamp(linear_ / square_, 0.0, most_) : 0.0);
    constexpr int kSteps = 60;  // of a search by thirds: to 1e-10 of the interval
    double low = 0.0, high = most_;
    for (int k = 0; k < kSteps; ++k) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      ((*this)(a) < (*this)(b) ? low : high) = (*this)(a) < (*this)(b) ? a : b;
    }
    return std::max((*this)(0.5 * (low + high)), (*this)(most_));
  }

 private:
  const DwellProblem& p_;
  const Vector& gradient_;
  double square_, linear_ = 0.0, constant_ = 0.0;
  double most_ = 1.0;
  bool bounded_ = false;
};

}  // namespace

double lower_bound(const DwellProblem& problem, const Vector& t, double objective, const Vector& gradient) {
  return ScaledDual(problem, t, objective, gradient).best();
}

}  // namespace dwell
