#pragma once

#include <Eigen/Core>

#include "runs/plan/laid_path.h"
#include "runs/plan/machine_limits.h"

namespace dwell {

/// The least dwell of every stroke of a laid path within the limits: minimum_dwell, and with a machine least_dwell,
/// with what every stroke is late by logs.
Eigen::VectorXd least_dwell_of(const LaidPath& laid, const MachineLimits& limits);

}  // namespace dwell
