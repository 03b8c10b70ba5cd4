#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "runs/job/job_options.h"

namespace dwell {

/// One of several tools that work a surface together, as a user writes it:
/// "NAME;tif=spot.csv;path=raster:pitch=1;machine=m.toml;price=2;change-over=10min".
struct ToolOption {
  std::string name;            // letters, digits, '-' and '_'
  double price = 1.0;          // of a second with it, over the common price
  double change_over_s = 0.0;  // machine time that mounting it takes
  /// Options that are its own, in the place of the job's: what they are, and their text.
  std::vector<std::pair<const JobOptionRecord*, std::string>> values;
};

/// Tools, one a line. Throws InputError naming tool, part and what is accepted: fewer than two or more than
/// kMostTools, a name that is missing, no name or given twice, a part that a tool cannot have, a value that its option
/// refuses.
std::vector<ToolOption> parse_tool_options(const std::string& text);
inline constexpr std::size_t kMostTools = 6;

/// The same with other names for their files: what `name` makes of each.
std::string renamed_tool_options(const std::string& text, const std::function<std::string(const std::string&)>& name);

/// A job's options with those of one of its tools, and without its tools.
JobOptions options_of_tool(JobOptions options, const ToolOption& tool);

/// The part about tools.
std::vector<JobOptionRecord> tool_option_records();

/// Refuses the tools of a job where there can be only one, of `what`: "dwell pareto".
void refuse_tools(const JobOptions& options, const std::string& what);

}  // namespace dwell
