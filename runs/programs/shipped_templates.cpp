#include "runs/programs/shipped_templates.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/base/errors.h"
#include "core/base/whole_file.h"

namespace dwell {

const std::vector<std::pair<std::string, std::string>>& shipped_templates() {
  static const std::vector<std::pair<std::string, std::string>> kTemplates{
#include <dwell_shipped_templates.inc>
  };
  return kTemplates;
}

std::string shipped_template_names() {
  std::string names;
  for (const auto& [name, text] : shipped_templates()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

bool is_shipped_template(const std::string& name) {
  const auto& all = shipped_templates();
  return std::any_of(all.begin(), all.end(), [&name](const auto& one) { return one.first == name; });
}

std::string program_template_text(const std::string& name_or_file) {
  for (const auto& [name, text] : shipped_templates()) {
    if (name == name_or_file) return text;
  }
  std::error_code none;
  if (!std::filesystem::exists(name_or_file, none)) {
    throw InputError(
        fmt::format("{}: there is no such template; required a file, or the name of one that comes with "
                    "dwell: {}",
                    name_or_file, shipped_template_names()));
  }
  return read_whole_file(name_or_file);
}

ProgramTemplate find_program_template(const std::string& name_or_file) {
  return parse_program_template(program_template_text(name_or_file), name_or_file);
}

}  // namespace dwell
