#pragma once

#include <filesystem>
#include <vector>

#include "bench/scenario.h"

namespace dwell::bench {

/// Appends the scenarios of public measured and simulated mirrors whose folders exist in `data`; its README says where
/// they come from. They are not part of the project.
void append_measured_mirrors(std::vector<Scenario>& all, const std::filesystem::path& data);

}  // namespace dwell::bench
