#pragma once

#include <string>

#include "runs/plan/plan_output.h"

namespace dwell {

/// The text of summary.json (docs/formats.md, "summary.json"): stable keys, units in their names.
std::string plan_summary_text(const Plan& plan, const WrittenPlan& written);

}  // namespace dwell
