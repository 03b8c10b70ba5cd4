#include "core/base/spec_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"

namespace dwell {
namespace {

[[noreturn]] void fail(const SpecText& spec, const std::string& why) {
  throw InputError(fmt::format("{} \"{}\": {}", spec.field, spec.text, why));
}

[[noreturn]] void fail_missing(const SpecText& spec, std::string_view key) {
  fail(spec, fmt::format("{} is missing; {}:{}=NUMBER is required", key, spec.kind, key));
}

/// A number of any size, not NaN; nothing if the key is not given.
std::optional<double> any_number(const SpecText& spec, std::string_view key) {
  const std::optional<std::string> value = spec.word(key);
  if (!value) return std::nullopt;
  const std::optional<double> number = parse_number(*value);
  if (!number || std::isnan(*number)) fail(spec, fmt::format("{} = \"{}\"; a number is required", key, *value));
  return number;
}

void add_entry(SpecText& spec, std::string_view item) {
  const std::size_t equals = item.find('=');
  const std::string_view key = trim(item.substr(0, equals));
  if (equals == std::string_view::npos || key.empty()) {
    fail(spec, fmt::format("\"{}\" is not of the form key=value", item));
  }
  const std::string_view value = trim(item.substr(equals + 1));
  if (value.empty()) fail(spec, fmt::format("{} has no value", key));
  if (spec.has(key)) fail(spec, fmt::format("{} is given twice", key));
  spec.entries.emplace_back(key, value);
}

}  // namespace

std::pair<std::string, std::string> split_kind(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return {text, ""};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

SpecText parse_spec_text(const std::string& text, const std::string& field) {
  const auto [kind, rest] = split_kind(text);
  SpecText spec{field, text, std::string(trim(kind)), {}};
  if (spec.kind.empty()) fail(spec, "required: kind:key=value,...");
  if (trim(rest).empty()) return spec;
  std::string_view items = rest;
  while (true) {
    const std::size_t comma = items.find(',');
    add_entry(spec, items.substr(0, comma));
    if (comma == std::string_view::npos) return spec;
    items.remove_prefix(comma + 1);
  }
}

bool SpecText::has(std::string_view key) const { return word(key).has_value(); }

std::optional<std::string> SpecText::word(std::string_view key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [key](const auto& e) { return e.first == key; });
  if (found == entries.end()) return std::nullopt;
  return found->second;
}

std::optional<double> SpecText::optional_number(std::string_view key) const {
  const std::optional<double> number = any_number(*this, key);
  // The range of the key is narrower; who reads it knows it.
  if (number && std::isfinite(*number) && !ranges::kNumber.holds(*number)) {
    reject(key, ranges::kNumber.text() + " at the most, within the range of the key");
  }
  return number;
}

double SpecText::number(std::string_view key) const {
  const std::optional<double> value = optional_number(key);
  if (!value) fail_missing(*this, key);
  return *value;
}

double SpecText::number(std::string_view key, const ValueRange& range) const {
  const std::optional<double> value = any_number(*this, key);
  if (!value) fail_missing(*this, key);
  if (!range.holds(*value)) reject(key, range.text());
  return *value;
}

double SpecText::number(std::string_view key, double fallback) const { return optional_number(key).value_or(fallback); }

std::optional<Point> SpecText::optional_point(std::string_view key) const {
  const std::optional<std::string> value = word(key);
  if (!value) return std::nullopt;
  const std::size_t slash = value->find('/');
  if (slash != std::string::npos) {
    const std::optional<double> x = parse_number(value->substr(0, slash));
    const std::optional<double> y = parse_number(value->substr(slash + 1));
    const auto far = [](double v) { return std::isfinite(v) && !ranges::kPlace.holds(v); };
    if (x && y && (far(*x) || far(*y))) reject(key, "each " + ranges::kPlace.text());
    if (x && y) return Point{*x, *y};
  }
  reject(key, fmt::format("X/Y in mm, for instance {}=-10/2.5", key));
}

std::string SpecText::choice(std::string_view key, std::initializer_list<std::string_view> accepted) const {
  std::string value = word(key).value_or(std::string(*accepted.begin()));
  if (std::find(accepted.begin(), accepted.end(), value) == accepted.end()) {
    fail(*this, fmt::format("{} = \"{}\"; accepted: {}", key, value, fmt::join(accepted, ", ")));
  }
  return value;
}

void SpecText::reject(std::string_view key, std::string_view required) const {
  fail(*this, fmt::format("{} = \"{}\"; required {}", key, word(key).value_or(""), required));
}

void SpecText::accept_only(std::initializer_list<std::string_view> keys) const {
  accept_only(std::vector<std::string>(keys.begin(), keys.end()));
}

void SpecText::accept_only(const std::vector<std::string>& keys) const {
  for (const auto& [key, value] : entries) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      fail(*this, fmt::format("unknown key \"{}\"; accepted for {}: {}", key, kind, fmt::join(keys, ", ")));
    }
  }
}

}  // namespace dwell
