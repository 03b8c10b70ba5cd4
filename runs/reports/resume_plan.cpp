#include "runs/reports/resume_plan.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "core/formats/map_name.h"
#include "core/removal/simulate.h"
#include "paths/feed/execution.h"
#include "paths/feed/late_motion.h"
#include "paths/feed/lift_rests.h"
#include "paths/feed/stroke_moves.h"
#include "runs/job/learnt_files.h"
#include "runs/job/log_lesson.h"
#include "runs/job/program_style.h"
#include "runs/logs/log_alignment.h"
#include "runs/logs/log_file.h"
#include "runs/plan/lattice_choice.h"
#include "runs/plan/rest_of_path.h"
#include "runs/programs/program_block.h"
#include "runs/programs/program_reader.h"
#include "runs/reports/another_surface.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;

/// Where a program stopped.
struct Stop {
  Program program;
  std::size_t step = 0;            // index of the step in which it stopped
  double share = 0.0;              // of that step which was run
  std::string by;                  // for people
  std::optional<MotionLog> log{};  // that says so
};

Stop find_stop(const std::string& stop, const JobOptions& options, const Job& job, const fs::path& program,
               const Progress& progress) {
  GcodeReading reading;
  if (job.machine) reading.letters = job.machine->machine.letters;
  if (is_program_block(stop)) {
    ProgramBlock block = find_program_block(program, stop, reading, progress);
    const std::size_t step = block.step;
    return {std::move(block.program), step, 0.0, fmt::format("line {} of {}", block.line, program.filename().string())};
  }
  if (options.motion == Motion::Stop) {
    throw InputError(
        fmt::format("`resume` = {}: the tool halts at its dwell points in this plan (`motion` = stop), and a log's "
                    "places do not say "
                    "how much of a halt was done; required the line of the program, 1234, or its block, N1234",
                    stop));
  }
  LogReading log_reading;
  if (!options.log_columns.empty()) log_reading.columns = parse_log_columns(options.log_columns);
  log_reading.period = options.log_period_s;
  MotionLog log = read_motion_log(stop, log_reading, progress);
  Program whole = read_program(program, reading, progress);
  const LogEnd end = end_of_log(log, whole, options.log_tolerance_mm, progress);
  return {std::move(whole), end.step, end.share, "the log " + stop, std::move(log)};
}

/// The steps before the stop.
Program done_part(const Stop& stop) {
  Program done = stop.program;
  done.path_modes.clear();
  done.steps.resize(stop.step);
  if (stop.share > 0.0) {
    ProgramStep part = stop.program.steps[stop.step];
    part.finish = part.start + stop.share * (part.finish - part.start);
    part.seconds *= stop.share;
    done.steps.push_back(part);
  }
  if (std::none_of(done.steps.begin(), done.steps.end(), [](const auto& step) { return step.removes; })) {
    throw InputError(
        fmt::format("`resume`: by {} nothing was removed yet; the program can be run anew from its "
                    "beginning",
                    stop.by));
  }
  return done;
}

double working_seconds(const Program& program) {
  double sum = 0.0;
  for (const ProgramStep& step : program.steps) sum += step.removes ? step.seconds : 0.0;
  return sum;
}

/// The motion of the part that was done: as recorded, or as the plan's machine runs it.
Program motion_of(const Stop& stop, const Program& done, const Job& job, double tolerance, const Progress& progress) {
  const Machine machine = job.machine ? machine_for_program(job.machine->machine, job.options) : Machine{};
  if (!stop.log) return job.machine ? execute(done, machine, progress).motion : done;
  const AlignedLog aligned = align_log(*stop.log, done, tolerance, progress);
  return with_lift_rests(recorded_motion(*stop.log, aligned, done), machine);
}

/// The rest of the path from the stop on.
RestOfPath rest_after(const FeedTable& table, const Stop& stop, double max_feed) {
  const auto refuse = [&stop] {
    throw InputError(fmt::format("`resume`: by {} the work was at its end: nothing is left to be done", stop.by));
  };
  const std::vector<Index> stroke = strokes_of_steps(stop.program, stroke_moves(table.path, table.motion));
  std::size_t at = stop.step;
  while (at < stroke.size() && stroke[at] == StrokeMoves::kNoStroke) ++at;
  if (at == stroke.size()) refuse();
  // What of this stroke was done: its steps before, and a share of the one in which it stopped.
  double done = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (stroke[i] != stroke[at]) continue;
    const double seconds = stop.program.steps[i].seconds;
    whole += seconds;
    if (i < stop.step) done += seconds;
    if (i == stop.step) done += stop.share * seconds;
  }
  RestOfPath rest = rest_of_path(table.path, table.dwell_s, table.motion, static_cast<std::size_t>(stroke[at]),
                                 whole > 0.0 ? std::min(done / whole, 1.0) : 0.0, max_feed);
  if (rest.path.points.empty()) refuse();
  return rest;
}

/// The feed table of the plan, which must be of its program.
FeedTable table_of_plan(const fs::path& folder, const Program& program, const Progress& progress) {
  constexpr double kSame = 0.01;
  FeedTable table = read_feed_table(folder / "feed.csv", progress);
  const double by_table = working_seconds(program_of(table)), by_program = working_seconds(program);
  if (std::abs(by_table - by_program) <= kSame * by_program) return table;
  throw InputError(fmt::format(
      "{}: its work takes {:.6g} s and that of {} {:.6g} s; required the feed table that the plan was made with",
      (folder / "feed.csv").string(), by_table, program.file, by_program));
}

Weights weights_of_plan(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  const nlohmann::json summary = nlohmann::json::parse(read_whole_file(file), nullptr, false);
  const auto number = [&](const char* key) {
    const nlohmann::json weights = summary.is_object() ? summary.value("weights", nlohmann::json()) : nlohmann::json();
    if (weights.is_object() && weights.contains(key) && weights[key].is_number()) return weights[key].get<double>();
    throw InputError(
        fmt::format("{}: weights.{} is missing or no number; required it in a plan's summary", file.string(), key));
  };
  return {number("smoothness"), number("time_price_nm2_per_s")};
}

/// A removal at the pixels of a map that have data, NaN at others.
HeightMap where_measured(HeightMap removal, const HeightMap& map) {
  for (std::size_t i = 0; i < removal.values.size(); ++i) {
    if (!std::isfinite(map.values[i])) removal.values[i] = map.values[i];
  }
  return removal;
}

/// The options of the rest: with the weights as numbers, and nothing that is already done.
JobOptions options_of_rest(JobOptions options, const Weights& weights) {
  const JobOptions none;
  options.path = parse_path_spec("file:" + (fs::path(options.out) / "feed.csv").string());
  options.smoothness = {weights.smoothness};
  options.time_price_nm2_per_s = {weights.time_price};
  options.time_worth = none.time_worth;
  options.certify = none.certify;
  options.fraction = none.fraction;
  if (options.blemishes == BlemishHandling::LeaveOut) options.blemishes = BlemishHandling::Report;
  options.log.clear();
  options.log_plan.clear();
  options.log_columns.clear();
  options.log_period_s.reset();
  options.log_tolerance_mm = none.log_tolerance_mm;
  return options;
}

std::string uncertainty(const ResumedRun& run, bool by_log) {
  return fmt::format(
      "where the program stopped is uncertain by a block: here step {} of {:.3g} s, which removes {:.3g} nm at its "
      "deepest; {}",
      run.step, run.block_seconds, run.block_depth,
      by_log ? "the log's last place counts as the stop" : "it counts as not run and is run again");
}

}  // namespace

PlannedJob resume_plan(const std::string& stop_text, const JobOptions& options, const OutputFolder& folder,
                       const Progress& progress) {
  if (options.log_plan.empty()) {
    throw InputError(
        fmt::format("`resume` = {}: required `log plan` beside it, the folder of the plan whose program "
                    "was stopped",
                    stop_text));
  }
  if (options.schedule != ScheduleKind::Constant) {
    throw InputError(
        fmt::format("`resume` = {}: the plan has `schedule` = {}, whose speeds cannot be taken up within; "
                    "required a plan with constant feeds",
                    stop_text, to_string(options.schedule)));
  }
  const fs::path plan = options.log_plan;
  const PlanOnDisk on_disk = read_plan_on_disk(plan);
  Job job = load_job(options, progress);
  const Stop stop = find_stop(stop_text, options, job, on_disk.program, progress);
  const Program done = done_part(stop);
  const FeedTable table = table_of_plan(plan, stop.program, progress);
  const RestOfPath rest = rest_after(table, stop, dwell_options(job).machine.feed_limits().max_feed);

  progress.report("simulate: what was removed so far");
  const Part& part = *job.part;
  const Program motion = motion_of(stop, done, job, options.log_tolerance_mm, progress);
  const LatticeChoice lattice = choose_lattice(part, removing_steps(motion).strokes, progress.of_part("lattice"));
  const HeightMap whole = whole_surface(part), removed = simulate(motion, whole, lattice.kernel, part.threads);
  HeightMap left = surface_after(whole, removed);
  left.history = part.map.history;
  left.history.push_back(fmt::format("what {} had removed by {} taken off", on_disk.program.string(), stop.by));

  ResumedRun run;
  run.plan = options.log_plan;
  run.by = stop.by;
  run.step = stop.step + 1;
  run.steps = stop.program.steps.size();
  const ProgramStep& block = stop.program.steps[stop.step];
  run.place = block.start + stop.share * (block.finish - block.start);
  run.seconds = working_seconds(motion);
  const bool machine = job.machine.has_value();
  run.whole_seconds = working_seconds(
      machine ? execute(stop.program, machine_for_program(job.machine->machine, options), progress).motion
              : stop.program);
  run.way = done.removing_length();
  run.whole_way = stop.program.removing_length();
  run.removed = map_statistics(where_measured(removed, part.map), {}, part.threads);
  run.measured = part.before;
  if (block.removes) {
    Program one;
    one.steps = {block};
    const HeightMap depth = simulate(one, part.map, lattice.kernel, part.threads);
    run.block_seconds = block.seconds;
    for (const double d : depth.values)
      run.block_depth = std::isfinite(d) ? std::max(run.block_depth, d) : run.block_depth;
  }

  const Weights weights = weights_of_plan(plan);
  replace_surface(job, left, folder, kRemainingMap, progress);
  run.remaining = job.part->before;
  job.options = options_of_rest(job.options, weights);
  job.inputs.push_back({"log-program", on_disk.program.string(), on_disk.program_sha256});
  if (stop.log) job.inputs.push_back({"log", stop_text, sha256_of_file(split_map_name(stop_text).file)});
  job.notes.push_back(uncertainty(run, stop.log.has_value()));
  if (read_learnt_files(plan)) {
    job.notes.push_back(fmt::format("what logs have taught {} beyond its machine is left out: it holds for whole runs",
                                    options.log_plan));
  }
  PlannedJob planned = keep_plan(std::move(job), lay_path(rest.path, table.motion), weights, rest.dwell, progress);
  planned.resumed = std::move(run);
  return planned;
}

}  // namespace dwell
