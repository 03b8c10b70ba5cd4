#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/json_option.h"
#include "cli/log_arguments.h"
#include "cli/named_option.h"
#include "cli/output_files.h"
#include "cli/progress_line.h"
#include "cli/standard_streams.h"
#include "cli/terminal.h"
#include "core/base/duration_text.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "runs/base/json_blocks.h"
#include "runs/figure/store/figure_state.h"
#include "runs/figure/store/measured_step.h"
#include "runs/figure/store/measured_text.h"
#include "runs/figure/store/new_run.h"
#include "runs/figure/store/plan_step.h"
#include "runs/figure/store/run_lock.h"
#include "runs/figure/store/step_json.h"
#include "runs/figure/store/step_records.h"

namespace dwell::cli {
namespace {

/// The flags of the job table but for some, and for those that no run from map to map has.
std::vector<std::string> flags_without(const std::vector<std::string>& left_out) {
  std::vector<std::string> flags = every_flag();
  std::erase_if(flags, [&left_out](const std::string& flag) {
    const bool of_one_plan =
        flag.starts_with("log") || flag == "resume" || flag == "tool" || flag == "removal" || flag == "piston";
    const bool of_a_line = flag == "line-profile" || flag == "line-width" || flag.starts_with("profile-");
    return of_one_plan || of_a_line || std::find(left_out.begin(), left_out.end(), flag) != left_out.end();
  });
  return flags;
}

std::vector<std::string> map_flags() {
  std::vector<std::string> flags;
  for (const JobOptionRecord& record : job_option_table()) {
    if (is_map_convention(record.key) && record.flag != "map") flags.push_back(record.flag);
  }
  return flags;
}

void say_note(const RunLock& lock) {
  if (!lock.note().empty()) say(fmt::format("dwell: {}\n", lock.note()));
}

struct NewArguments {
  std::unique_ptr<JobArguments> job;
  std::string folder, target, bands;
  JsonOption json;
};

int run_new(const NewArguments& a) {
  NewRun run{a.job->options(), a.target, a.bands};
  JobArguments::require(run.options, {"map", "tif", "path"});
  of_option("--target", [&] { return limits_of_target(run.target, run.bands); });
  a.json.check(a.job->files_read(run.options), a.folder);
  const MadeRun made = make_run(a.folder, run, terminal_progress());
  finish_progress();
  std::string text =
      fmt::format("run       {}: {}, {} removed\n", a.folder, in_words(made.before), to_string(run.options.remove));
  text += fmt::format("tool      FWHM {:.4g} mm, peak {:.4g} nm/s\n", made.tif.fwhm, made.tif.peak);
  text += verdict_lines(made.verdicts);
  text += fmt::format("next      dwell figure plan {}\n", a.folder);
  a.json.deliver(json_text(step_json("figure new", made.folder, made.folder.step(1))), text);
  return kDone;
}

struct PlanStepArguments {
  std::unique_ptr<JobArguments> job;
  std::string folder, target;
  JsonOption json;
};

std::string planned_text(const PlannedStep& step, const RunFolder& run) {
  const WrittenPlan& written = step.written;
  std::string text = fmt::format("before    {}\n", in_words(step.target.plan.part().before));
  text += fmt::format("predicted {} by simulating {} as read back{}\n", in_words(written.exact.statistics),
                      written.program.file, step.target.plan.job.machine ? ", executed on the machine" : "");
  if (!step.target.sentence.empty()) text += fmt::format("target    {}\n", step.target.sentence);
  text += verdict_lines(step.verdicts);
  text += fmt::format("time      {} for the run: dwell {}\n", duration_text(written.run_seconds),
                      duration_text(step.target.plan.dwell.run_dwell()));
  text += fmt::format("help      {}\n", written.advice);
  for (const std::string& warning : written.warnings) text += fmt::format("warning   {}\n", warning);
  text += fmt::format("written   {}: program, pictures, setup.pdf\n", step.folder);
  text += "\n" + step.setup + "\n";
  return text +
         fmt::format("next      run the program, measure, then dwell figure measured {} MAP\n", run.folder().string());
}

int run_plan_step(const PlanStepArguments& a) {
  RunFolder run(a.folder);
  const RunLock lock(a.folder);
  say_note(lock);
  run = RunFolder(a.folder);  // as it is now that nobody else changes it
  FigureState state = figure_state(run);
  if (!a.target.empty()) {
    const std::string bands = run.step(1).content.at("bands");
    state.limits = of_option("--target", [&] { return limits_of_target(a.target, bands); });
    state.target = a.target;
  }
  if (state.plan_step)
    say(fmt::format("dwell: the plan of step {} was not measured; this one takes its place\n", *state.plan_step));
  const JobOptions options = a.job->options_over(state.options);
  a.json.check(a.job->files_read(options), a.folder);
  const PlannedStep step = add_plan(run, state, options, terminal_progress());
  finish_progress();
  a.json.deliver(json_text(step_json("figure plan", run, run.steps().back(), step.written.limits)),
                 planned_text(step, run));
  return say_limits(step.written.limits);
}

struct MeasuredArguments {
  std::unique_ptr<JobArguments> job;
  std::string folder, map, log, learn;
  std::optional<int> plan;
  std::vector<std::string> steps;
  LogArguments log_reading;
  JsonOption json;
};

/// "rate=take,shift=leave": what is taken over whatever the rule says.
void read_learn(const std::string& text, Measurement& measurement) {
  constexpr const char* kAccepted =
      "rate, width, shift, rotation =take or =leave, orientation=leave; several by commas";
  for (const std::string_view raw : split(text, ',')) {
    const std::string_view part = trim(raw);
    const std::size_t equals = part.find('=');
    const std::string what(trim(part.substr(0, equals)));
    const std::string how(equals == std::string_view::npos ? "" : trim(part.substr(equals + 1)));
    const std::vector<std::pair<std::string, LessonSubject>> subjects{{"rate", LessonSubject::Rate},
                                                                      {"width", LessonSubject::Width},
                                                                      {"shift", LessonSubject::Shift},
                                                                      {"rotation", LessonSubject::Rotation}};
    const auto subject = std::find_if(subjects.begin(), subjects.end(), [&](const auto& s) { return s.first == what; });
    if (what == "orientation" && how == "leave") {
      measurement.orientation_is_known = true;
    } else if (subject != subjects.end() && (how == "take" || how == "leave")) {
      (how == "take" ? measurement.policy.taken : measurement.policy.left).push_back(subject->second);
    } else {
      throw InputError(fmt::format("--learn '{}': '{}'; accepted: {}", text, part, kAccepted));
    }
  }
}

Measurement measurement_of(const MeasuredArguments& a, const FigureState& state) {
  Measurement measurement;
  measurement.map = a.job->options_over(state.conventions);
  measurement.map.map = a.map;
  measurement.plan_step = a.plan;
  measurement.threads = a.job->options().threads;
  for (const std::string& step : a.steps)
    measurement.steps_of_this_map += (measurement.steps_of_this_map.empty() ? "" : ";") + step;
  if (!a.log.empty()) {
    measurement.log = LogSource{a.log, a.log_reading.reading(), a.log_reading.tolerance()};
  } else if (const std::string flag = a.log_reading.given(); !flag.empty()) {
    throw InputError(flag + ": of a log; --log FILE is required beside it");
  }
  if (!a.learn.empty()) read_learn(a.learn, measurement);
  return measurement;
}

int run_measured(const MeasuredArguments& a) {
  RunFolder run(a.folder);
  const RunLock lock(a.folder);
  say_note(lock);
  run = RunFolder(a.folder);
  const FigureState state = figure_state(run);
  const Measurement measurement = measurement_of(a, state);
  std::vector<ReadFile> read = a.job->files_read(measurement.map);
  read.push_back({"the log", a.log});
  a.json.check(read, a.folder);
  const MeasuredStep step = add_measurement(run, state, measurement, terminal_progress());
  finish_progress();
  const double fwhm = run.step(1).content.at("tool").at("fwhm_mm").get<double>() * state.options.tif_width;
  if (!step.fault.empty()) {
    nlohmann::ordered_json json = json_of_command("figure measured");
    json["run"] = a.folder;
    json["content"]["orientation"] = comparison_record(step.comparison)["orientation"];
    json["limits"] = {step.fault};
    a.json.deliver(json_text(json), measured_text(step, fwhm) +
                                        "kept      nothing: the run is as before; once it is known how the part lay, "
                                        "--learn orientation=leave, shift=take or shift=leave passes this over\n");
    return say_limits({step.fault});
  }
  a.json.deliver(json_text(step_json("figure measured", run, run.steps().back())),
                 measured_text(step, fwhm) + fmt::format("written   {}\n", step.folder) +
                     (all_pass(step.next_run.now) && !step.next_run.now.empty()
                          ? std::string()
                          : fmt::format("next      dwell figure plan {}\n", a.folder)));
  return kDone;
}

void add_new(CLI::App& figure, int& exit_code) {
  CLI::App* command = figure.add_subcommand("new", "make a run: the folder of a part and its first map");
  auto a = std::make_shared<NewArguments>();
  command->add_option("run", a->folder, "folder of the run; it must be new or empty")->type_name("RUN")->required();
  command
      ->add_option(
          "--target", a->target,
          "limits of the finished surface, QUANTITY<=NUMBER[UNIT] separated by commas: rms, pv, pvr, slope, mid, "
          "band(A..Bmm); bare numbers are nm, of slope urad. Each plan is the shortest that is expected to meet "
          "them")
      ->type_name("LIMITS");
  command->add_option("--bands", a->bands, "wavelengths between bands in mm, descending, for mid: 33,0.12")
      ->type_name("MM,MM");
  a->job = std::make_unique<JobArguments>(*command, flags_without({"out"}), true);
  a->json.add_to(*command);
  command->footer(
      "Example:\n"
      "  dwell figure new mirror/ --map first.dat --tif spot.dat --machine machine.toml --path raster:pitch=1 \\\n"
      "                   --target 'rms<=1nm, pv<=10nm'");
  command->callback([a, &exit_code] { exit_code = run_new(*a); });
}

void add_plan_step(CLI::App& figure, int& exit_code) {
  CLI::App* command = figure.add_subcommand("plan", "plan the next run: program, prediction, pictures, setup sheet");
  auto a = std::make_shared<PlanStepArguments>();
  command->add_option("run", a->folder, "folder of the run")->type_name("RUN")->required();
  std::vector<std::string> left_out = map_flags();
  left_out.insert(left_out.end(), {"out", "map", "tif"});
  command->add_option("--target", a->target, "limits that this plan steers by, in place of the run's")
      ->type_name("LIMITS");
  a->job = std::make_unique<JobArguments>(*command, flags_without(left_out), false);
  a->json.add_to(*command);
  command->footer(
      "Options given here hold for this plan alone.\n"
      "Example:\n  dwell figure plan mirror/\n"
      "Exit codes: 0 done, 2 bad usage or input, 3 done but a limit was reached, 130 interrupted.");
  command->callback([a, &exit_code] { exit_code = run_plan_step(*a); });
}

void add_measured(CLI::App& figure, int& exit_code) {
  CLI::App* command =
      figure.add_subcommand("measured", "the map after a run: what was removed, what it teaches, whether another pays");
  auto a = std::make_shared<MeasuredArguments>();
  command->add_option("run", a->folder, "folder of the run")->type_name("RUN")->required();
  command->add_option("map", a->map, "map after the run; read as the maps before unless an option says otherwise")
      ->type_name("MAP")
      ->required();
  a->job = std::make_unique<JobArguments>(*command, map_flags(), false);
  command
      ->add_option("--step", a->steps, "a step that prepares this map alone, as in --map-steps: fiducials:..., flip:x")
      ->type_name("STEP");
  command->add_option("--log", a->log, "log of the controller of this run: then what was removed is compared with it")
      ->type_name("FILE");
  a->log_reading.add_to(*command);
  command
      ->add_option("--learn", a->learn,
                   "what is learnt whatever the rule says: rate, width, shift or rotation =take or =leave; "
                   "orientation=leave takes the map although it seems to lie otherwise")
      ->type_name("WHAT=HOW,...");
  a->json.add_to(*command);
  command->footer(
      "Example:\n  dwell figure measured mirror/ second.dat --log run.csv\n"
      "Exit codes: 0 done, 2 bad usage or input, 3 part or map lie otherwise than thought and nothing was kept, 130 "
      "interrupted.");
  command->callback([a, &exit_code] { exit_code = run_measured(*a); });
}

}  // namespace

void add_figure_command(CLI::App& program, int& exit_code) {
  CLI::App* figure = program.add_subcommand(
      "figure", "correct a part run by run: plan, polish, measure, learn, until it is in specification");
  figure->require_subcommand(1);
  add_new(*figure, exit_code);
  add_plan_step(*figure, exit_code);
  add_measured(*figure, exit_code);
  add_figure_record_commands(*figure, exit_code);
  add_figure_simulate_command(*figure, exit_code);
  figure->footer(
      "Example:\n  dwell figure new mirror/ --map first.dat --tif spot.dat --path raster:pitch=1\n"
      "  dwell figure plan mirror/\n  dwell figure measured mirror/ second.dat\n  dwell figure status mirror/");
}

}  // namespace dwell::cli
