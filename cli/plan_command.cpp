#include <fmt/format.h>

#include <memory>
#include <set>
#include <string>
#include <utility>

#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/json_option.h"
#include "cli/progress_line.h"
#include "cli/result_folder.h"
#include "cli/standard_streams.h"
#include "cli/terminal.h"
#include "core/base/counted.h"
#include "core/base/duration_text.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include "runs/campaigns/joint_plan_output.h"
#include "runs/job/job_file.h"
#include "runs/job/program_style.h"
#include "runs/programs/program_block.h"
#include "runs/reports/aim.h"
#include "runs/reports/anatomy_lines.h"
#include "runs/reports/counted_figures.h"
#include "runs/reports/exact_lines.h"
#include "runs/reports/log_report.h"
#include "runs/reports/machine_report.h"
#include "runs/reports/map_line.h"
#include "runs/reports/objective_lines.h"
#include "runs/reports/plan_costs.h"
#include "runs/reports/plan_files.h"
#include "runs/reports/plan_output.h"
#include "runs/reports/recorded_plan.h"
#include "runs/reports/resume_plan.h"
#include "runs/reports/resume_report.h"
#include "runs/reports/tool_sheet.h"
#include "runs/reports/travel_words.h"
#include "runs/reports/weight_lines.h"
#include "solvers/solver_catalogue.h"

namespace dwell::cli {
namespace {

struct PlanArguments {
  std::unique_ptr<JobArguments> job;
  JsonOption json;
  ResultFolder folder;
  bool write_job = false;
  std::string resume;  // where the program of --log-plan stopped; empty: a plan of its own
};

/// What the machine makes of the plan; empty without one.
std::string motion_lines(const PlannedJob& plan) {
  if (!plan.dwell.motion) return "";
  const MotionPlan& m = *plan.dwell.motion;
  const double planned = plan.dwell.residual.rms_about_zero();
  const NamedMachine& machine = *plan.job.machine;
  return machine_lines({machine.name, machine_for_program(machine.machine, plan.job.options)}) +
         fmt::format(
             "motion    {:.4g} nm RMS executed, {:.3f} times the planned; {:.4g} nm without correction, {} of "
             "{}\n",
             m.executed(), m.executed() / planned, m.one_shot(), m.best, counted(m.rounds.size() - 1, "round")) +
         fmt::format("          {} of {} strokes as fast as the machine can, {} that it cannot run in their time\n",
                     m.at_least, plan.laid.path.size(), m.too_short);
}

/// What the controller's block rate did to the path; empty without one.
std::string block_lines(const PlannedJob& plan) {
  if (!plan.blocks) return "";
  const BlockMerging& b = *plan.blocks;
  return fmt::format(
      "blocks    {} of {} were shorter than {:.6g} blocks/s allow, at {:.4g} nm RMS planned; {} after merging straight "
      "on, at {:.4g} nm; {} run no faster than that\n",
      b.short_before, b.before, plan.job.machine->machine.controller.max_blocks_per_s, b.rms_before, b.after,
      plan.dwell.residual.rms_about_zero(), counted(b.bounded, "stroke"));
}

/// How long which limit of the machine binds; empty without one.
std::string limit_lines(const WrittenPlan& written) {
  if (written.nodes.empty()) return "";
  const auto seconds = time_at_limits(written.nodes, written.binding);
  double total = 0.0;
  for (const double s : seconds) total += s;
  const auto share = [&](BindingLimit limit) { return 100.0 * seconds[static_cast<std::size_t>(limit)] / total; };
  const double jerk = share(BindingLimit::Jerk);
  return fmt::format(
      "limits    of the time at work, acceleration binds in {:.1f} %, {}speed in {:.1f} %, rests at corners "
      "take {:.1f} %\n",
      share(BindingLimit::Acceleration), jerk > 0.0 ? fmt::format("jerk in {:.1f} %, ", jerk) : "",
      share(BindingLimit::Speed), share(BindingLimit::Rest));
}

/// How the dwell was found, and how near to the optimum it is.
std::string solver_lines(const PlannedJob& plan) {
  if (plan.resumed) return "solver    none: the dwell of the plan is kept\n";
  return fmt::format("solver    {}: {} after {}, {}, {:.2f} s\n", to_string(plan.dwell.solver.kind),
                     to_string(plan.dwell.solver.status), counted(plan.dwell.solver.iterations, "iteration"),
                     counted(plan.dwell.solver.operator_applications, "operator application"),
                     plan.dwell.solver.seconds) +
         optimum_line(plan.dwell);
}

/// What the log of an earlier run has taught; empty without one.
std::string lesson_lines(const PlannedJob& plan) {
  if (!plan.job.lesson) return "";
  const LogLesson& lesson = *plan.job.lesson;
  const LearntFromRun& r = lesson.run;
  return log_lines(lesson.log, lesson.aligned, lesson.program) +
         fmt::format("learnt    from {}: the recorded run left {:.4g} nm RMS in {:.3f} s, {:.3f} s were expected\n",
                     counted(static_cast<std::size_t>(r.learnt.logs), "log"), r.recorded_rms, r.recorded_seconds,
                     r.expected_seconds) +
         fmt::format(
             "          strokes take {:.3g} ms more than on the machine, {:.3g} ms RMS; the removal differs by "
             "{:.4g} nm RMS besides\n",
             1e3 * r.late_mean, 1e3 * r.late_rms, r.removal_rms);
}

/// The programs besides feed.csv and program.nc; empty without any.
std::string export_lines(const WrittenPlan& written) {
  std::string lines;
  for (const WrittenExport& e : written.exports) {
    lines += fmt::format("{}{}{}: {} by simulating it as read back, {} in {:.2f} s\n",
                         lines.empty() ? "export    " : "          ", e.file,
                         e.files > 1 ? fmt::format(" and {}", counted(e.files - 1, "file")) : "", in_words(e.residual),
                         counted(e.steps, "step"), e.total_s);
  }
  return lines;
}

/// The text for people.
std::string plan_text(const PlannedJob& plan, const WrittenPlan& written) {
  std::string text = plan.resumed ? resume_lines(*plan.resumed) : "";
  text += map_line(plan.part().map.grid, plan.part().before.valid_pixels);
  text += fmt::format("before    {} ({} removed)\n", in_words(plan.part().before), to_string(plan.part().form));
  text += counted_lines(counted_figures(plan.job, written.exact.surface));
  text += aim_line(correction_aim(plan.job));
  text += tool_lines(tool_sheet(plan.part().tif));
  text += fmt::format("path      {}, {}, {:.6g} mm, longest jump {:.4g} mm, {}\n", plan.laid.path.kind,
                      counted(plan.laid.metrics.points, "point"), plan.laid.metrics.length,
                      plan.laid.metrics.longest_jump, counted(plan.laid.metrics.lifts, "lift"));
  for (const std::string& note : plan.laid.path.notes) text += fmt::format("          {}\n", note);
  text += objective_line(plan) + weight_lines(plan);
  text += solver_lines(plan);
  text +=
      fmt::format("dwell     total {}, from {:.4g} s to {:.4g} s a point, step RMS {:.4g} s{}\n",
                  duration_text(plan.dwell.seconds.sum()), plan.dwell.seconds.minCoeff(), plan.dwell.seconds.maxCoeff(),
                  plan.dwell.step_rms, plan.dwell.motion ? "; before the correction for the machine's motion" : "");
  text += fmt::format("feed      {:.4g} to {:.4g} mm/min, {} of {} segments at a limit\n",
                      units::mm_per_min(plan.program.feed.min_speed), units::mm_per_min(plan.program.feed.max_speed),
                      plan.program.feed.segments_limited, plan.laid.path.size());
  text += fmt::format(
      "predicted {} by the solver, on a lattice of {}{}\n", rms_in_words(plan.dwell.residual),
      lattice_words(plan.dwell.lattice.kernel),
      plan.dwell.lattices > 1 ? fmt::format(" (solved {}, each finer)", counted(plan.dwell.lattices, "time")) : "");
  text += block_lines(plan) + lesson_lines(plan) + motion_lines(plan) + limit_lines(written);
  text += fmt::format("program   {} by simulating {} as read back{}\n", in_words(written.exact.statistics),
                      written.program.file, plan.dwell.motion ? ", executed on the machine" : "");
  text += export_lines(written) + exact_lines(written.exact);
  if (written.uncertainty) text += uncertainty_lines(*written.uncertainty);
  text += anatomy_lines(written.anatomy, written.exact.statistics) + left_out_line(plan.dwell) + cost_line(plan);
  text += fmt::format("help      {}\n", written.advice) + surface_lines(written.surface) +
          verdict_lines(written.acceptance);
  text += fmt::format("time      {} for the run: dwell {:.2f} s, {}\n", duration_text(written.run_seconds),
                      plan.dwell.run_dwell(), travel_words(written.travel));
  for (const std::string& warning : written.warnings) text += fmt::format("warning   {}\n", warning);
  return text;
}

/// The options of the command line and the job file; with the plan of a log, over its own.
JobOptions options_of(const PlanArguments& arguments) {
  JobOptions options = arguments.job->options();
  if (options.log_plan.empty() || arguments.job->has_file()) return options;
  const RecordedPlan plan = read_recorded_plan(options.log_plan);
  JobOptions over = plan.options;
  over.log_columns.clear();  // what an earlier log was like says nothing of this one
  over.log_period_s.reset();
  over.log_tolerance_mm = JobOptions().log_tolerance_mm;
  options = arguments.job->options_over(std::move(over));
  std::set<std::string> given;
  for (const JobOptionRecord* record : arguments.job->given()) given.insert(record->flag);
  if (!given.contains("log")) options.log.clear();
  check_recorded_inputs(plan, given);
  return options;
}

/// Options that the rest of a program may have beside those of its plan.
void check_resume_options(const PlanArguments& arguments) {
  const std::set<std::string> accepted{"log-plan", "log-columns", "log-period", "log-tolerance", "out",
                                       "accept",   "threads",     "max-pixels", "figures",       "figure-range"};
  if (arguments.job->has_file())
    throw InputError("--resume: not with --job; the rest of a program has the options of its plan");
  std::string names;
  for (const std::string& flag : accepted) names += (names.empty() ? "--" : ", --") + flag;
  for (const JobOptionRecord* record : arguments.job->given()) {
    if (accepted.contains(record->flag)) continue;
    throw InputError(
        fmt::format("--{}: not with --resume, which goes on with the plan's own program; accepted beside it: {}",
                    record->flag, names));
  }
}

/// Several tools on one surface, a plan each.
int run_joint_plan(const PlanArguments& arguments, const JobOptions& options) {
  JobArguments::require(options, {"map", "out"});
  const std::vector<ReadFile> read = arguments.job->files_read(options);
  arguments.json.check(read, options.out);
  OutputFolder folder = arguments.folder.make(options.out, joint_plan_files(), read);
  const JointPlan plan = plan_tools(options, folder, terminal_progress());
  const std::string json = write_joint_plan(plan, folder);
  folder.commit();
  finish_progress();
  arguments.json.deliver(json, joint_plan_text(plan) + fmt::format("written   {}\n", options.out));
  return say_limits(plan.limits);
}

int run_plan(const PlanArguments& arguments) {
  const bool resumes = !arguments.resume.empty();
  if (resumes) check_resume_options(arguments);
  const JobOptions options = options_of(arguments);
  if (arguments.write_job) {
    print(job_file_text(options));
    return kDone;
  }
  if (!resumes && !options.tools.empty()) return run_joint_plan(arguments, options);
  if (resumes) {
    JobArguments::require(options, {"log-plan", "out"});
  } else {
    JobArguments::require(options, {"map", "tif", "path", "out"});
  }
  std::vector<ReadFile> read = arguments.job->files_read(options);
  if (resumes && !is_program_block(arguments.resume)) read.push_back({"the log", arguments.resume});
  arguments.json.check(read, options.out);
  OutputFolder folder = arguments.folder.make(options.out, plan_files(), read);
  const Progress progress = terminal_progress();
  const PlannedJob plan =
      resumes ? resume_plan(arguments.resume, options, folder, progress) : plan_job(options, progress);
  const WrittenPlan written = write_plan(plan, folder, progress);
  folder.commit();
  finish_progress();
  arguments.json.deliver(written.summary, plan_text(plan, written) + fmt::format("written   {}\n", options.out));
  return say_limits(written.limits);
}

}  // namespace

void add_plan_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("plan", "plan a run: path, dwell, feed table, program, predicted surface");
  auto arguments = std::make_shared<PlanArguments>();
  arguments->job = std::make_unique<JobArguments>(*command, every_flag(), true);
  arguments->folder.add_to(*command);
  arguments->json.add_to(*command);
  command->add_flag("--write-job", arguments->write_job,
                    "print a job file with these options, with comments, and stop");
  command
      ->add_option(
          "--resume", arguments->resume,
          "the rest of the program in --log-plan, which was stopped: in this line of program.nc (1234), in the "
          "block of this number (N1234), or where this log of the controller ends; it keeps its dwell and all "
          "other options of its plan")
      ->type_name("LINE|LOG");
  command->footer(
      "Example:\n"
      "  dwell plan --map mirror.csv --map-pixel 0.0938 --tif spot.csv --tif-pixel 0.0938 \\\n"
      "             --path raster:pitch=1 --max-feed 3000 --out plan/\n"
      "  dwell plan --map mirror.csv --map-pixel 0.0938 --out tools/ \\\n"
      "             --tool 'large;tif=gaussian:peak=40,fwhm=8,radius=12;path=raster:pitch=2' \\\n"
      "             --tool 'small;tif=gaussian:peak=8,fwhm=2,radius=3;path=raster:pitch=0.5;change-over=10min'\n"
      "  dwell plan --log-plan plan/ --log run.csv --machine machine.toml --out next/\n"
      "  dwell plan --resume 1234 --log-plan plan/ --out rest/\n"
      "Exit codes: 0 done, 1 internal fault, 2 bad usage or input, 3 done but a limit was reached, 130 interrupted.");
  command->callback([arguments, &exit_code] { exit_code = run_plan(*arguments); });
}

}  // namespace dwell::cli
