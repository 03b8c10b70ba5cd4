#pragma once

#include <string>

#include "runs/job/planned_job.h"
#include "runs/reports/written_plan.h"

namespace dwell {

/// The text of summary.json (docs/formats.md, "summary.json"): stable keys, units in their names.
std::string plan_summary_text(const PlannedJob& plan, const WrittenPlan& written);

}  // namespace dwell
