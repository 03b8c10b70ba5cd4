#include "runs/plan/weight_choice.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/base/counted.h"
#include "core/base/time_limit.h"
#include "runs/plan/weight_verdict.h"
#include "solvers/weights/weight_search.h"

namespace dwell {
namespace {

/// Of the dwells found so far, the one whose weights are nearest on logarithmic scales.
class NearestDwell {
 public:
  explicit NearestDwell(const WeightRange& smoothness, const WeightRange& price)
      : least_smoothness_(smoothness.least), least_price_(price.least) {}

  const Vector& start_for(const Weights& w, const std::vector<WeightedDwell>& found) const {
    static const Vector kNone;
    const Vector* nearest = &kNone;
    double least = std::numeric_limits<double>::infinity();
    for (const WeightedDwell& f : found) {
      const double d =
          std::hypot(place(w.smoothness, least_smoothness_) - place(f.weights.smoothness, least_smoothness_),
                     place(w.time_price, least_price_) - place(f.weights.time_price, least_price_));
      if (d < least) {
        least = d;
        nearest = &f.dwell;
      }
    }
    return *nearest;
  }

 private:
  static double place(double weight, double least) { return std::log1p(weight / least); }
  double least_smoothness_, least_price_;
};

}  // namespace

WeightedDwell choose_weights(PlanProblem& problem, const DwellOptions& options, double max_seconds,
                             const Progress& progress, WeightTrials& search) {
  WeightSearchOptions how;
  how.smoothness = options.smoothness;
  how.time_price = options.time_price;
  how.time_price_range = time_price_range(problem.highest_price());
  const NearestDwell nearest(how.smoothness_range, how.time_price_range);

  std::vector<WeightedDwell> found;
  SolverSummary sum;
  const TimeLimit limit(max_seconds, "max solve");  // by the clock: there is work between solves as well
  bool out_of_time = false;
  const auto evaluate = [&](const Weights& weights) -> std::optional<TradeOff> {
    out_of_time = !found.empty() && !(limit.left() > 0.0);
    if (out_of_time) return std::nullopt;
    const std::string stage = fmt::format("search {}: smoothness {:.4g}, time price {:.4g} nm^2/s", found.size() + 1,
                                          weights.smoothness, weights.time_price);
    found.push_back(problem.solve(weights, nearest.start_for(weights, found),
                                  found.empty() ? max_seconds : limit.left(), stage, progress));
    const WeightedDwell& f = found.back();
    progress.report(fmt::format("{}: residual {:.4g} nm RMS, dwell {:.5g} s, step {:.4g} s RMS", stage,
                                f.trade_off.residual_rms, f.trade_off.total, f.trade_off.step_rms));
    const long applications = f.solver.operator_applications + 1;
    search.trials.push_back({weights, f.trade_off, f.solver.objective, applications});
    sum.iterations += f.solver.iterations;
    sum.operator_applications += applications;
    sum.coarse_pairs += f.solver.coarse_pairs;
    sum.seconds += f.solver.seconds;
    return f.trade_off;
  };
  const WeightSearchResult result = search_weights(how, evaluate);
  search.chosen = result.chosen;
  search.front = result.front;
  search.criterion = search_criterion(how);
  if (out_of_time) {
    search.limits.push_back(fmt::format("the search of the weights ended after {}; `max solve` is {} s",
                                        counted(found.size(), "solve"), options.max_seconds));
  }
  judge_search(how, result.end, search);

  WeightedDwell chosen = std::move(found[search.chosen]);
  chosen.solver.iterations = sum.iterations;
  chosen.solver.operator_applications = sum.operator_applications;
  chosen.solver.coarse_pairs = sum.coarse_pairs;
  chosen.solver.seconds = sum.seconds;
  return chosen;
}

}  // namespace dwell
