#include "runs/job/log_lesson.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "core/formats/map_name.h"
#include "paths/feed/late_motion.h"
#include "runs/job/learnt_files.h"
#include "runs/logs/log_file.h"
#include "runs/programs/program_comments.h"
#include "runs/programs/program_reader.h"

namespace dwell {
namespace {

/// The time of every step of the program; NaN of those that the log does not tell. Beside a lift, the step has the time
/// that the tool moves or halts in it, not that of the lift.
std::vector<double> logged_seconds(const AlignedLog& aligned, const Program& program) {
  std::vector<double> seconds(program.steps.size(), std::numeric_limits<double>::quiet_NaN());
  const auto removes = [&](std::size_t step) { return program.steps[step].removes; };
  for (std::size_t i = aligned.first; i < aligned.end; ++i) {
    const std::size_t k = i - aligned.first;
    if (aligned.gaps[k] != 0) continue;
    const bool after_lift = i > aligned.first && !removes(i - 1), before_lift = i + 1 < aligned.end && !removes(i + 1);
    const double from = after_lift ? aligned.nodes[k].leaves : aligned.nodes[k].passes,
                 to = before_lift ? aligned.nodes[k + 1].arrives : aligned.nodes[k + 1].passes;
    seconds[i] = to - from;
  }
  return seconds;
}

void refuse_where(bool wrong, const std::string& what) {
  if (wrong) throw InputError(what);
}

}  // namespace

std::string sha256_of_machine(const NamedMachine& machine) { return sha256_of(machine_text(machine)); }

void check_log_options(const JobOptions& options) {
  if (options.log.empty() && options.log_plan.empty()) {
    const bool of_log = !options.log_columns.empty() || options.log_period_s;
    refuse_where(of_log, fmt::format("`log {}`: of a log; required `log` FILE and `log plan` FOLDER beside it",
                                     options.log_columns.empty() ? "period" : "columns"));
    return;
  }
  refuse_where(options.log.empty(),
               fmt::format("`log plan` = {}: without a `log` of its run; required both", options.log_plan));
  refuse_where(options.log_plan.empty(),
               fmt::format("`log` = {}: required `log plan` beside it, the folder of the plan whose program ran (dwell "
                           "simulate PLAN --log FILE compares the two; dwell machine fit learns a machine)",
                           options.log));
  refuse_where(options.machine.empty(),
               fmt::format("`log` = {}: what it says beyond the machine's model is learnt; required a `machine` file "
                           "(dwell machine fit learns one)",
                           options.log));
  refuse_where(options.schedule != ScheduleKind::Constant,
               fmt::format("`log` = {}: corrects feeds; required `schedule` = constant instead of {}", options.log,
                           to_string(options.schedule)));
}

std::optional<LogLesson> learn_from_log(const JobOptions& options, const Part& part, const LaidPath& laid,
                                        const NamedMachine& machine, const Machine& as_planned,
                                        std::vector<InputFile>& inputs, const Progress& progress) {
  if (options.log.empty()) return std::nullopt;
  LogLesson lesson;
  progress.step("log: reading");
  const PlanOnDisk plan = read_plan_on_disk(options.log_plan);
  GcodeReading reading_program;
  reading_program.letters = machine.machine.letters;
  lesson.program = read_program(plan.program, reading_program, progress);
  inputs.push_back({"log-program", plan.program.string(), plan.program_sha256});
  LogReading reading;
  if (!options.log_columns.empty()) reading.columns = parse_log_columns(options.log_columns);
  reading.period = options.log_period_s;
  lesson.log = read_motion_log(options.log, reading, progress);
  inputs.push_back({"log", options.log, sha256_of_file(split_map_name(options.log).file)});
  progress.step("log: aligning");
  lesson.aligned = align_log(lesson.log, lesson.program, options.log_tolerance_mm, progress);
  const StrokeMoves moves = stroke_moves(laid.path, laid.motion);
  std::optional<Eigen::VectorXd> before;
  int logs = 0;
  if (const auto learnt = read_learnt_files(options.log_plan)) {
    if (is_same_hash(learnt->machine_sha256, sha256_of_machine(machine))) {
      before = sum_of_strokes(strokes_of_steps(lesson.program, moves), learnt->late, moves.strokes);
      logs = learnt->logs;
    } else {
      lesson.notes.push_back(
          fmt::format("what {} had learnt from a log before was beyond another machine, and is "
                      "left out",
                      options.log_plan));
    }
  }
  progress.step("log: what it removed");
  lesson.run = learn_motion(part, moves, as_planned,
                            {lesson.program, logged_seconds(lesson.aligned, lesson.program),
                             recorded_motion(lesson.log, lesson.aligned, lesson.program)},
                            before, logs, progress);
  return lesson;
}

}  // namespace dwell
