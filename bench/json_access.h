#pragma once

#include <nlohmann/json.hpp>

#include <limits>
#include <string>

namespace dwell::bench {

inline std::string text_of(const nlohmann::json& j, const char* key) { return j.at(key).get<std::string>(); }

/// NaN for null: JSON has no NaN, and one that was written is read back as null.
inline double number(const nlohmann::json& j, const char* key) {
  const nlohmann::json& value = j.at(key);
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

/// The array of that name; an empty one if there is none.
inline nlohmann::json list_of(const nlohmann::json& j, const char* key) {
  const auto found = j.find(key);
  return found == j.end() || found->is_null() ? nlohmann::json::array() : *found;
}

}  // namespace dwell::bench
