#pragma once

#include <ceres/ceres.h>
#include <fmt/format.h>

#include "core/base/progress.h"

namespace dwell {

/// Lets Ceres say its iterations and ask after every one whether to stop. Ceres then ends as if it had failed, so
/// whoever runs it asks progress.check() afterwards, which throws Interrupted.
class StopCallback final : public ceres::IterationCallback {
 public:
  explicit StopCallback(const Progress& progress) : progress_(progress) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& now) override {
    progress_.report(fmt::format("iteration {}", now.iteration));
    return progress_.stop_asked() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const Progress& progress_;
};

/// Runs Ceres; throws Interrupted if `progress` asked it to stop.
inline ceres::Solver::Summary solve_with_stop(ceres::Solver::Options options, ceres::Problem& problem,
                                              const Progress& progress) {
  StopCallback stop(progress);
  options.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  progress.check();
  return summary;
}

}  // namespace dwell
