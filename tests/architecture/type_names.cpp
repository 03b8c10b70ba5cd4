#include "tests/architecture/type_names.h"

#include <fmt/format.h>

#include <map>
#include <regex>
#include <sstream>

namespace dwell::architecture {

std::vector<Violation> check_type_names(const std::vector<SourceFile>& files) {
  // clang-format indents what is inside a class, but not what is inside a namespace.
  static const std::regex kDefinition(R"(^(?:template <.*> )?(?:enum class|enum|struct|class) (\w+)[^;(]*\{.*)");
  std::map<std::string, std::string> owners;
  std::vector<Violation> violations;
  for (const SourceFile& file : files) {
    if (!file.path.ends_with(".h")) continue;
    std::istringstream stream(file.text);
    std::string line;
    for (std::size_t number = 1; std::getline(stream, line); ++number) {
      std::smatch name;
      if (!std::regex_match(line, name, kDefinition)) continue;
      const auto [owner, is_new] = owners.emplace(name[1], file.path);
      if (is_new) continue;
      violations.push_back(
          {file.path, number, fmt::format("{} defines a type named {}, too", owner->second, name[1].str())});
    }
  }
  return violations;
}

}  // namespace dwell::architecture
