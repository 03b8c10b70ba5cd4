#include "runs/job/tool_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/base/errors.h"

namespace dwell {
namespace {

constexpr std::array<std::string_view, 7> kOwnFlags{"path",      "motion",     "machine", "max-feed",
                                                    "min-dwell", "smoothness", "rounds"};

/// What a tool may say of itself: all about its removal function but for steps, whose semicolons stand between parts
/// here, and how it is moved.
bool is_own_option(const JobOptionRecord& record) {
  if (record.flag == "tif-steps") return false;
  return record.flag.starts_with("tif") ||
         std::find(kOwnFlags.begin(), kOwnFlags.end(), record.flag) != kOwnFlags.end();
}

std::string own_words() {
  std::string words;
  for (const JobOptionRecord& record : job_option_table()) {
    if (is_own_option(record)) words += record.flag + ", ";
  }
  return words + "price, change-over";
}

}  // namespace

const JobOptionRecord& option_of_tool(const ToolSpec& tool, const std::string& flag) {
  for (const JobOptionRecord& record : job_option_table()) {
    if (record.flag == flag && is_own_option(record)) return record;
  }
  throw InputError(fmt::format("tool '{}': {}: not a tool's own; accepted: {}", tool.name, flag, own_words()));
}

JobOptions options_of_tool(JobOptions options, const ToolSpec& tool) {
  options.tools.clear();
  for (const auto& [flag, value] : tool.values)
    set_job_option(options, option_of_tool(tool, flag), value, fmt::format("tool '{}': {}", tool.name, flag));
  return options;
}

void refuse_tools(const JobOptions& options, const std::string& what) {
  if (options.tools.empty()) return;
  throw InputError(fmt::format("tool: {} is for one tool; several are planned by dwell plan", what));
}

}  // namespace dwell
