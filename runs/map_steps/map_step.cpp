#include "runs/map_steps/map_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"

namespace dwell {
namespace {

using Kind = MapStepArgument::Kind;

/// "PITCH MM" and the like, for messages.
std::string describe_accepted(const MapStepRecord& record) {
  if (!record.area.empty()) return fmt::format("{}:{}", record.name, record.area);
  if (record.arguments.empty()) return fmt::format("{} without arguments", record.name);
  std::string text = record.name + ":";
  for (const MapStepArgument& a : record.arguments) {
    const std::string one = a.kind == Kind::Flag    ? a.name
                            : a.kind == Kind::Files ? a.value
                                                    : fmt::format("{}={}", a.name, a.value);
    const std::string comma = &a == &record.arguments.front() ? "" : ",";
    text += a.required ? comma + one : fmt::format("[{}{}]", comma, one);
  }
  return text;
}

[[noreturn]] void refuse_text(const std::string& text, const std::string& why) {
  throw InputError(fmt::format("step '{}': {}", text, why));
}

const MapStepRecord& record_of(const std::string& text, std::string_view name,
                               const std::vector<MapStepRecord>& table) {
  std::string known;
  for (const MapStepRecord& record : table) {
    if (record.name == name) return record;
    known += (known.empty() ? "" : ", ") + record.name;
  }
  refuse_text(text, fmt::format("unknown step '{}'; accepted: {}", name, known));
}

const MapStepArgument* find(const MapStepRecord& record, std::string_view name) {
  const auto found = std::find_if(record.arguments.begin(), record.arguments.end(),
                                  [name](const MapStepArgument& a) { return a.name == name; });
  return found == record.arguments.end() ? nullptr : &*found;
}

/// The argument that a value without a key is for: a flag of that name, else the first that is not yet given.
const MapStepArgument* positional(const MapStep& step, std::string_view value) {
  const MapStepArgument* named = find(*step.record, value);
  if (named && named->kind == Kind::Flag) return named;
  for (const MapStepArgument& a : step.record->arguments) {
    if (a.kind == Kind::Files) return &a;
    if (a.kind != Kind::Flag && !step.has(a.name)) return &a;
  }
  return nullptr;
}

/// By the unit that stands for the value in help.
const ValueRange& range_of(const MapStepArgument& argument) {
  if (argument.value == "MM") return argument.name.starts_with("pi") ? ranges::kPitch : ranges::kPlace;
  if (argument.value == "NM") return ranges::kHeight;
  return ranges::kNumber;
}

void check_number(const std::string& text, const MapStepArgument& argument, const std::string& value,
                  const std::string& form) {
  const auto number = finite_number(value);
  if (!number) refuse_text(text, fmt::format("{} = '{}'; a finite number is required{}", argument.name, value, form));
  const ValueRange& range = range_of(argument);
  if (range.holds(*number)) return;
  refuse_text(text, fmt::format("{} = '{}'; {} is required{}", argument.name, value, range.text(), form));
}

void add_argument(MapStep& step, const std::string& text, std::string_view item) {
  const std::size_t equals = item.find('=');
  const bool keyed = equals != std::string_view::npos;
  const std::string_view key = trim(item.substr(0, equals));
  const std::string value(trim(keyed ? item.substr(equals + 1) : item));
  const MapStepArgument* argument = keyed ? find(*step.record, key) : positional(step, value);
  const std::string form = "; accepted: " + describe_accepted(*step.record);
  if (!argument) refuse_text(text, fmt::format("unknown argument '{}'{}", trim(item), form));
  if (value.empty()) refuse_text(text, fmt::format("{} has no value{}", argument->name, form));
  if (argument->kind != Kind::Files && step.has(argument->name)) {
    refuse_text(text, fmt::format("{} is given twice{}", argument->name, form));
  }
  if (argument->kind == Kind::Flag && keyed) {
    refuse_text(text, fmt::format("{} takes no value{}", argument->name, form));
  }
  if (argument->kind == Kind::Number) check_number(text, *argument, value, form);
  step.given.emplace_back(argument->name, argument->kind == Kind::Flag ? "" : value);
}

}  // namespace

bool MapStep::has(const std::string& name) const {
  return std::any_of(given.begin(), given.end(), [&](const auto& g) { return g.first == name; });
}

std::vector<std::string> MapStep::values(const std::string& name) const {
  std::vector<std::string> found;
  for (const auto& [key, value] : given) {
    if (key == name) found.push_back(value);
  }
  return found;
}

std::string MapStep::word(const std::string& name) const {
  const std::vector<std::string> found = values(name);
  if (!found.empty()) return found.front();
  const MapStepArgument* argument = find(*record, name);
  return argument ? argument->fallback : "";
}

std::optional<double> MapStep::optional_number(const std::string& name) const { return finite_number(word(name)); }

double MapStep::number(const std::string& name) const {
  const std::optional<double> value = optional_number(name);
  if (!value) refuse(fmt::format("{} is missing; accepted: {}", name, describe_accepted(*record)));
  return *value;
}

Index MapStep::whole(const std::string& name, Index least, Index most) const {
  const double value = number(name);
  if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most) && value == std::floor(value))) {
    refuse(fmt::format("{} = {}; a whole number from {} to {} is required", name, value, least, most));
  }
  return static_cast<Index>(value);
}

std::optional<Point> MapStep::point(const std::string& name) const {
  const std::string text = word(name);
  if (text.empty()) return std::nullopt;
  const std::vector<std::string_view> fields = split(text, '/');
  if (fields.size() == 2) {
    const auto x = finite_number(fields[0]), y = finite_number(fields[1]);
    if (x && y && ranges::kPlace.holds(*x) && ranges::kPlace.holds(*y)) return Point{*x, *y};
  }
  refuse(fmt::format("{} = '{}'; X/Y in mm is required, for instance -12.5/3, each {}", name, text,
                     ranges::kPlace.text()));
}

std::optional<Point> MapStep::pitch(const std::string& name) const {
  const std::string text = word(name);
  if (text.empty()) return std::nullopt;
  const std::vector<std::string_view> fields = split(text, '/');
  if (fields.size() <= 2) {
    const auto x = finite_number(fields.front()), y = finite_number(fields.back());
    if (x && y && ranges::kPitch.holds(*x) && ranges::kPitch.holds(*y)) return Point{*x, *y};
  }
  refuse(fmt::format("{} = '{}'; required {}, or two of them, X/Y, for pixels that are not square", name, text,
                     ranges::kPitch.text()));
}

void MapStep::refuse(const std::string& why) const { refuse_text(to_string(*this, false), why); }

MapStep parse_map_step(const std::string& text, const std::vector<MapStepRecord>& table) {
  if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; })) {
    throw InputError("step: a control character (line end, tab, ...) in it; one line of text is required");
  }
  const std::size_t colon = text.find(':');
  const std::string_view view = text;
  MapStep step{&record_of(text, trim(view.substr(0, colon)), table), "", {}};
  const std::string_view rest = colon == std::string::npos ? "" : trim(view.substr(colon + 1));
  if (!step.record->area.empty()) {
    step.area = rest;
    if (rest.empty()) refuse_text(text, "an area is missing; accepted: " + describe_accepted(*step.record));
    return step;
  }
  if (!rest.empty()) {
    for (const std::string_view item : split(rest, ',')) add_argument(step, text, item);
  }
  for (const MapStepArgument& a : step.record->arguments) {
    if (a.required && !step.has(a.name)) {
      refuse_text(text, fmt::format("{} is missing; accepted: {}", a.name, describe_accepted(*step.record)));
    }
  }
  return step;
}

std::string to_string(const MapStep& step, bool all) {
  std::string arguments = step.area;
  for (const MapStepArgument& a : step.record->arguments) {
    std::vector<std::string> values = step.values(a.name);
    if (values.empty() && all && !a.fallback.empty() && a.kind != Kind::Flag) values.push_back(a.fallback);
    for (const std::string& value : values) {
      arguments += arguments.empty() ? "" : ",";
      if (a.kind == Kind::Files) {
        arguments += value;
      } else {
        arguments += a.kind == Kind::Flag ? a.name : fmt::format("{}={}", a.name, value);
      }
    }
  }
  return arguments.empty() ? step.record->name : fmt::format("{}:{}", step.record->name, arguments);
}

}  // namespace dwell
