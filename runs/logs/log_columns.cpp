#include "runs/logs/log_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

enum class Quantity { Time, Length };

constexpr const char* kAcceptedTime = "s, ms, us, ns, min, h, or samples with `log period`";
constexpr const char* kAcceptedLength = "mm, um, nm, m, cm, inch";

/// Seconds in a unit of time; 0 = samples, whose period is said elsewhere.
std::optional<double> known_time_unit(std::string_view text) {
  struct Unit {
    std::string_view name;
    double seconds;
  };
  static constexpr std::array<Unit, 22> kUnits{
      {{"s", 1.0},          {"sec", 1.0},          {"second", 1.0},        {"seconds", 1.0},  {"ms", 1e-3},
       {"msec", 1e-3},      {"millisecond", 1e-3}, {"milliseconds", 1e-3}, {"us", 1e-6},      {"\xC2\xB5s", 1e-6},
       {"\xCE\xBCs", 1e-6}, {"usec", 1e-6},        {"microseconds", 1e-6}, {"ns", 1e-9},      {"nanoseconds", 1e-9},
       {"min", 60.0},       {"minutes", 60.0},     {"h", 3600.0},          {"hours", 3600.0}, {"samples", 0.0},
       {"sample", 0.0},     {"periods", 0.0}}};
  const std::string name = lower_case(trim(text));
  for (const Unit& unit : kUnits) {
    if (unit.name == name) return unit.seconds;
  }
  return std::nullopt;
}

std::optional<double> unit_factor_of(std::string_view unit, Quantity quantity) {
  if (quantity == Quantity::Time) return known_time_unit(unit);
  const auto nm = known_length_unit(unit);
  return nm ? std::optional(*nm / units::kNmPerMm) : std::nullopt;
}

/// A name of a column, taken to pieces: "Time [ms]" is "time" and "ms".
struct NameParts {
  std::string stem;  // letters and digits alone, in lower case
  std::string unit;  // empty: none
};

NameParts parts_of(std::string_view name) {
  std::string_view stem = trim(name), unit;
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}, std::pair{'<', '>'}}) {
    const std::size_t at = stem.find(open), end = stem.rfind(close);
    if (at == std::string_view::npos || at == 0 || end == std::string_view::npos || end <= at) continue;
    unit = trim(stem.substr(at + 1, end - at - 1));
    stem = stem.substr(0, at);
    break;
  }
  // "x/um", "x_um", "x um"; what stands behind '_' may as well be part of the name, as in x_actual.
  for (const char mark : {'/', '_', ' '}) {
    const std::size_t at = trim(stem).rfind(mark);
    if (!unit.empty() || at == std::string_view::npos || at == 0) continue;
    const std::string_view rest = trim(stem.substr(at + 1));
    const bool known = known_time_unit(rest) || known_length_unit(rest);
    if (mark != '/' && !known) continue;
    unit = rest;
    stem = stem.substr(0, at);
  }
  NameParts parts{"", std::string(unit)};
  for (const char c : stem) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      parts.stem += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return parts;
}

/// "t_s, x, y", for messages.
std::string listed_names(const std::vector<std::string>& names) {
  return names.empty() ? std::string("none") : fmt::format("{}", fmt::join(names, ", "));
}

/// Whether a quantity goes by this stem: 't', 'x' or 'y'.
bool is_stem_of(const std::string& stem, char axis) {
  if (axis == 't') {
    for (const char* name : {"t", "time", "timestamp", "elapsed", "elapsedtime"}) {
      if (stem == name) return true;
    }
    return false;
  }
  const std::string a(1, axis);
  for (const char* word : {"", "pos", "position", "actual", "act", "actpos", "posact", "actualposition", "feedback",
                           "fb", "posfb", "axis"}) {
    if (stem == a + word || stem == word + a) return true;
  }
  return false;
}

class Finder {
 public:
  Finder(const std::vector<std::string>& names, std::size_t count, const LogReading& reading, const std::string& where)
      : names_(names), count_(count), reading_(reading), where_(where) {}

  LogColumns find() const {
    LogColumns found;
    if (!reading_.columns.empty()) {
      found = given_columns();
    } else if (names_.empty()) {
      found = unnamed_columns();
    } else {
      found = named_columns();
    }
    if (found.x.index == found.y.index ||
        (found.time && (found.time->index == found.x.index || found.time->index == found.y.index))) {
      throw InputError(
          fmt::format("{}: one column is named for two of time, x and y; three columns are required", where_));
    }
    return found;
  }

 private:
  LogColumns given_columns() const {
    const std::vector<LogColumnName>& given = reading_.columns;
    if (given.size() == 2 && !reading_.period) {
      throw InputError(fmt::format(
          "{}: `log columns` names x and y alone; a column of time before them or `log period` is required", where_));
    }
    LogColumns found;
    std::size_t k = 0;
    if (given.size() == 3) found.time = given_column(given[k++], Quantity::Time);
    found.x = given_column(given[k], Quantity::Length);
    found.y = given_column(given[k + 1], Quantity::Length);
    return found;
  }

  LogColumn given_column(const LogColumnName& given, Quantity quantity) const {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(given.name.data(), given.name.data() + given.name.size(), number);
    const bool is_number = error == std::errc() && end == given.name.data() + given.name.size();
    std::vector<std::size_t> matches;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (trim(names_[i]) == given.name) matches.push_back(i);
    }
    for (std::size_t i = 0; matches.empty() && i < names_.size(); ++i) {
      if (!parts_of(given.name).stem.empty() && parts_of(names_[i]).stem == parts_of(given.name).stem)
        matches.push_back(i);
    }
    if (matches.empty() && is_number && number >= 1 && number <= count_) matches.push_back(number - 1);
    if (matches.size() == 1) return with_unit(matches.front(), given.unit, quantity);
    throw InputError(
        fmt::format("{}: `log columns` names \"{}\", {}; accepted: one of the names ({}), or a number from 1 to {}",
                    where_, given.name, matches.empty() ? "which is no column" : "which is the name of several columns",
                    listed_names(names_), count_));
  }

  LogColumns unnamed_columns() const {
    const std::size_t needed = reading_.period ? 2 : 3;
    if (count_ != needed) {
      throw InputError(fmt::format("{}: {} without names; {} ({}) are required, or `log columns`, as 1:s,2:mm,3:mm",
                                   where_, counted(count_, "column"), needed, reading_.period ? "x, y" : "time, x, y"));
    }
    LogColumns found;
    std::size_t k = 0;
    if (needed == 3) found.time = with_unit(k++, "", Quantity::Time);
    found.x = with_unit(k, "", Quantity::Length);
    found.y = with_unit(k + 1, "", Quantity::Length);
    return found;
  }

  LogColumns named_columns() const {
    LogColumns found;
    const auto time = column_of('t', !reading_.period);
    if (time && reading_.period) {
      throw InputError(
          fmt::format("{}: column \"{}\" holds the time, but `log period` is given as well; leave out the period, or "
                      "name x and y alone by `log columns`",
                      where_, names_[*time]));
    }
    if (time) found.time = with_unit(*time, "", Quantity::Time);
    found.x = with_unit(*column_of('x', true), "", Quantity::Length);
    found.y = with_unit(*column_of('y', true), "", Quantity::Length);
    return found;
  }

  std::optional<std::size_t> column_of(char axis, bool required) const {
    std::vector<std::size_t> matches;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (is_stem_of(parts_of(names_[i]).stem, axis)) matches.push_back(i);
    }
    if (matches.size() == 1) return matches.front();
    if (matches.empty() && !required) return std::nullopt;
    const std::string what = axis == 't' ? "the time" : std::string(1, axis);
    throw InputError(
        fmt::format("{}: {} holds {} among the columns {}; name them by `log columns`, as NAME:ms,NAME:mm,"
                    "NAME:mm{}",
                    where_, matches.empty() ? "no column clearly" : "more than one column", what, listed_names(names_),
                    axis == 't' ? ", or give `log period`" : ""));
  }

  LogColumn with_unit(std::size_t index, const std::string& given, Quantity quantity) const {
    LogColumn column;
    column.index = index;
    column.name = names_.empty() ? fmt::format("{}", index + 1) : std::string(trim(names_[index]));
    const std::string own = names_.empty() ? "" : parts_of(names_[index]).unit;
    const std::string unit = given.empty() ? own : given;
    column.from_user = !given.empty();
    column.assumed = unit.empty();
    if (column.assumed) {
      if (quantity == Quantity::Time) settle_samples(column);
      return column;
    }
    const auto factor = unit_factor_of(unit, quantity);
    if (!factor) {
      throw InputError(fmt::format("{}: column \"{}\" has the unit \"{}\"; accepted: {}", where_, column.name, unit,
                                   quantity == Quantity::Time ? kAcceptedTime : kAcceptedLength));
    }
    const auto own_factor = own.empty() ? factor : unit_factor_of(own, quantity);
    if (!given.empty() && own_factor && *own_factor != *factor) {
      throw InputError(fmt::format("{}: column \"{}\" says the unit {}, but `log columns` says {}; they must agree",
                                   where_, column.name, own, given));
    }
    column.factor = *factor;
    if (quantity == Quantity::Time) settle_samples(column);
    return column;
  }

  /// A counter of samples needs the period, and a time must not have one.
  void settle_samples(LogColumn& column) const {
    const bool counter = column.factor == 0.0;
    if (counter != reading_.period.has_value()) {
      throw InputError(fmt::format("{}: column \"{}\" {}", where_, column.name,
                                   counter ? "counts samples; `log period` is required"
                                           : "holds the time; `log period` is for a log without it, or that counts "
                                             "samples (`log columns` NAME:samples,...)"));
    }
    if (counter) column.factor = *reading_.period;
  }

  const std::vector<std::string>& names_;
  std::size_t count_;
  const LogReading& reading_;
  const std::string& where_;
};

}  // namespace

bool is_log_unit(std::string_view text) {
  text = trim(text);
  if (text.size() > 2 && (text.front() == '[' || text.front() == '(')) text = text.substr(1, text.size() - 2);
  return known_time_unit(text).has_value() || known_length_unit(text).has_value();
}

std::vector<LogColumnName> parse_log_columns(std::string_view text) {
  std::vector<LogColumnName> columns;
  for (const std::string_view part : split(text, ',')) {
    const std::size_t colon = part.rfind(':');
    const std::string_view name = trim(part.substr(0, colon));
    const std::string_view unit = colon == std::string_view::npos ? "" : trim(part.substr(colon + 1));
    if (name.empty() || (colon != std::string_view::npos && unit.empty())) columns.clear();
    if (name.empty() || (colon != std::string_view::npos && unit.empty())) break;
    columns.push_back({std::string(name), std::string(unit)});
  }
  if (columns.size() == 2 || columns.size() == 3) return columns;
  throw InputError(
      "log columns", std::string(text), "TIME[:UNIT],X[:UNIT],Y[:UNIT], or X,Y with `log period`",
      fmt::format("`log columns` = \"{}\"; accepted: TIME[:UNIT],X[:UNIT],Y[:UNIT], each a name or a number of a "
                  "column, or X,Y alone with `log period`",
                  text));
}

LogColumns find_log_columns(const std::vector<std::string>& names, std::size_t count, const LogReading& reading,
                            const std::string& where) {
  if (reading.period && !(std::isfinite(*reading.period) && *reading.period > 0.0)) {
    throw InputError("log period", fmt::format("{} s", *reading.period), "a finite number > 0");
  }
  return Finder(names, count, reading, where).find();
}

}  // namespace dwell
