#pragma once

#include <fmt/format.h>

#include <concepts>
#include <string>
#include <string_view>

namespace dwell {

/// How many of what, for messages and tables: "1 pixel", "2 pixels", "0 pixels". `several` is the plural, where that is
/// not the word with an s.
template <std::integral Count>
std::string counted(Count count, std::string_view one, std::string_view several = {}) {
  if (count == Count{1}) return fmt::format("1 {}", one);
  return several.empty() ? fmt::format("{} {}s", count, one) : fmt::format("{} {}", count, several);
}

}  // namespace dwell
