#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "core/form/map_statistics.h"
#include "runs/acceptance/surface_limits.h"
#include "runs/figure/next_run.h"
#include "runs/figure/removal_comparison.h"
#include "runs/figure/tool_lesson.h"
#include "runs/job/job_options.h"

namespace dwell {

/// What the steps of a run say of themselves (docs/figure.md), as JSON with units in the keys.

nlohmann::ordered_json statistics_record(const MapStatistics& statistics);
MapStatistics statistics_of_record(const nlohmann::ordered_json& record);

nlohmann::ordered_json verdict_records(const std::vector<SurfaceVerdict>& verdicts);

nlohmann::ordered_json lesson_record(const ToolLesson& lesson);
ToolLesson lesson_of_record(const nlohmann::ordered_json& record);

nlohmann::ordered_json comparison_record(const RemovalComparison& comparison);

nlohmann::ordered_json next_run_record(const NextRun& next);

/// The options whose keys `holds` accepts, as text by key; those that are not given are left out.
nlohmann::ordered_json option_records(const JobOptions& options, const std::function<bool(const std::string&)>& holds);
/// Sets options from such records. `source` begins messages. Throws InputError for a key that is not known.
void set_options_of_records(JobOptions& options, const nlohmann::ordered_json& records, const std::string& source);

}  // namespace dwell
