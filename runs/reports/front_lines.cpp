#include "runs/reports/front_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "solvers/weights/weight_option.h"

namespace dwell {
namespace {

constexpr std::size_t kMostLines = 7;

/// Which places of the front are shown: both ends, the nearest ones to equal ratios of the residual or total between,
/// and the chosen one.
std::set<std::size_t> places_shown(const WeightTrials& search, const WeightGoal& price) {
  std::vector<double> heights;
  for (const std::size_t k : search.front) heights.push_back(target_excess(price, search.trials[k].trade_off));
  std::set<std::size_t> places;
  constexpr std::size_t kSpread = kMostLines - 1;
  for (std::size_t k = 0; k < kSpread; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(kSpread - 1);
    const double wanted = heights.front() + share * (heights.back() - heights.front());
    const auto nearest = std::min_element(heights.begin(), heights.end(), [wanted](double a, double b) {
      return std::abs(a - wanted) < std::abs(b - wanted);
    });
    places.insert(static_cast<std::size_t>(nearest - heights.begin()));
  }
  const auto chosen = std::find(search.front.begin(), search.front.end(), search.chosen);
  if (chosen != search.front.end()) places.insert(static_cast<std::size_t>(chosen - search.front.begin()));
  return places;
}

std::string figure(const WeightGoal& goal, const TradeOff& t) {
  return fmt::format("{} {:.4g} {}", quantity_of(goal.kind), quantity_of(goal.kind, t), unit_of(goal.kind));
}

}  // namespace

std::string front_lines(const WeightTrials& search, const WeightGoal& smoothness, const WeightGoal& price) {
  std::string text;
  if (search.front.empty()) return text;
  for (const std::size_t place : places_shown(search, price)) {
    const TriedWeights& t = search.trials[search.front[place]];
    text += fmt::format("{:<9} {}, {} (smoothness {:.4g}, time price {:.4g} nm^2/s){}\n", text.empty() ? "front" : "",
                        figure(smoothness, t.trade_off), figure(price, t.trade_off), t.weights.smoothness,
                        t.weights.time_price, search.front[place] == search.chosen ? ", this plan" : "");
  }
  return text;
}

}  // namespace dwell
