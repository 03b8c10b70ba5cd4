#include "runs/job/tool_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"

namespace dwell {
namespace {

void check_name(const std::string& name) {
  const bool usable = !name.empty() && name.size() <= 40 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
  if (usable) return;
  throw InputError(
      fmt::format("'{}': a tool begins with its name; required up to 40 letters, digits, '-' or '_', as in "
                  "'large;tif=spot.csv;path=raster:pitch=2'",
                  name));
}

double price_of(const std::string& text) {
  constexpr ValueRange kPrices{1e-3, 1e3, ""};
  const auto value = parse_number(text);
  if (value && kPrices.holds(*value)) return *value;
  throw InputError(fmt::format("'{}'; required {} (of a second with it, over the common price)", text, kPrices.text()));
}

double duration_of(const std::string& text) {
  constexpr ValueRange kSeconds{0.0, 1e7, "s"};
  constexpr std::array<std::pair<std::string_view, double>, 3> kUnits{{{"min", 60.0}, {"s", 1.0}, {"h", 3600.0}}};
  for (const auto& [unit, factor] : kUnits) {
    if (!text.ends_with(unit)) continue;
    const auto value = parse_number(std::string_view(text).substr(0, text.size() - unit.size()));
    if (value && kSeconds.holds(*value * factor)) return *value * factor;
  }
  throw InputError(
      fmt::format("'{}'; required a time with its unit, at most {} s: 90s, 10min or 0.5h", text, kSeconds.most));
}

void set_part(ToolSpec& tool, const std::string& key, const std::string& value) {
  if (value.empty()) throw InputError("empty; required a value");
  if (key == "price") {
    tool.price = price_of(value);
  } else if (key == "change-over") {
    tool.change_over_s = duration_of(value);
  } else {
    tool.values.emplace_back(key, value);
  }
}

ToolSpec parse_tool(const std::string& line) {
  ToolSpec tool;
  std::vector<std::string> seen;
  for (const std::string_view part : split(line, ';')) {
    const std::string text(trim(part));
    if (text.empty() && !tool.name.empty()) continue;  // a semicolon at the end
    if (tool.name.empty()) {
      check_name(text);
      tool.name = text;
      continue;
    }
    const std::size_t equals = text.find('=');
    const std::string key(trim(text.substr(0, equals)));
    const std::string value(equals == std::string::npos ? "" : trim(text.substr(equals + 1)));
    if (std::find(seen.begin(), seen.end(), key) != seen.end())
      throw InputError(fmt::format("tool '{}': {} is given twice", tool.name, key));
    seen.push_back(key);
    try {
      set_part(tool, key, value);
    } catch (const InputError& error) {
      throw InputError(fmt::format("tool '{}': {}: {}", tool.name, key, error.what()));
    }
  }
  return tool;
}

}  // namespace

std::vector<ToolSpec> parse_tool_specs(const std::string& text) {
  std::vector<ToolSpec> tools;
  for (const std::string_view line : split(text, '\n')) {
    ToolSpec tool = parse_tool(std::string(trim(line)));
    const bool twice =
        std::any_of(tools.begin(), tools.end(), [&tool](const ToolSpec& t) { return t.name == tool.name; });
    if (twice)
      throw InputError(fmt::format("tool '{}' is given twice; required a name of its own for each", tool.name));
    tools.push_back(std::move(tool));
  }
  if (tools.size() < 2 || tools.size() > kMostTools) {
    throw InputError(
        fmt::format("{} given; required 2 to {} (one tool is --tif and --path)", tools.size(), kMostTools));
  }
  return tools;
}

std::string to_string(const ToolSpec& tool) {
  std::string text = tool.name;
  for (const auto& [key, value] : tool.values) text += fmt::format(";{}={}", key, value);
  if (tool.price != 1.0) text += fmt::format(";price={}", tool.price);
  if (tool.change_over_s != 0.0) text += fmt::format(";change-over={}s", tool.change_over_s);
  return text;
}

}  // namespace dwell
