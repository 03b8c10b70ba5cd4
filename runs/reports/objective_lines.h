#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "runs/job/planned_job.h"

namespace dwell {

/// The line of a table that says what the fit made small, beginning with "objective" and ending with a new line; empty
/// for heights alone.
std::string objective_line(const PlannedJob& plan);

/// The block "objective" of the JSON (docs/json.md), for an objective with slopes.
nlohmann::ordered_json objective_block(const PlannedJob& plan);

}  // namespace dwell
