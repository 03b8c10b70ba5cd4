#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/removal/exact_residual.h"
#include "runs/acceptance/surface_limits.h"

namespace dwell {

/// Judges what a program leaves; of no limits, nothing. RMS (about zero) and PV are those of the exact statistics,
/// which are shown; all else is of the surface. The surface has its form terms removed already. Throws Interrupted.
/// Cost judge_surface.
std::vector<SurfaceVerdict> judge_residual(const ExactResidual& left, const std::vector<SurfaceLimit>& limits,
                                           int threads, const Progress& progress);

/// A sentence for each limit that is not met.
std::vector<std::string> unmet_limits(const std::vector<SurfaceVerdict>& verdicts);

/// The block "acceptance" of the JSON (docs/json.md).
nlohmann::ordered_json acceptance_block(const std::vector<SurfaceVerdict>& verdicts);

}  // namespace dwell
