#pragma once

#include <vector>

#include "runs/base/output_folder.h"

namespace dwell::cli {

/// Every kind of result that a command puts into a folder of its own.
std::vector<const ResultFiles*> kinds_of_results();

}  // namespace dwell::cli
