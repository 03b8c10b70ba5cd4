#pragma once

#include <functional>
#include <optional>

namespace dwell {

/// A rising function of x >= 0, each value costly and slightly noisy; x is the logarithm of something.
struct MonotoneRoot {
  double start = 0.0;
  double first_step = 1.0;
  double usual_slope = 0.0;   // > 0: the first step is what this slope asks for
  double ordinary_end = 0.0;  // reached before x goes beyond it, by steps of at most 5
  double ceiling = 0.0;       // x goes no farther; >= ordinary_end
  double narrow = 0.02;       // a root that is known so closely is found
  double flat = 5e-4;         // beyond the ordinary end, a slope below this one is none
  /// The value at x; exactly 0 = this is close enough to the root; nothing = end.
  std::function<std::optional<double>(double x)> value;
};

enum class RootEnd {
  Found,
  AtZero,   // the function is positive even at 0
  AtMost,   // it is negative even at the ceiling, or has stopped rising
  Stopped,  // `value` said so
};

/// Looks for the root: outward from the start with growing steps, guided by the secant, until it is bracketed, then by
/// regula falsi (the Illinois variant, with bisection where that creeps). What was found out stands in the calls of
/// `value`: under noise only points that were evaluated can be trusted. Deterministic.
RootEnd find_monotone_root(const MonotoneRoot& problem);

}  // namespace dwell
