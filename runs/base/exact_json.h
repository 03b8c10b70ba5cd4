#pragma once

#include <nlohmann/json.hpp>

#include <concepts>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/errors.h"

namespace dwell {

/// Values as JSON that come back the same to the bit, for files that this program reads itself. A struct is described
/// once, for both ways, by a function beside it:
///
///   template <class Visit>
///   void each_field(Spread& spread, const Visit& visit) { visit("mean", spread.mean), visit("points", spread.points);
///   }
///
/// Reading throws nlohmann's exceptions, or InputError, where a key is missing or of another kind.

/// A number as JSON, also where it is not finite, which JSON has no number for: "nan", "inf", "-inf".
nlohmann::ordered_json exact_number_json(double value);
double exact_number(const nlohmann::ordered_json& json);

template <class Value>
nlohmann::ordered_json exact_json(Value value);
template <class Value>
void read_exact(const nlohmann::ordered_json& json, Value& value);

/// std::optional, by what it can do.
template <class Value>
concept MayBeMissing = requires(Value value) {
  value.has_value();
  value.reset();
};

/// std::vector and std::array.
template <class Value>
concept HasElements = !std::is_same_v<Value, std::string> && requires(Value value) {
  value.size();
  value.data();
};

/// By value: each_field takes what may be read into.
template <class Value>
nlohmann::ordered_json exact_json(Value value) {
  if constexpr (std::is_same_v<Value, double>) {
    return exact_number_json(value);
  } else if constexpr (std::is_enum_v<Value>) {
    return static_cast<int>(value);
  } else if constexpr (std::integral<Value> || std::is_same_v<Value, std::string>) {
    return value;
  } else if constexpr (MayBeMissing<Value>) {
    return value ? exact_json(*value) : nlohmann::ordered_json(nullptr);
  } else if constexpr (HasElements<Value>) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& element : value) list.push_back(exact_json(element));
    return list;
  } else {
    nlohmann::ordered_json fields = nlohmann::ordered_json::object();
    each_field(value, [&fields](const char* key, const auto& field) { fields[key] = exact_json(field); });
    return fields;
  }
}

template <class Value>
void read_exact(const nlohmann::ordered_json& json, Value& value) {
  if constexpr (std::is_same_v<Value, double>) {
    value = exact_number(json);
  } else if constexpr (std::is_enum_v<Value>) {
    value = static_cast<Value>(json.get<int>());
  } else if constexpr (std::integral<Value> || std::is_same_v<Value, std::string>) {
    json.get_to(value);
  } else if constexpr (MayBeMissing<Value>) {
    value.reset();
    if (!json.is_null()) read_exact(json, value.emplace());
  } else if constexpr (HasElements<Value>) {
    if constexpr (requires { value.clear(); }) value.resize(json.size());
    if (!json.is_array() || json.size() != value.size()) throw InputError("a list of another length is required");
    for (std::size_t k = 0; k < value.size(); ++k) read_exact(json.at(k), value[k]);
  } else {
    each_field(value, [&json](const char* key, auto& field) { read_exact(json.at(key), field); });
  }
}

}  // namespace dwell
