#include "runs/figure/next_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/duration_text.h"
#include "runs/figure/expected_surface.h"
#include "runs/job/planned_job.h"
#include "runs/plan/plan_problem.h"

namespace dwell {
namespace {

/// Solves again with prices about the plan's own, on its lattice.
std::vector<NextRunPoint> curve_about(const PlannedJob& plan, const Progress& progress) {
  const Weights usual = plan.dwell.weights;
  if (!(usual.time_price > 0.0)) return {};
  const DwellOptions options = dwell_options(plan.job);
  PlanProblem problem(plan.part(), plan.laid, plan.dwell.lattice.kernel, options, progress);
  std::vector<NextRunPoint> curve;
  for (const double factor : {100.0, 10.0, 1.0, 0.1, 0.01}) {
    const Weights weights{usual.smoothness, factor * usual.time_price};
    const WeightedDwell found = problem.solve(weights, {}, options.max_seconds,
                                              fmt::format("time price {:.3g} nm^2/s", weights.time_price), progress);
    curve.push_back({found.trade_off.total, found.trade_off.residual_rms});
  }
  std::sort(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  return curve;
}

std::string advice_of(const NextRun& next, double rms_now, bool has_limits) {
  const double expected = std::hypot(next.rms, next.margin);
  const std::string run = fmt::format("a run of {} of dwell is expected to leave {:.4g} nm RMS of {:.4g}",
                                      duration_text(next.seconds), expected, rms_now);
  if (has_limits && all_pass(next.now)) return "the part is in specification: no further run is needed";
  if (has_limits && all_pass(next.expected)) return fmt::format("another run pays: {}, within the target", run);
  const bool lowers = expected < (1.0 - kWorthARun) * rms_now;
  if (!lowers) return fmt::format("another run with this tool does not pay: {}", run);
  return has_limits ? fmt::format("another run pays, and is not expected to reach the target yet: {}", run)
                    : fmt::format("another run pays: {}", run);
}

}  // namespace

NextRun look_at_next_run(const JobOptions& options, const std::vector<SurfaceLimit>& limits,
                         const RunUncertainty& unsure, const Progress& progress) {
  NextRun next;
  const PlannedJob plan = plan_job(options, progress.of_part("next run"));
  const Part& part = plan.part();
  const ExpectedSurface expected = expect_surface(plan, unsure, limits, progress.of_part("next run"));
  next.rms = expected.statistics.rms_about_zero();
  next.margin = expected.margin;
  next.seconds = plan.dwell.run_dwell();
  next.expected = expected.verdicts;
  next.now = judge_surface(part.map, part.form, limits, part.threads, progress);
  next.curve = curve_about(plan, progress.of_part("residual and time"));
  next.advice = advice_of(next, part.before.rms_about_zero(), !limits.empty());
  return next;
}

}  // namespace dwell
