#include "solvers/weights/weight_option.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"

namespace dwell {
namespace {

struct TargetWord {
  GoalKind kind;
  const char* word;      // as written
  const char* quantity;  // as shown
  const char* unit;
  double TradeOff::*value;
};
constexpr std::array<TargetWord, 3> kTargets{
    {{GoalKind::StepAtMost, "step", "step RMS", "s", &TradeOff::step_rms},
     {GoalKind::TotalAtMost, "total", "total dwell", "s", &TradeOff::total},
     {GoalKind::ResidualAtMost, "residual", "residual RMS", "nm", &TradeOff::residual_rms}}};

const TargetWord& target_of(GoalKind kind) {
  for (const TargetWord& target : kTargets) {
    if (target.kind == kind) return target;
  }
  throw std::logic_error("a weight's goal is no target");
}

/// Without `ending`, if the text ends with it.
std::string_view without_ending(std::string_view text, std::string_view ending) {
  return text.ends_with(ending) ? trim(text.substr(0, text.size() - ending.size())) : text;
}

}  // namespace

WeightGoal parse_weight_goal(const std::string& text, GoalKind target) {
  constexpr ValueRange kTargetValues{1e-12, 1e12, ""};
  const ValueRange& weights = target == GoalKind::TotalAtMost ? ranges::kTimePrice : ranges::kWeight;
  const std::string words = lower_case(trim(text));
  if (words == "auto") return {0.0, GoalKind::Auto};
  if (words == "corner") return {0.0, GoalKind::Corner};
  const std::size_t sign = words.find("<=");
  if (sign == std::string::npos) {
    const auto weight = finite_number(words);
    if (weight && weights.holds(*weight)) return {*weight, GoalKind::Fixed};
  } else {
    const std::string_view quantity = without_ending(trim(std::string_view(words).substr(0, sign)), "rms");
    const std::string_view limit = trim(std::string_view(words).substr(sign + 2));
    for (const GoalKind kind : {target, GoalKind::ResidualAtMost}) {
      const auto value = finite_number(without_ending(limit, target_of(kind).unit));
      if (quantity == target_of(kind).word && value && kTargetValues.holds(*value)) return {*value, kind};
    }
  }
  throw InputError(fmt::format(
      "'{}'; required {}, auto, corner, '{}<=S' with S > 0 in s, or 'residual<=NM' with NM > 0 in nm, each {}", text,
      weights.text(), target_of(target).word, kTargetValues.text()));
}

std::string to_string(const WeightGoal& goal) {
  if (goal.kind == GoalKind::Fixed) return fmt::format("{}", goal.value);
  if (goal.kind == GoalKind::Auto) return "auto";
  if (goal.kind == GoalKind::Corner) return "corner";
  return fmt::format("{}<={}", target_of(goal.kind).word, goal.value);
}

std::string quantity_of(GoalKind kind) { return target_of(kind).quantity; }
std::string unit_of(GoalKind kind) { return target_of(kind).unit; }
double quantity_of(GoalKind kind, const TradeOff& trade_off) { return trade_off.*target_of(kind).value; }

}  // namespace dwell
