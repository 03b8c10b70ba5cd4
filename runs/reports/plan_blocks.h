#pragma once

#include "runs/base/json_blocks.h"
#include "runs/job/job.h"
#include "runs/plan/dwell_plan.h"

namespace dwell {

/// The blocks "map", "tif" and "path" for the JSON of a plan, of a sweep of weights and of a comparison of paths.
nlohmann::ordered_json plan_map_block(const Job& job);
nlohmann::ordered_json plan_tif_block(const Job& job);
nlohmann::ordered_json plan_path_block(const LaidPath& laid);

/// The figures of the plan's dwell times, for its block "dwell".
DwellFigures plan_dwell_figures(const DwellPlan& plan);

}  // namespace dwell
