#pragma once

#include <filesystem>
#include <vector>

#include "bench/scenario.h"

namespace dwell::bench {

/// All scenarios, in the order of the report. Those of measured mirrors only if `data` has them.
std::vector<Scenario> scenarios(const std::filesystem::path& data);

}  // namespace dwell::bench
