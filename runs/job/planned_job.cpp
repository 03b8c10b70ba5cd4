#include "runs/job/planned_job.h"

#include <utility>

#include "core/base/errors.h"
#include "runs/job/option_flags.h"

namespace dwell {

std::vector<std::string> PlannedJob::limits() const {
  std::vector<std::string> all = dwell.limits;
  all.insert(all.end(), program.limits.begin(), program.limits.end());
  for (std::string& limit : all) limit = with_option_names(limit, flag_of);
  return all;
}

PlannedJob plan_job(const JobOptions& options, const Progress& progress) {
  weights_are_searched(dwell_options(options));  // refuses what cannot be searched before any work is done
  Job job = load_job(options, progress);
  LaidPath laid = lay_job_path(job, progress);
  return plan_job(std::move(job), std::move(laid), progress);
}

PlannedJob plan_job(Job job, LaidPath laid, const Progress& progress) {
  const DwellOptions options = dwell_options(job.options);
  PlannedJob planned;
  planned.job = std::move(job);
  if (auto file = path_input(planned.job.options)) planned.job.inputs.push_back(std::move(*file));
  planned.laid = std::move(laid);
  planned.dwell = find_dwell(planned.part(), planned.laid, options, progress);
  planned.program = make_machine_program(planned.laid, planned.dwell, options.machine, progress);
  return planned;
}

}  // namespace dwell
