#pragma once

#include <string>

#include "cli/json_option.h"
#include "runs/base/output_folder.h"
#include "runs/campaigns/pareto.h"
#include "runs/campaigns/path_comparison.h"

namespace dwell::cli {

/// Writes the report of a whole sweep into its folder, puts that in place and prints: one way for sweeps done at once
/// and for those put together from parts. Gives back the exit code.
int report_pareto(const ParetoSweep& sweep, OutputFolder& folder, const std::string& out, const JsonOption& json);
int report_paths(const PathComparison& comparison, OutputFolder& folder, const std::string& out,
                 const JsonOption& json);

}  // namespace dwell::cli
