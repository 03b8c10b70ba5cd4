#include "cli/sweep_reports.h"

#include <fmt/format.h>

#include "cli/progress_line.h"
#include "cli/terminal.h"
#include "runs/campaigns/path_comparison_output.h"

namespace dwell::cli {

int report_paths(const PathComparison& comparison, OutputFolder& folder, const std::string& out,
                 const JsonOption& json) {
  const std::string text = write_path_comparison(comparison, folder);
  folder.commit();
  finish_progress();
  json.deliver(text, path_comparison_text(comparison) + fmt::format("written   {}, a plan a folder\n", out));
  return say_limits(comparison.limits);
}

}  // namespace dwell::cli
