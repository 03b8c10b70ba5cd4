#include "runs/job/planned_job.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/errors.h"
#include "core/base/time_limit.h"
#include "paths/feed/exported_motion.h"
#include "runs/job/option_flags.h"
#include "runs/job/program_style.h"
#include "runs/machine/machine_option.h"
#include "runs/plan/leave_out.h"
#include "runs/plan/rounded_motion.h"
#include "runs/programs/program_formats.h"

namespace dwell {

std::vector<std::string> PlannedJob::limits() const {
  std::vector<std::string> all = dwell.limits;
  all.insert(all.end(), program.limits.begin(), program.limits.end());
  for (std::string& limit : all) limit = with_option_names(limit, flag_of);
  return all;
}

void check_exports(const JobOptions& options) {
  const std::string word = export_that_needs_motion(options.exports);
  if (options.schedule != ScheduleKind::Constant && (word.empty() || options.machine.empty())) {
    throw InputError(
        fmt::format("`schedule` = {}: feeds cannot say speeds between nodes, and no acceleration is known without a "
                    "machine; required a `machine` file and an `export`: {}",
                    to_string(options.schedule), export_words()));
  }
  if (word.empty()) return;
  if (options.machine.empty()) {
    throw InputError(fmt::format(
        "`export` = {}: such a program is the motion of a machine; required a `machine` file (dwell machine --example "
        "prints one)",
        word));
  }
  if (!program_frame(options).is_of_part()) {
    throw InputError(fmt::format(
        "`export` = {}: with `zero`, `rotate` or `swap axes`: places in such a program are those of the part; required "
        "one of the two",
        word));
  }
  check_exported_motion(machine_for_program(machine_of_option(options.machine).machine, options), options.schedule);
}

namespace {

/// `used` went of the time limit before [s].
PlannedJob plan_loaded(Job job, JobPath path, double used, const Progress& progress) {
  PlannedJob planned;
  planned.job = std::move(job);
  if (auto file = path_input(planned.job.options)) planned.job.inputs.push_back(std::move(*file));
  planned.laid = std::move(path.laid);
  DwellOptions options = dwell_options(planned.job);
  const TimeLimit limit = time_limit(options.max_seconds, used);
  options.used_seconds = used;
  planned.blocks = merge_blocks(planned.part(), planned.laid, options, progress);
  if (planned.job.machine) {
    planned.job.lesson = learn_from_log(planned.job.options, planned.part(), planned.laid, *planned.job.machine,
                                        *options.machine.machine, planned.job.inputs, progress);
  }
  options = dwell_options(planned.job);
  options.used_seconds = planned.blocks || planned.job.lesson ? limit.used() : used;
  // A dwell that was found with the path knows nothing of merged blocks and of the log.
  const bool found = path.dwell && !planned.job.lesson && !(planned.blocks && planned.blocks->short_before > 0);
  planned.dwell = found ? std::move(*path.dwell) : find_dwell(planned.part(), planned.laid, options, progress);
  if (planned.job.options.blemishes == BlemishHandling::LeaveOut) {
    options.used_seconds += planned.dwell.solver.seconds;
    planned.dwell = leave_out_blemishes(planned.part(), planned.laid, std::move(planned.dwell), options, progress);
  }
  if (planned.blocks) planned.blocks->bounded = strokes_bounded_by_blocks(planned.laid, planned.dwell, options.machine);
  planned.program = make_machine_program(planned.laid, planned.dwell, options.machine, progress);
  if (planned.dwell.motion && planned.dwell.motion->program) {
    planned.program.motion = planned.dwell.motion->program;
  } else if (!export_that_needs_motion(planned.job.options.exports).empty() && planned.dwell.motion) {
    planned.program.motion = motion_to_be_rounded(*options.machine.machine, [&](double acceleration_share) {
      return exported_motion(planned.program.table.path, planned.laid.motion, *options.machine.machine,
                             options.machine.feed_limits().max_feed, planned.dwell.motion->seconds, progress,
                             acceleration_share);
    });
  }
  return planned;
}

}  // namespace

PlannedJob plan_job(const JobOptions& options, const Progress& progress) {
  check_weights(dwell_options(options));
  check_exports(options);
  check_log_options(options);
  const TimeLimit limit = time_limit(options.max_solve_s);
  Job job = limit.run(progress, [&](const Progress& limited) { return load_job(options, limited); });
  JobPath path = lay_job_path(job, limit.used(), progress);
  return plan_loaded(std::move(job), std::move(path), limit.used(), progress);
}

PlannedJob plan_job(Job job, JobPath path, const Progress& progress) {
  return plan_loaded(std::move(job), std::move(path), 0.0, progress);
}

}  // namespace dwell
