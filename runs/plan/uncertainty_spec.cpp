#include "runs/plan/uncertainty_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {
namespace {

struct SpecUnit {
  const char* name;
  double scale;
};

/// One kind of error: its key, its units (the first is the one that it is written in), and the most that it may be.
struct SpecRow {
  const char* key;
  double UncertaintySpec::*value;
  std::array<SpecUnit, 2> units;  // a unit without a name is none
  double most;
};

constexpr double kDegreesPerMrad = 180.0 / std::numbers::pi / 1000.0;
constexpr std::array<SpecRow, 7> kRows{{
    {"tif-rate", &UncertaintySpec::tif_rate, {{{"%", 0.01}, {"", 0.0}}}, 1.0},
    {"tif-width", &UncertaintySpec::tif_width, {{{"%", 0.01}, {"", 0.0}}}, 0.5},
    {"position", &UncertaintySpec::position, {{{"mm", 1.0}, {"um", 1e-3}}}, 1e3},
    {"offset", &UncertaintySpec::offset, {{{"mm", 1.0}, {"um", 1e-3}}}, 1e3},
    {"rotation", &UncertaintySpec::rotation, {{{"deg", 1.0}, {"mrad", kDegreesPerMrad}}}, 45.0},
    {"metrology", &UncertaintySpec::metrology, {{{"nm", 1.0}, {"pm", 1e-3}}}, 1e6},
    {"drift", &UncertaintySpec::drift, {{{"%", 0.01}, {"", 0.0}}}, 1.0},
}};

std::string accepted_keys() {
  std::string keys;
  for (const SpecRow& row : kRows) {
    keys += fmt::format("{}{}=NUMBER{}", keys.empty() ? "" : ", ", row.key, row.units[0].name);
    if (*row.units[1].name) keys += fmt::format("|{}", row.units[1].name);
  }
  return keys;
}

double value_of(const SpecRow& row, std::string_view text, std::string_view part) {
  std::string units;
  for (const SpecUnit& unit : row.units) {
    if (*unit.name == '\0') continue;
    units += (units.empty() ? "" : " or ") + std::string(unit.name);
    if (!text.ends_with(unit.name)) continue;
    const auto number =
        parse_number(std::string(trim(text.substr(0, text.size() - std::string_view(unit.name).size()))));
    if (!number) continue;
    const double value = *number * unit.scale;
    if (value >= 0.0 && value <= row.most) return value;
    throw InputError(fmt::format("'{}': out of range; required from 0 to {:g} {}", part, row.most / row.units[0].scale,
                                 row.units[0].name));
  }
  throw InputError(fmt::format("'{}': required a number in {}", part, units));
}

}  // namespace

UncertaintySpec parse_uncertainty_spec(std::string_view text) {
  UncertaintySpec spec;
  std::set<std::string> given;
  for (const std::string_view raw : split(text, ',')) {
    const std::string_view part = trim(raw);
    const std::size_t equals = part.find('=');
    const std::string key(trim(part.substr(0, equals)));
    const auto row = std::find_if(kRows.begin(), kRows.end(), [&key](const SpecRow& r) { return key == r.key; });
    if (row == kRows.end() || equals == std::string_view::npos)
      throw InputError(fmt::format("'{}' in '{}'; accepted: {}", part, text, accepted_keys()));
    if (!given.insert(key).second) throw InputError(fmt::format("'{}': {} is given twice", text, key));
    spec.*(row->value) = value_of(*row, trim(part.substr(equals + 1)), part);
  }
  return spec;
}

std::string to_string(const UncertaintySpec& spec) {
  std::string text;
  for (const SpecRow& row : kRows) {
    const double value = spec.*(row.value);
    if (value == 0.0) continue;
    text += fmt::format("{}{}={}{}", text.empty() ? "" : ",", row.key, value / row.units[0].scale, row.units[0].name);
  }
  return text;
}

}  // namespace dwell
