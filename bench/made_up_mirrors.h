#pragma once

#include <vector>

#include "bench/scenario.h"

namespace dwell::bench {

/// Appends the scenarios whose mirrors are made up here, of all sizes.
void append_made_up_mirrors(std::vector<Scenario>& all);

}  // namespace dwell::bench
