#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "runs/map_steps/map_step.h"

namespace dwell {

/// Every step that prepares a map (docs/maps.md).
const std::vector<MapStepRecord>& map_step_table();

/// Steps separated by semicolons, as --map-steps and the job file have them. Throws InputError.
std::vector<MapStep> parse_map_steps(const std::string& text);

/// The steps with other names for their files: what `name` makes of each. Throws InputError.
std::string renamed_map_steps(const std::string& text, const std::function<std::string(const std::string&)>& name);

/// The files of other maps that the steps read, as given. Throws InputError.
std::vector<std::string> map_step_files(const std::string& text);

/// Does the steps in order; each appends one line to the map's history: its arguments in force and what it did. Throws
/// InputError that begins with the step; Interrupted.
void apply_map_steps(HeightMap& map, const std::vector<MapStep>& steps, MapStepContext& context);

/// What `dwell map --steps` prints: every step with arguments, units, defaults and an example.
std::string map_steps_help();

/// The same as a Markdown table, as docs/maps.md has it.
std::string map_steps_markdown();

}  // namespace dwell
