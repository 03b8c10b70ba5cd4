#pragma once

#include "runs/base/json_blocks.h"
#include "runs/plan/plan.h"

namespace dwell {

/// The blocks "map", "tif" and "path" of whatever is told of a plan: by a plan, a sweep of weights, or a comparison of
/// paths.
nlohmann::ordered_json plan_map_block(const Plan& plan);
nlohmann::ordered_json plan_tif_block(const Plan& plan);
nlohmann::ordered_json plan_path_block(const Plan& plan);

/// The figures of the plan's dwell times, for its block "dwell".
DwellFigures plan_dwell_figures(const Plan& plan);

}  // namespace dwell
