#pragma once

namespace dwell {

/// The two weights of the dwell problem that trade residual against smooth feed and against machine time
/// (docs/math.md): alpha = smoothness |b|^2, gamma = time_price m.
struct Weights {
  double smoothness = 0.0;  // dimensionless
  double time_price = 0.0;  // [nm^2/s]

  friend bool operator==(const Weights&, const Weights&) = default;
};

/// The quantities that the weights trade against each other, of the dwell found with some weights.
struct TradeOff {
  double residual_rms = 0.0;  // |W P (A t - z)| / sqrt(m) [nm]
  double total = 0.0;         // 1't [s]
  double step_rms = 0.0;      // |D t| / sqrt(number of links) [s]
};

/// How a weight is chosen.
enum class GoalKind {
  Fixed,           // it is `value`
  Auto,            // it belongs to tool, path and part: usual_smoothness, find_time_price
  Corner,          // the corner of the L-curve
  StepAtMost,      // the least weight with step RMS <= value [s]
  TotalAtMost,     // the least weight with total dwell <= value [s]
  ResidualAtMost,  // the largest weight with residual RMS <= value [nm]
};
struct WeightGoal {
  double value = 0.0;
  GoalKind kind = GoalKind::Fixed;

  friend bool operator==(const WeightGoal&, const WeightGoal&) = default;
};

/// Whether the goal bounds a quantity.
bool is_target(const WeightGoal& goal);

/// Natural logarithm of how far the quantity of a target is exceeded, in which one per cent is 0.01; <= 0 = met. A
/// quantity of zero counts as 1e-12. Minus infinity where the goal is no target.
double target_excess(const WeightGoal& goal, const TradeOff& trade_off);

/// Where a weight is searched: targets in [0, most], on a scale that is logarithmic above `least`; a step or a total
/// that is not met there in [0, ceiling]; corners in [corner_least, corner_most].
/// 0 < least <= corner_least < corner_most <= most <= ceiling.
struct WeightRange {
  double least = 0.0, most = 0.0;
  double corner_least = 0.0, corner_most = 0.0;
  double ceiling = 0.0;
};

/// From next to no smoothing to a feed that hardly changes; the corner is sought among weights at which an ordinary
/// part still gains. The ceiling is the largest that a job may name.
inline constexpr WeightRange kSmoothnessRange{1e-5, 100.0, 1e-3, 10.0, 1e9};
/// `highest` [nm^2/s]: the price from which on no dwell above the least pays, smoothness left out.
WeightRange time_price_range(double highest);

/// Throws std::invalid_argument unless the range is as above.
void require_ordered(const WeightRange& range);

}  // namespace dwell
