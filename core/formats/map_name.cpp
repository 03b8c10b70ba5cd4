#include "core/formats/map_name.h"

#include <system_error>

namespace dwell {

MapName split_map_name(const std::filesystem::path& name) {
  const std::string text = name.string();
  std::error_code unknown;  // a name that the system refuses is no file
  if (std::filesystem::exists(name, unknown)) return {name, ""};
  const std::size_t path = text.find(":/");
  if (path != std::string::npos && path > 0) return {text.substr(0, path), text.substr(path + 1)};
  // Behind other colons stands the name of an array only if what is before is a file: names may hold colons.
  for (std::size_t at = text.find(':'); at != std::string::npos; at = text.find(':', at + 1)) {
    const bool is_file = at > 0 && std::filesystem::is_regular_file(text.substr(0, at), unknown);
    if (is_file) return {text.substr(0, at), text.substr(at + 1)};
  }
  return {name, ""};
}

}  // namespace dwell
