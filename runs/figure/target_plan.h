#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "runs/figure/expected_surface.h"
#include "runs/job/planned_job.h"

namespace dwell {

/// A plan that steers by limits of the surface.
struct TargetPlan {
  PlannedJob plan;
  ExpectedSurface expected;
  bool reaches = false;  // the plan is expected to meet the limits
  int plans = 0;         // that were made
  std::string sentence;  // what was chosen, and why
};

/// The shortest run that is expected to meet the limits with the margin of expect_surface: the largest price of machine
/// time, to kPriceStep, whose plan does. Where no price does, the plan with the usual price, and the sentence says the
/// best that the tool can do. Without limits, the plan with the options' own weights. Throws as plan_job. Cost: some
/// eight plans, and expect_surface of each.
TargetPlan plan_for_target(const Job& job, const std::vector<SurfaceLimit>& limits, const RunUncertainty& unsure,
                           const Progress& progress = {});

/// The price is found to this factor.
inline constexpr double kPriceStep = 1.25;

}  // namespace dwell
