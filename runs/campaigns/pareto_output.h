#pragma once

#include <string>

#include "runs/base/output_folder.h"
#include "runs/campaigns/pareto.h"

namespace dwell {

/// The text of pareto.csv (docs/formats.md): a row a solve.
std::string pareto_table_text(const ParetoSweep& sweep);
/// The text of pareto.json: the table, with version, options and the hashes of the inputs.
std::string pareto_json_text(const ParetoSweep& sweep);

/// Writes pareto.csv, pareto.png and pareto.json into `folder` without committing it; returns the text of the JSON.
std::string write_pareto(const ParetoSweep& sweep, const OutputFolder& folder);

}  // namespace dwell
