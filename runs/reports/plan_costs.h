#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "runs/job/planned_job.h"
#include "runs/reports/residual_advice.h"
#include "runs/reports/written_plan.h"

namespace dwell {

/// What a plan's weights cost, estimated on the model of the time price, and what else bears on what would help. Costs
/// are unknown where the price was given or searched over plans, or where part of the error is left on purpose.
AdviceFacts advice_facts(const PlannedJob& plan);

/// A line for people on those costs; empty where they are unknown.
std::string cost_line(const PlannedJob& plan);

/// A line for people on the blemishes that the fit left out; empty where it was not to.
std::string left_out_line(const DwellPlan& plan);

/// anatomy_block with what only a plan knows: the costs, and what its fit left out (docs/json.md, "anatomy").
nlohmann::ordered_json plan_anatomy_block(const PlannedJob& plan, const WrittenPlan& written);

}  // namespace dwell
