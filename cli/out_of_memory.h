#pragma once

#include <string>

namespace dwell::cli {

/// What to say where an allocation failed: at what step, and how much this process may still take.
std::string out_of_memory_message();

}  // namespace dwell::cli
