#include "runs/tools/tool_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "core/base/errors.h"

namespace dwell {
namespace {

// Solves by which a price for a total is looked for, at most; and the factor between two prices before the total lies
// between theirs.
constexpr int kMostSolves = 24;
constexpr double kPriceFactor = 8.0;

class ToolElimination {
 public:
  ToolElimination(JointProblem& problem, const WeightGoal& goal, double max_seconds, const Progress& progress)
      : problem_(problem), goal_(goal), max_seconds_(max_seconds), progress_(progress) {}

  /// `price`: of all sets, or from which the search for a total begins.
  ToolChoice run(double price, const std::optional<TimePrice>& worth) {
    price_ = price;
    choice_.worth = worth;
    std::vector<std::size_t> now(problem_.tools().size());
    std::iota(now.begin(), now.end(), std::size_t{0});
    std::optional<JointDwell> best = try_tools(now);
    if (best) choice_.dwell = *best;
    while (now.size() > 1) {
      const std::optional<JointDwell> fewer = best_without_one(now);
      if (!fewer || (best && !(cost_of(*fewer) <= (1.0 + kSameCost) * cost_of(*best)))) break;
      best = fewer;
      now = best->tools;
    }
    if (!best) refuse_total();
    choice_.dwell = std::move(*best);
    choice_.chosen = number_of(choice_.dwell.tools);
    return std::move(choice_);
  }

 private:
  bool within_total() const { return goal_.kind == GoalKind::TotalAtMost; }
  double cost_of(const JointDwell& dwell) const { return dwell.cost - (within_total() ? dwell.time_cost : 0.0); }

  std::string names(const std::vector<std::size_t>& tools) const {
    std::string text;
    for (const std::size_t k : tools) text += (text.empty() ? "" : " + ") + problem_.tools()[k].name;
    return text;
  }

  std::size_t number_of(const std::vector<std::size_t>& tools) const {
    const auto at = std::find_if(choice_.tried.begin(), choice_.tried.end(),
                                 [&tools](const TriedTools& tried) { return tried.tools == tools; });
    return static_cast<std::size_t>(at - choice_.tried.begin());
  }

  [[noreturn]] void refuse_total() const {
    throw InputError(
        fmt::format("`time price` is total<={:g} s, but no set of tools fits into it: at the fastest feed, with "
                    "change-over, the shortest takes {:.6g} s",
                    goal_.value, shortest_));
  }

  JointDwell solve(const std::vector<std::size_t>& tools, double price) {
    JointDwell found = problem_.solve(tools, price, max_seconds_, "solve " + names(tools), progress_);
    choice_.applications += found.solver.operator_applications;
    choice_.seconds += found.solver.seconds;
    progress_.report(fmt::format("{}: {:.4g} nm RMS in {:.5g} s", names(tools), found.residual_rms, found.total));
    return found;
  }

  /// The set's best dwell, which is noted; nothing if it does not fit into the total.
  std::optional<JointDwell> try_tools(const std::vector<std::size_t>& tools) {
    if (within_total()) {
      const double least = problem_.least_total(tools);
      shortest_ = std::min(shortest_, least);
      if (!(least < kMostOfTotal * goal_.value)) return std::nullopt;
    }
    JointDwell found = within_total() ? solve_within(tools) : solve(tools, price_);
    TriedTools tried{tools, found.price,    found.residual_rms,  0.0,
                     0.0,   cost_of(found), found.solver.status, found.certificate.gap()};
    for (std::size_t i = 0; i < tools.size(); ++i) {
      tried.seconds += found.seconds[i].sum();
      tried.change_over += problem_.tools()[tools[i]].change_over;
    }
    choice_.tried.push_back(std::move(tried));
    return found;
  }

  /// The set at the least price that keeps the total: the total falls as the price rises.
  JointDwell solve_within(const std::vector<std::size_t>& tools) {
    const double most = kMostOfTotal * goal_.value, lowest = 1e-9 * price_;
    std::optional<JointDwell> fits;  // at the least price known to fit
    double price = price_, too_low = 0.0, total_too_low = 0.0;
    for (int k = 0; k < kMostSolves; ++k) {
      JointDwell found = solve(tools, price);
      if (found.total <= most) {
        const bool used = found.total >= kUsedOfTotal * goal_.value || price <= lowest;
        fits = std::move(found);
        if (used) break;
      } else {
        too_low = price, total_too_low = found.total;
      }
      if (!fits) {
        price *= kPriceFactor;
      } else if (too_low == 0.0) {
        price /= kPriceFactor;
      } else {
        price = between(too_low, total_too_low, fits->price, fits->total);
      }
    }
    if (!fits) {
      throw InputError(
          fmt::format("`time price` is total<={:g} s, which the search met at no price: required more", goal_.value));
    }
    price_ = fits->price;
    return std::move(*fits);
  }

  /// A price at which the total is about in the middle of what is accepted, by logarithms, and within the two.
  double between(double low, double total_low, double high, double total_high) const {
    const double wanted = std::log(0.5 * (kMostOfTotal + kUsedOfTotal) * goal_.value);
    const double share = (std::log(total_low) - wanted) / (std::log(total_low) - std::log(total_high));
    return low * std::pow(high / low, std::clamp(share, 0.1, 0.9));
  }

  std::optional<JointDwell> best_without_one(const std::vector<std::size_t>& now) {
    std::optional<JointDwell> best;
    for (const std::size_t left_out : now) {
      std::vector<std::size_t> rest = now;
      std::erase(rest, left_out);
      std::optional<JointDwell> found = try_tools(rest);
      if (found && (!best || cost_of(*found) < cost_of(*best))) best = std::move(found);
    }
    return best;
  }

  JointProblem& problem_;
  const WeightGoal& goal_;
  double max_seconds_;
  const Progress& progress_;
  ToolChoice choice_;
  double price_ = 0.0;
  double shortest_ = INFINITY;  // of the least totals of the sets tried [s]
};

}  // namespace

ToolChoice choose_tools(JointProblem& problem, const WeightGoal& goal, const TimeWorth& worth, double max_seconds,
                        const Progress& progress) {
  std::optional<TimePrice> found;
  if (goal.kind != GoalKind::Fixed) found = problem.find_price(worth, progress);
  const double price = found ? found->price : goal.value;
  if (goal.kind == GoalKind::TotalAtMost) found.reset();
  return ToolElimination(problem, goal, max_seconds, progress).run(price, found);
}

}  // namespace dwell
