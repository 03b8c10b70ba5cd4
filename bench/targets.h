#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "bench/verdict.h"

namespace dwell::bench {

/// Every aim, in fixed order, from the JSON of a run; whatever the run left out is not measured.
std::vector<TargetLine> target_lines(const nlohmann::json& all);

std::string target_table(const nlohmann::json& all);

}  // namespace dwell::bench
