#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "runs/job/resumed_run.h"

namespace dwell {

/// Lines of what a stopped program had done.
std::string resume_lines(const ResumedRun& run);

/// The block "resume" of the JSON (docs/json.md).
nlohmann::ordered_json resume_block(const ResumedRun& run);

}  // namespace dwell
