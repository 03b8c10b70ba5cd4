#pragma once

#include <string>

#include "runs/job/job_options.h"
#include "runs/job/tool_spec.h"

namespace dwell {

/// A job's options with those of one of its tools in their place, and without its tools. Throws InputError naming tool,
/// option and what is accepted, for an option that a tool cannot have of its own and for a value that it refuses.
JobOptions options_of_tool(JobOptions options, const ToolSpec& tool);

/// The option that a tool has of its own by this flag. Throws InputError naming the tool and those that are accepted.
const JobOptionRecord& option_of_tool(const ToolSpec& tool, const std::string& flag);

/// Refuses the tools of a job where there can be only one, of `what`: "dwell pareto".
void refuse_tools(const JobOptions& options, const std::string& what);

}  // namespace dwell
