#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "bench/verdict.h"

namespace dwell::bench {

/// The aims that whole plans decide, in fixed order, from the JSON of a run.
std::vector<TargetLine> plan_target_lines(const nlohmann::json& all);

/// A plan of the run; null if there is none of that name.
nlohmann::json find_plan(const nlohmann::json& all, const std::string& name);

}  // namespace dwell::bench
