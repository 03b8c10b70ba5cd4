#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

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

/// Where a weight is searched: targets in [0, most], on a scale that is logarithmic above `least`; corners in
/// [corner_least, corner_most]. 0 < least <= corner_least < corner_most <= most.
struct WeightRange {
  double least = 0.0, most = 0.0;
  double corner_least = 0.0, corner_most = 0.0;
};

/// From next to no smoothing to a feed that hardly changes; the corner is sought among weights at which an ordinary
/// part still gains.
inline constexpr WeightRange kSmoothnessRange{1e-5, 100.0, 1e-3, 10.0};
/// `highest` [nm^2/s]: the price from which on no dwell above the least pays.
WeightRange time_price_range(double highest);

struct WeightSearchOptions {
  WeightGoal smoothness, time_price;  // at least one not Fixed
  WeightRange smoothness_range = kSmoothnessRange, time_price_range;
  /// A target is met closely enough if the quantity is below it by at most this share: the noise of the solver.
  double tolerance = 5e-3;
  int evaluations_a_weight = 20;
};

struct WeightTrial {
  Weights weights;
  TradeOff trade_off;
};

struct WeightSearchResult {
  std::vector<WeightTrial> trials;  // in the order evaluated; never empty
  std::size_t chosen = 0;
  bool met = true;  // the chosen trial meets every target
};

/// Solves the dwell problem with these weights; nothing = end the search (not before the first trial). May throw.
using WeightEvaluator = std::function<std::optional<TradeOff>(const Weights&)>;

/// Chooses the weights (docs/math.md, "Choosing the weights"). With x the place of a weight in its range, from 0 to 1,
/// minimises over the free weights the sum of
///
///   Corner                  log r / (change of log r) + log q / (change of log q)   over the corner range,
///   StepAtMost, TotalAtMost x,
///   ResidualAtMost          -x
///
/// subject to all targets, where r is the residual RMS and q the step RMS (smoothness) or the total (time price). The
/// corner so defined is the point of the L-curve farthest from the chord between its ends, in log-log, whatever the
/// scales of the axes (Satopaa et al. 2011; the minimum of r^mu q of Reginska 1996 with the chord's slope for mu).
/// Curvature (Hansen and O'Leary 1993) would need second derivatives of what the solver leaves noisy by half a per
/// cent. Changes of less than 1 % count as 1 %: a curve without trade-off gives the end that costs nothing.
///
/// A coarse scan finds the neighbourhood of corners; NLopt does the rest. The answer is one of the trials: among those
/// that meet every target the one of lowest sum, or, if none does, the one that misses by the smallest factor.
/// Deterministic; at most evaluations_a_weight evaluations a free weight. Throws std::invalid_argument if no weight is
/// free, a range is not as above, or a trade-off is not finite and >= 0.
WeightSearchResult search_weights(const WeightSearchOptions& options, const WeightEvaluator& evaluate);

}  // namespace dwell
