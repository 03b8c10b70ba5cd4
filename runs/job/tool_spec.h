#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace dwell {

/// One of several tools that work a surface together, as a user writes it:
/// "NAME;tif=spot.csv;path=raster:pitch=1;machine=m.toml;price=2;change-over=10min".
struct ToolSpec {
  std::string name;            // letters, digits, '-' and '_'
  double price = 1.0;          // of a second with it, over the common price
  double change_over_s = 0.0;  // machine time that mounting it takes
  /// Options that are its own, in the place of the job's: their flags and their text.
  std::vector<std::pair<std::string, std::string>> values;
};

/// Tools, one a line. Whether a tool can have the options that it names is not looked at (options_of_tool). Throws
/// InputError naming tool, part and what is accepted: fewer than two or more than kMostTools, a name that is missing,
/// no name or given twice, a part without a value or given twice, a price or a time that is none.
std::vector<ToolSpec> parse_tool_specs(const std::string& text);
inline constexpr std::size_t kMostTools = 6;

/// Text that reads back equal, a line.
std::string to_string(const ToolSpec& tool);

}  // namespace dwell
