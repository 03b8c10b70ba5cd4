#include "cli/result_folder.h"

#include "runs/campaigns/path_comparison_output.h"
#include "runs/example/example_files.h"
#include "runs/reports/plan_files.h"

namespace dwell::cli {

OutputFolder result_folder(const std::string& out, const ResultFiles& files) {
  refuse_inside_result(out, files, {&plan_files(), &path_comparison_files(), &pareto_files(), &example_files()});
  return {out, files};
}

}  // namespace dwell::cli
