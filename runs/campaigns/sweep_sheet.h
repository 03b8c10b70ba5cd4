#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "runs/drawing/figure_format.h"
#include "runs/job/job.h"

namespace dwell {

/// What the reports of a sweep say of its job, as values that need no job: so that they can be made from parts.
struct SweepSheet {
  nlohmann::ordered_json map, aim, tif, tool, options, inputs;  // blocks of the JSON
  std::string tool_lines, map_lines;                            // for people; those of the map with the aim
  std::string before;                                           // the map's figures in words, form terms removed
  bool has_mean = false;                                        // so that RMS about the mean and about zero differ
  std::vector<FigureFormat> figures;                            // formats of the pictures
};

/// Without those of the options that the sweep does not use. Cost: that of tool_sheet.
SweepSheet sweep_sheet(const Job& job, const std::vector<std::string>& unused);

/// The sheet for a part, and back.
nlohmann::ordered_json sheet_json(const SweepSheet& sheet);
SweepSheet sheet_of_json(const nlohmann::ordered_json& json);

}  // namespace dwell
