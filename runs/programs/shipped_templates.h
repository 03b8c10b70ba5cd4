#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runs/programs/program_template.h"

namespace dwell {

/// The templates that come with dwell (data/templates), by name: their texts.
const std::vector<std::pair<std::string, std::string>>& shipped_templates();
/// Their names: "aerotech-a3200, fanuc, ...".
std::string shipped_template_names();
bool is_shipped_template(const std::string& name);

/// The text of a template: of a shipped one by its name, else of a file. Throws InputError naming the file and the
/// shipped names if there is neither.
std::string program_template_text(const std::string& name_or_file);

/// The same, read. Throws InputError as parse_program_template.
ProgramTemplate find_program_template(const std::string& name_or_file);

}  // namespace dwell
