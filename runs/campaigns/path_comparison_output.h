#pragma once

#include <string>

#include "runs/campaigns/path_comparison.h"

namespace dwell {

/// The files of a comparison: its own, and a folder for each plan.
const ResultFiles& path_comparison_files();

/// The text of paths.csv (docs/paths.md, "Comparing paths"): a line a path, units in the column names.
std::string path_table_text(const PathComparison& comparison);

/// The text of paths.json: the same with notes, options and inputs.
std::string path_comparison_json(const PathComparison& comparison);

/// The table for a terminal, units in its head; the notes below it.
std::string path_comparison_text(const PathComparison& comparison);

/// Writes paths.csv, paths.json, paths.png (residual and mid band against time) and psd.png (radial spectra before and
/// after) into the folder, which is not committed. Returns the text of paths.json.
std::string write_path_comparison(const PathComparison& comparison, const OutputFolder& folder);

}  // namespace dwell
