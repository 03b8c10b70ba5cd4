#include "runs/figure/target_plan.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "core/base/duration_text.h"

namespace dwell {
namespace {

/// Makes plans of one job on one path with several prices of time.
class PricedPlans {
 public:
  PricedPlans(const Job& job, const std::vector<SurfaceLimit>& limits, const RunUncertainty& unsure,
              const Progress& progress)
      : job_(job), limits_(limits), unsure_(unsure), progress_(progress) {
    path_ = lay_job_path(job, 0.0, progress);
  }

  /// With a price, or with the job's own weights.
  TargetPlan at(std::optional<double> price) {
    const Progress here = progress_.of_part(price ? fmt::format("plan {}, time price {:.3g} nm^2/s", ++plans_, *price)
                                                  : fmt::format("plan {}", ++plans_));
    Job job = job_;
    JobPath path = path_;
    if (price) {
      job.options.time_price_nm2_per_s = {*price, GoalKind::Fixed};
      path.dwell.reset();  // of other weights
    }
    TargetPlan made;
    made.plan = plan_job(std::move(job), std::move(path), here);
    made.expected = expect_surface(made.plan, unsure_, limits_, here.of_part("expected"));
    made.reaches = made.expected.meets();
    return made;
  }

  int plans() const { return plans_; }

 private:
  const Job& job_;
  const std::vector<SurfaceLimit>& limits_;
  const RunUncertainty& unsure_;
  const Progress& progress_;
  JobPath path_;
  int plans_ = 0;
};

double price_of(const TargetPlan& plan) { return plan.plan.dwell.weights.time_price; }

/// Between a price that meets the limits and one that does not, the largest that does.
TargetPlan largest_price(PricedPlans& plans, TargetPlan meets, double fails) {
  while (fails > kPriceStep * price_of(meets)) {
    const double price = std::sqrt(price_of(meets) * fails);
    TargetPlan between = plans.at(price);
    if (between.reaches) {
      meets = std::move(between);
    } else {
      fails = price;
    }
  }
  return meets;
}

/// From a plan that meets the limits to dearer time, as far as they are met.
TargetPlan shorter(PricedPlans& plans, TargetPlan meets) {
  constexpr double kStep = 6.0;
  constexpr int kMostSteps = 6;
  for (int step = 0; step < kMostSteps; ++step) {
    const double price = kStep * price_of(meets);
    TargetPlan dearer = plans.at(price);
    if (!dearer.reaches) return largest_price(plans, std::move(meets), price);
    // A run of the least dwell gets no shorter.
    if (dearer.plan.dwell.seconds.sum() >= 0.999 * meets.plan.dwell.seconds.sum()) return meets;
    meets = std::move(dearer);
  }
  return meets;
}

std::string times_words(const TargetPlan& plan, const TargetPlan& usual) {
  return fmt::format("{} of dwell, {} with the usual price of time", duration_text(plan.plan.dwell.run_dwell()),
                     duration_text(usual.plan.dwell.run_dwell()));
}

std::string margin_words(const TargetPlan& plan) {
  if (plan.expected.changes.empty()) return "no margin, since nothing has been learnt of the tool on this part yet";
  return fmt::format("a margin of {:.3g} nm RMS: {:g} standard deviations of what has been learnt",
                     plan.expected.margin, kMarginErrors);
}

/// Whether the price of time can be steered.
bool is_steerable(const TargetPlan& usual) {
  const double price = price_of(usual);
  return price > 0.0 && std::isfinite(price);
}

}  // namespace

TargetPlan plan_for_target(const Job& job, const std::vector<SurfaceLimit>& limits, const RunUncertainty& unsure,
                           const Progress& progress) {
  PricedPlans plans(job, limits, unsure, progress);
  TargetPlan usual = plans.at(std::nullopt);
  if (limits.empty() || !is_steerable(usual)) {
    usual.plans = plans.plans();
    return usual;
  }
  TargetPlan chosen;
  if (usual.reaches) {
    chosen = shorter(plans, usual);
  } else {
    constexpr double kNextToNothing = 1e-3;  // of the usual price
    TargetPlan best = plans.at(kNextToNothing * price_of(usual));
    if (!best.reaches) {
      const bool longer = best.expected.statistics.rms_about_zero() < usual.expected.statistics.rms_about_zero();
      const TargetPlan& better = longer ? best : usual;
      usual.sentence = fmt::format(
          "not reached with this tool, path and smoothness, whatever the time: the best run leaves {} in {} of dwell "
          "({}); this plan is the one with the usual price of time",
          in_words(better.expected.statistics), duration_text(better.plan.dwell.run_dwell()), margin_words(better));
      usual.plans = plans.plans();
      return usual;
    }
    chosen = largest_price(plans, std::move(best), price_of(usual));
  }
  chosen.plans = plans.plans();
  chosen.sentence = fmt::format("the shortest run that is expected to meet the target: {}; with {}",
                                times_words(chosen, usual), margin_words(chosen));
  const Part& part = *job.part;
  if (all_pass(judge_surface(part.map, part.form, limits, part.threads, progress)))
    chosen.sentence = "the surface meets the target already, and no run is needed; " + chosen.sentence;
  return chosen;
}

}  // namespace dwell
