#include "cli/result_kinds.h"

#include "runs/campaigns/joint_plan.h"
#include "runs/campaigns/part_files.h"
#include "runs/campaigns/path_comparison_output.h"
#include "runs/example/example_files.h"
#include "runs/reports/plan_files.h"

namespace dwell::cli {

std::vector<const ResultFiles*> kinds_of_results() {
  return {&plan_files(),   &path_comparison_files(), &joint_plan_files(),
          &pareto_files(), &example_files(),         &part_files()};
}

}  // namespace dwell::cli
