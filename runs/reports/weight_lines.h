#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

#include "runs/job/planned_job.h"

namespace dwell {

/// Lines for people: the weights of a plan, where they come from, and what half and twice the time price would give.
std::string weight_lines(const PlannedJob& plan);

/// How near the plan is to the optimum, a line.
std::string optimum_line(const DwellPlan& plan);

/// A sentence where the RMS about zero falls by less than a tenth, from `before` to `after`: a run that removes next to
/// nothing is never stated without one.
std::optional<std::string> little_gained(const PlannedJob& plan, const MapStatistics& before,
                                         const MapStatistics& after);

/// The same as JSON (docs/json.md, `weights`).
nlohmann::ordered_json weights_block(const PlannedJob& plan);

}  // namespace dwell
