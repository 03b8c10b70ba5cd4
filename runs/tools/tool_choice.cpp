#include "runs/tools/tool_choice.h"

#include <fmt/format.h>

#include <numeric>
#include <string>
#include <utility>

namespace dwell {
namespace {

class ToolElimination {
 public:
  ToolElimination(JointProblem& problem, double max_seconds, const Progress& progress)
      : problem_(problem), max_seconds_(max_seconds), progress_(progress) {}

  ToolChoice run(ToolChoice choice) {
    choice_ = std::move(choice);
    std::vector<std::size_t> all(problem_.tools().size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    choice_.dwell = solve(all);
    while (choice_.dwell.tools.size() > 1 && goes_without_one()) {
    }
    return std::move(choice_);
  }

 private:
  std::string names(const std::vector<std::size_t>& tools) const {
    std::string text;
    for (const std::size_t k : tools) text += (text.empty() ? "" : " + ") + problem_.tools()[k].name;
    return text;
  }

  JointDwell solve(const std::vector<std::size_t>& tools) {
    JointDwell found = problem_.solve(tools, choice_.price, max_seconds_, "solve " + names(tools), progress_);
    TriedTools tried{tools, found.residual_rms, 0.0, 0.0, found.cost};
    for (std::size_t i = 0; i < tools.size(); ++i) {
      tried.seconds += found.seconds[i].sum();
      tried.change_over += problem_.tools()[tools[i]].change_over;
    }
    progress_.report(fmt::format("{}: {:.4g} nm RMS in {:.5g} s", names(tools), tried.residual_rms,
                                 tried.seconds + tried.change_over));
    choice_.tried.push_back(std::move(tried));
    choice_.applications += found.solver.operator_applications;
    choice_.seconds += found.solver.seconds;
    return found;
  }

  /// Whether a set with one tool less is as good; then that is the choice.
  bool goes_without_one() {
    const std::vector<std::size_t> now = choice_.dwell.tools;
    std::optional<JointDwell> best;
    std::size_t number = 0;
    for (const std::size_t left_out : now) {
      std::vector<std::size_t> rest = now;
      std::erase(rest, left_out);
      JointDwell found = solve(rest);
      if (best && !(found.cost < best->cost)) continue;
      best = std::move(found);
      number = choice_.tried.size() - 1;
    }
    if (!(best->cost <= (1.0 + kSameCost) * choice_.dwell.cost)) return false;
    choice_.dwell = std::move(*best);
    choice_.chosen = number;
    return true;
  }

  JointProblem& problem_;
  double max_seconds_;
  const Progress& progress_;
  ToolChoice choice_;
};

}  // namespace

ToolChoice choose_tools(JointProblem& problem, std::optional<double> price, const TimeWorth& worth, double max_seconds,
                        const Progress& progress) {
  ToolChoice choice;
  if (price) {
    choice.price = *price;
  } else {
    choice.worth = problem.find_price(worth, progress.of_part("time price"));
    choice.price = choice.worth->price;
  }
  return ToolElimination(problem, max_seconds, progress).run(std::move(choice));
}

}  // namespace dwell
