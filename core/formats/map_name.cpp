#include "core/formats/map_name.h"

#include <system_error>

namespace dwell {

MapName split_map_name(const std::filesystem::path& name) {
  const std::string text = name.string();
  const std::size_t at = text.find(":/");
  std::error_code unknown;  // a name that the system refuses is no file
  if (at == std::string::npos || at == 0 || std::filesystem::exists(name, unknown)) return {name, ""};
  return {text.substr(0, at), text.substr(at + 1)};
}

}  // namespace dwell
