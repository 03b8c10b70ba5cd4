#include "runs/job/job_options.h"
#include "runs/job/tool_spec.h"

namespace dwell {

std::vector<JobOptionRecord> tool_option_records() {
  return {{"tool",
           "tool",
           "NAME;KEY=VALUE;...",
           "one of several tools that work the surface together, each with a path and a program of its own (given once "
           "for each): tif=, path=, machine=, tif-pixel=, max-feed= ... in the place of the options of these names, "
           "price= of a second over the common one, change-over=TIME to mount it",
           false,
           false,
           [](JobOptions& o, const std::string& t) { parse_tool_specs(t), o.tools = t; },
           [](const JobOptions& o) { return o.tools; },
           false,
           false,
           {},
           true}};
}

}  // namespace dwell
