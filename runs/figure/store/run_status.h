#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "runs/figure/store/run_folder.h"

namespace dwell {

/// The table of a run, from what its steps say of themselves: a row for each plan and each measurement, those that were
/// withdrawn too, with RMS before, as predicted and as measured, convergence, machine time, bands, what was learnt, and
/// what to do next. Throws InputError for a step that this version cannot read. Cost O(steps); no map is read.
std::string status_text(const RunFolder& run);

/// The same as JSON (docs/json.md).
nlohmann::ordered_json status_json(const RunFolder& run);

}  // namespace dwell
