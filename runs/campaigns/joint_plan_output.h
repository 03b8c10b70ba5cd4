#pragma once

#include <string>

#include "runs/base/output_folder.h"
#include "runs/campaigns/joint_plan.h"

namespace dwell {

/// The text for people: which tools pay, and what each does.
std::string joint_plan_text(const JointPlan& plan);

/// Writes tools.json (docs/json.md) into `folder` without committing it; returns its text.
std::string write_joint_plan(const JointPlan& plan, const OutputFolder& folder);

}  // namespace dwell
