#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "runs/figure/store/run_folder.h"

namespace dwell {

/// A step of a run as the JSON of a command has it (docs/json.md): its place, what it says of itself, its files, and
/// the limits that were reached.
nlohmann::ordered_json step_json(const std::string& command, const RunFolder& run, const RunStep& step,
                                 const std::vector<std::string>& limits = {});

}  // namespace dwell
