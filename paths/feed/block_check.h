#pragma once

#include <optional>
#include <string>

#include "core/motion/program.h"
#include "paths/feed/machine.h"

namespace dwell {

/// A sentence about the steps at work that a machine runs in less time than its controller's block rate allows, with
/// how many and the first (1-based); nothing if there are none. A step lasts as long as the machine takes for it
/// (step_times). Throws InputError as step_times. Cost O(steps).
std::optional<std::string> short_blocks(const Program& program, const Machine& machine);

}  // namespace dwell
