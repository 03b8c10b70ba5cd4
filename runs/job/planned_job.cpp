#include "runs/job/planned_job.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/errors.h"
#include "core/base/time_limit.h"
#include "paths/feed/exported_motion.h"
#include "runs/job/option_flags.h"
#include "runs/job/program_style.h"
#include "runs/machine/machine_option.h"
#include "runs/plan/kept_dwell.h"
#include "runs/plan/leave_out.h"
#include "runs/plan/rounded_motion.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/shipped_templates.h"

namespace dwell {

std::vector<std::string> PlannedJob::limits() const {
  std::vector<std::string> all = dwell.limits;
  all.insert(all.end(), program.limits.begin(), program.limits.end());
  for (std::string& limit : all) limit = with_option_names(limit, flag_of);
  return all;
}

namespace {

/// The option by which a plan has a program of the scheduled motion: "`export` = pmac"; empty without one.
/// Throws InputError for a template of feeds with a schedule of speeds.
std::string option_that_needs_motion(const JobOptions& options) {
  const std::string word = export_that_needs_motion(options.exports);
  if (!options.program_template.empty()) {
    std::string option = fmt::format("`template` = {}", options.program_template);
    const bool speeds = find_program_template(options.program_template).speeds;
    if (!speeds && options.schedule != ScheduleKind::Constant) {
      throw InputError(
          fmt::format("{}: its moves say feeds, which cannot say the speeds of `schedule` = {}; required "
                      "constant, or a template with speeds = true",
                      option, to_string(options.schedule)));
    }
    if (speeds && word.empty()) return option;
  }
  return word.empty() ? "" : fmt::format("`export` = {}", word);
}

/// Programs of feeds at the ends of blocks say constant acceleration, in mm, and hold no lines of plain G-code. Throws
/// InputError naming both options.
void check_end_feeds(const JobOptions& options) {
  const std::string word = export_of_end_feeds(options.exports);
  if (word.empty()) return;
  const std::string option = fmt::format("`export` = {}", word);
  if (options.schedule == ScheduleKind::Pvt) {
    throw InputError(
        fmt::format("`schedule` = pvt: rounds corners on cubics, which the feeds of {} cannot say; accepted: linear, "
                    "constant",
                    option));
  }
  if (has_export_over_path(options.exports) && options.schedule == ScheduleKind::Constant) {
    throw InputError(
        "`schedule` = constant: with one feed a stroke `export` = flin would say less than plain G-code, whose feeds "
        "are run at all of the machine's acceleration; required linear, or `template` = siemens-840d");
  }
  if (options.inches) {
    throw InputError(fmt::format("`units` = inch: programs of {} are in mm; required mm, or another export", option));
  }
  for (const auto& [name, file] : {std::pair("header", options.header), std::pair("footer", options.footer)}) {
    if (file.empty()) continue;
    throw InputError(
        fmt::format("`{}`: its lines are plain G-code, and programs of {} hold none; required one of the two options",
                    name, option));
  }
}

/// Whether a program of positions, velocities and times is written, whose places are those of the part.
bool has_export_without_frame(const JobOptions& options) {
  const bool by_template = !options.program_template.empty() && find_program_template(options.program_template).speeds;
  return by_template || !export_without_frame(options.exports).empty();
}

/// What a controller that runs feeds linear over the path must not limit: its blocks are others than the plan's.
void check_over_path(const JobOptions& options, const Machine& machine) {
  if (!has_export_over_path(options.exports)) return;
  if (!machine.controller.is_coarse() && !std::isfinite(machine.controller.max_blocks_per_s)) return;
  throw InputError(
      "`export` = flin: the `machine` has [controller] limits (max_blocks_per_s, time_resolution_s or "
      "position_resolution_mm), which its blocks are not made for; required a machine without, or another export");
}

}  // namespace

void check_exports(const JobOptions& options) {
  const std::string option = option_that_needs_motion(options);
  if (options.schedule != ScheduleKind::Constant && (option.empty() || options.machine.empty())) {
    throw InputError(
        fmt::format("`schedule` = {}: feeds cannot say speeds between nodes, and no acceleration is known without a "
                    "machine; required a `machine` file and an `export`: {}; or a `template` with speeds = true",
                    to_string(options.schedule), export_words()));
  }
  if (option.empty()) return;
  if (options.machine.empty()) {
    throw InputError(
        fmt::format("{}: such a program is the motion of a machine; required a `machine` file (dwell machine --example "
                    "prints one)",
                    option));
  }
  check_end_feeds(options);
  if (!program_frame(options).is_of_part() && has_export_without_frame(options)) {
    throw InputError(fmt::format(
        "{}: with `zero`, `rotate` or `swap axes`: places in such a program are those of the part; required "
        "one of the two",
        option));
  }
  const Machine machine = machine_for_program(machine_of_option(options.machine).machine, options);
  check_exported_motion(machine, options.schedule);
  check_over_path(options, machine);
}

namespace {

/// The program of a plan that has its dwell, and the motion that its exports say.
void make_program(PlannedJob& planned, const DwellOptions& options, const Progress& progress) {
  planned.program = make_machine_program(planned.laid, planned.dwell, options.machine, progress);
  if (planned.dwell.motion && planned.dwell.motion->program) {
    planned.program.motion = planned.dwell.motion->program;
  } else if (!option_that_needs_motion(planned.job.options).empty() && planned.dwell.motion) {
    planned.program.motion = motion_to_be_rounded(*options.machine.machine, [&](double acceleration_share) {
      return exported_motion(planned.program.table.path, planned.laid.motion, *options.machine.machine,
                             options.machine.feed_limits().max_feed, planned.dwell.motion->seconds, progress,
                             margins_of(acceleration_share));
    });
  }
}

/// Puts the plan of the expected residual in the place of the plan of the residual, with its weights. With blemishes
/// left out it is of the same pixels.
void make_robust(PlannedJob& planned, DwellOptions options, const Progress& progress) {
  planned.plain = std::move(planned.dwell);
  const DwellPlan& plain = *planned.plain;
  options.smoothness = {plain.weights.smoothness};
  options.time_price = {plain.weights.time_price};
  options.robust = planned.job.options.uncertainty->unsure;
  const bool of_rest = plain.left_out && !plain.left_out->pixels.empty();
  planned.dwell = of_rest
                      ? find_without(planned.part(), planned.laid, *plain.left_out, plain.seconds, options, progress)
                      : find_dwell(planned.part(), planned.laid, options, progress, ExactCheck::Lattice, plain.seconds);
  if (plain.left_out && !of_rest) planned.dwell.left_out = plain.left_out;
  planned.dwell.worth = plain.worth;
  planned.dwell.worth_smoothness = plain.worth_smoothness;
  planned.dwell.search = plain.search;
}

/// `used` went of the time limit before [s].
PlannedJob plan_loaded(Job job, JobPath path, double used, const Progress& progress) {
  check_weights(job.options);
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
  if (planned.job.options.robust_plan) {
    options.used_seconds += planned.dwell.solver.seconds;
    make_robust(planned, options, progress.of_part("robust plan"));
  }
  if (planned.blocks) planned.blocks->bounded = strokes_bounded_by_blocks(planned.laid, planned.dwell, options.machine);
  make_program(planned, options, progress);
  return planned;
}

}  // namespace

PlannedJob plan_job(const JobOptions& options, const Progress& progress) {
  check_weights(options);
  check_exports(options);
  check_log_options(options);
  const TimeLimit limit = time_limit(options.max_solve_s);
  Job job = limit.run(progress, [&](const Progress& limited) { return load_job(options, limited); });
  JobPath path = lay_job_path(job, limit.used(), progress);
  return plan_loaded(std::move(job), std::move(path), limit.used(), progress);
}

PlannedJob plan_job(Job job, JobPath path, const Progress& progress) {
  check_log_options(job.options);
  return plan_loaded(std::move(job), std::move(path), 0.0, progress);
}

PlannedJob keep_plan(Job job, LaidPath laid, const Weights& weights, const std::vector<double>& commanded,
                     const Progress& progress) {
  check_exports(job.options);
  PlannedJob planned;
  planned.job = std::move(job);
  planned.laid = std::move(laid);
  const DwellOptions options = dwell_options(planned.job);
  planned.dwell = keep_dwell(planned.part(), planned.laid, options, weights, commanded, progress);
  make_program(planned, options, progress);
  return planned;
}

}  // namespace dwell
