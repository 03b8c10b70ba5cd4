#pragma once

#include <string>

#include "solvers/weights/weight_search.h"

namespace dwell {

/// The quantities that a target of each weight may bound, besides the residual that both may.
inline constexpr GoalKind kSmoothnessTarget = GoalKind::StepAtMost;
inline constexpr GoalKind kTimePriceTarget = GoalKind::TotalAtMost;

/// Reads a number >= 0, "auto", "corner", or a target: "step<=0.004", "total<=425" (in s) or "residual<=0.15" (in nm),
/// of which `target` or the residual is accepted. Blanks, case, the word RMS and the unit are free: "step RMS <= 0.004
/// s". Throws InputError naming the text and what is accepted.
WeightGoal parse_weight_goal(const std::string& text, GoalKind target);

/// The shortest text that reads back equal.
std::string to_string(const WeightGoal& goal);

/// "step RMS", "total", "residual RMS": what a target bounds; and its unit.
std::string quantity_of(GoalKind kind);
std::string unit_of(GoalKind kind);
/// The quantity that a target bounds.
double quantity_of(GoalKind kind, const TradeOff& trade_off);

}  // namespace dwell
