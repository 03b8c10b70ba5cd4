#include "runs/job/planned_job.h"

#include <optional>
#include <utility>

#include "core/base/errors.h"
#include "core/base/time_limit.h"
#include "runs/job/option_flags.h"

namespace dwell {

std::vector<std::string> PlannedJob::limits() const {
  std::vector<std::string> all = dwell.limits;
  all.insert(all.end(), program.limits.begin(), program.limits.end());
  for (std::string& limit : all) limit = with_option_names(limit, flag_of);
  return all;
}

namespace {

/// `used` went of the time limit before [s].
PlannedJob plan_loaded(Job job, LaidPath laid, double used, const Progress& progress) {
  DwellOptions options = dwell_options(job.options);
  options.used_seconds = used;
  PlannedJob planned;
  planned.job = std::move(job);
  if (auto file = path_input(planned.job.options)) planned.job.inputs.push_back(std::move(*file));
  planned.laid = std::move(laid);
  planned.dwell = find_dwell(planned.part(), planned.laid, options, progress);
  planned.program = make_machine_program(planned.laid, planned.dwell, options.machine, progress);
  return planned;
}

}  // namespace

PlannedJob plan_job(const JobOptions& options, const Progress& progress) {
  weights_are_searched(dwell_options(options));  // refuses what cannot be searched before any work is done
  const TimeLimit limit = time_limit(options.max_solve_s);
  std::optional<Job> job;
  LaidPath laid = limit.run(progress, [&](const Progress& limited) {
    job = load_job(options, limited);
    return lay_job_path(*job, limited);
  });
  return plan_loaded(std::move(*job), std::move(laid), limit.used(), progress);
}

PlannedJob plan_job(Job job, LaidPath laid, const Progress& progress) {
  return plan_loaded(std::move(job), std::move(laid), 0.0, progress);
}

}  // namespace dwell
