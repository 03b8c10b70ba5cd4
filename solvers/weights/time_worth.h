#pragma once

#include <optional>
#include <string>

#include "solvers/weights/weight_goal.h"

namespace dwell {

/// What machine time is worth, free of scale: the two rules of which the smaller price holds. A price of zero leaves
/// the dwell problem without a determined optimum, since a constant dwell removes nothing but piston; the rules give it
/// the price that belongs to the part and the tool.
struct TimeWorth {
  /// One per cent more machine time must lower the mean square that is left by so many per cent: price = share f / T
  /// with f half the mean square residual and T the total. > 0.
  double share = 0.3;
  /// The next second must be worth this share of the average one above the least dwell: price = average (f_l - f) /
  /// (T - T_l), where the plan at its least dwell l leaves f_l and takes T_l. > 0.
  double average = 0.1;

  friend bool operator==(const TimeWorth&, const TimeWorth&) = default;
};

/// What a plan leaves and takes.
struct LeftAndTotal {
  double half_mean_square = 0.0;  // of the residual [nm^2]
  double total = 0.0;             // 1't [s]
};

/// Which rule set a price.
enum class PriceRule { Share, Average };
struct RuledPrice {
  double price = 0.0;  // [nm^2/s]
  PriceRule rule = PriceRule::Share;
};

/// The price that the rules give for a plan. Where the plan takes no more than the least dwell, or removes nothing, the
/// second rule says nothing and the first holds; 0 for a plan that takes no time at all. As the price rises, so does
/// what this gives for the plan with that price: f rises and T falls, and f is a convex function of T.
RuledPrice worth_of_time(const TimeWorth& worth, const LeftAndTotal& least, const LeftAndTotal& plan);

/// What a plan with some time price would leave, take and change from stroke to stroke: estimated on a model.
struct PricedTradeOff {
  double price = 0.0;  // [nm^2/s]
  TradeOff trade_off;
};

/// The time price that the rules of TimeWorth give a dwell problem.
struct TimePrice {
  double price = 0.0;  // [nm^2/s]; 0 if no dwell above the least removes anything
  PriceRule rule = PriceRule::Share;
  TradeOff least;       // of the least dwell, exact
  PricedTradeOff best;  // with next to no price: the least residual that the tool reaches, long as the run may be
  PricedTradeOff here;  // of the price, by the same model as the next two
  PricedTradeOff half, twice;                // of the price
  std::optional<PricedTradeOff> unsmoothed;  // as best, without smoothness; nothing where the problem has none
  int models = 0;                            // that were solved
  long applications = 0;                     // of the full operator
};

/// Reads "0.3" or "0.3,0.1": share and average, each from 1e-6 to 1e3. Throws InputError naming the text and what is
/// accepted.
TimeWorth parse_time_worth(const std::string& text);
/// The shortest text that reads back equal.
std::string to_string(const TimeWorth& worth);

}  // namespace dwell
