#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
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
#include "cli/terminal.h"
#include "core/base/counted.h"
#include "core/base/duration_text.h"
#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "core/formats/map_formats.h"
#include "core/formats/map_name.h"
#include "runs/drawing/picture.h"
#include "runs/job/option_flags.h"
#include "runs/job/place_option.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/shipped_templates.h"
#include "runs/reports/anatomy_lines.h"
#include "runs/reports/counted_figures.h"
#include "runs/reports/exact_lines.h"
#include "runs/reports/log_report.h"
#include "runs/reports/machine_report.h"
#include "runs/reports/map_line.h"
#include "runs/reports/motion_table.h"
#include "runs/reports/recorded_plan.h"
#include "runs/reports/simulation.h"
#include "runs/reports/tool_sheet.h"

namespace dwell::cli {
namespace {

struct SimulateArguments {
  std::unique_ptr<JobArguments> job;
  std::string plan, program, gcode, g4, start, residual, png, log, log_png, motion_table;
  LogArguments log_reading;
  JsonOption json;
  bool exact = false;
  OtherInputs other;
};

/// "feed.csv or program.nc".
std::string program_files() {
  std::string names;
  for (const ProgramFormat& format : program_formats()) {
    if (!format.file.empty()) names += (names.empty() ? "" : " or ") + format.file;
  }
  return names;
}

/// What is simulated, on what, and how that is other than in the plan.
struct SimulationRequest {
  std::string program;
  JobOptions options;
  SimulationSource source;
  std::optional<ProgramTemplate> layout{};  // by which the program is read
};

/// "map given instead of the plan's: second.csv, the plan's is map.csv".
std::string given_sentence(const std::string& flag, const std::string& now, const std::string& then) {
  return fmt::format("{} given instead of the plan's: {}; the plan's is {}", flag, now.empty() ? "none" : now,
                     then.empty() ? "none" : then);
}

/// Whether two names are of one file.
bool are_same_file(const std::string& a, const std::string& b) {
  std::error_code none;
  return a == b || std::filesystem::equivalent(a, b, none);
}

/// The sentence of a file, which may be a copy of the plan's.
std::string given_file_sentence(const std::string& flag, const std::string& now, const std::string& then) {
  std::error_code none;
  const bool both = std::filesystem::is_regular_file(now, none) && std::filesystem::is_regular_file(then, none);
  const bool copy = both && sha256_of_file(now) == sha256_of_file(then);
  return given_sentence(flag, now, then) + (copy ? ", which holds the same" : "");
}

/// The template by which a program of a plan is read: one that is given, or the plan's for its own program.
std::optional<ProgramTemplate> layout_of_plan(const RecordedPlan& plan, const SimulationRequest& request, bool given) {
  const std::string& name = request.options.program_template;
  const bool own = std::filesystem::path(request.program).stem() == kTemplateProgram;
  if (name.empty() || (!given && !own)) return std::nullopt;
  const std::string text = program_template_text(name);
  for (const InputFile& input : plan.inputs) {
    if (given || input.role != "template" || input.sha256 == sha256_of(text)) continue;
    throw InputError(fmt::format(
        "{}: the template has changed since the plan was made, and the program may mean something else by it; required "
        "the same, or --template {} to take it as it is now",
        name, name));
  }
  return parse_program_template(text, name);
}

SimulationRequest request_of_plan(const SimulateArguments& a) {
  const RecordedPlan plan = read_recorded_plan(a.plan);
  std::set<std::string> flags;
  SimulationRequest request{plan.program().string(), a.job->options_over(plan.options), {a.plan, {}, a.other, {}}};
  for (const JobOptionRecord* record : a.job->given()) {
    flags.insert(record->flag);
    if (record->flag == "threads" || record->flag == "max-pixels") continue;  // change no result
    const std::string now = record->get(request.options), then = record->get(plan.options);
    const bool file = record->flag == "map" || record->flag == "removal" || record->flag == "line-profile" ||
                      record->flag == "tif" || record->flag == "machine" || record->flag == "template";
    if (file && !are_same_file(now, then)) {
      request.source.given.push_back(given_file_sentence(record->flag, now, then));
    } else if (!file && now != then) {
      request.source.given.push_back(given_sentence(record->flag, now, then));
    }
  }
  if (flags.contains("map")) flags.insert("line-profile");  // whichever the plan has, its file is not looked at
  if (flags.contains("line-profile")) flags.insert("map");
  request.source.other.map |= flags.contains("map") || flags.contains("removal") || flags.contains("map-steps");
  request.source.other.tif |= flags.contains("tif");
  if (!a.program.empty()) {
    flags.insert("program");
    if (!are_same_file(a.program, request.program)) {
      request.source.given.push_back(given_file_sentence("program", a.program, request.program));
    } else if (sha256_of_file(a.program) != plan.program_sha256) {
      request.source.given.push_back(
          fmt::format("program given as it is now: {}, which has changed since the plan was made", a.program));
    }
    request.program = a.program;
  }
  check_recorded_inputs(plan, flags);
  request.source.learnt = read_learnt_files(a.plan);
  if (request.source.learnt && (flags.contains("machine") || flags.contains("program"))) {
    request.source.learnt.reset();
    request.source.given.emplace_back(
        "what logs have taught is left out, since it holds for the plan's own program on its own machine");
  }
  request.layout = layout_of_plan(plan, request, flags.contains("template"));
  return request;
}

/// The log that is given; nothing without one.
std::optional<LogSource> log_source(const SimulateArguments& a) {
  if (!a.log.empty()) return LogSource{a.log, a.log_reading.reading(), a.log_reading.tolerance()};
  const std::string flag = a.log_png.empty() ? a.log_reading.given() : "--log-png";
  if (!flag.empty()) throw InputError(flag + ": of a log; --log FILE is required beside it");
  return std::nullopt;
}

SimulationRequest program_request(const SimulateArguments& a) {
  if (!a.plan.empty()) return request_of_plan(a);
  if (a.program.empty()) {
    throw InputError("PLAN or --program: required; the folder of a plan, or a program alone (" + program_files() +
                     ") with --map and --tif");
  }
  const JobOptions options = a.job->options();
  JobArguments::require(options, {"map", "tif"});
  SimulationRequest request{a.program, options, {"", {}, a.other, {}}};
  if (!options.program_template.empty()) request.layout = find_program_template(options.program_template);
  return request;
}

SimulationRequest request_of(const SimulateArguments& a) {
  std::optional<LogSource> log = log_source(a);
  SimulationRequest request = program_request(a);
  request.source.log = std::move(log);
  return request;
}

void check_outputs(const SimulateArguments& a, const JobOptions& options, const std::string& program, bool learnt) {
  std::vector<ReadFile> read = a.job->files_read(options);
  read.push_back({"the program", program});
  if (!a.log.empty()) read.push_back({"the log", split_map_name(a.log).file.string()});
  if (!a.plan.empty())
    read.push_back({"the plan's summary", (std::filesystem::path(a.plan) / "summary.json").string()});
  if (!a.motion_table.empty() && options.machine.empty()) {
    throw InputError(
        "--motion-table: of the motion of a machine; give --machine FILE, or a plan that was made for one");
  }
  if (!a.motion_table.empty() && learnt) {
    throw InputError(
        "--motion-table: what logs have taught of this plan are times of strokes and no speeds within them; give "
        "--machine FILE for the motion of the machine alone");
  }
  check_output_files({{OutputFile::Kind::Map, "--residual", a.residual},
                      {OutputFile::Kind::Figure, "--png", a.png},
                      {OutputFile::Kind::Figure, "--log-png", a.log_png},
                      {OutputFile::Kind::Table, "--motion-table", a.motion_table},
                      a.json.output()},
                     read);
}

/// ", of it lifted moves 1.9 s, at the plan's maximum feed"; rapids say no time of their own.
std::string lifted_words(const Simulation& s) {
  const double seconds = s.program.rapid_seconds(s.max_feed);
  if (!(seconds > 0.0)) return "";
  return fmt::format(", of it lifted moves {:.2f} s, at {} feed", seconds,
                     s.max_feed ? "the plan's maximum" : "the program's fastest");
}

/// What the machine makes of the program; empty without one.
std::string executed_lines(const Simulation& s) {
  if (!s.executed) return "";
  const ExecutedProgram& e = *s.executed;
  const char* mode = s.program.path_modes.empty()
                         ? ""
                         : "          the program's path mode (G61, G64) comes before the rule for corners\n";
  return machine_lines(e.machine) + mode +
         fmt::format(
             "executed  {} for the run{}, {} of {} take over 1 % longer than commanded; up to {:.4g} mm/s^2\n",
             duration_text(e.run_seconds),
             e.logs > 0 ? fmt::format(" as learnt from {}", counted(static_cast<std::size_t>(e.logs), "log")) : "",
             e.slow_steps, counted(e.removing_steps, "removing step"), e.max_acceleration) +
         (e.lifts.any() ? "          " + lift_words(e.lifts) + "\n" : "") +
         fmt::format(
             "commanded {} and {}, if every move had its speed from end to end; the removals differ by {:.4g} nm "
             "RMS\n",
             in_words(e.commanded.residual), duration_text(e.commanded.run_seconds), e.removal_change);
}

/// Commanded, simulated and recorded motion beside each other; empty without a log.
std::string recorded_lines(const Simulation& s) {
  if (!s.recorded) return "";
  const RecordedRun& r = *s.recorded;
  const auto row = [](const char* name, double rms, double seconds) {
    return fmt::format("          {:<10} {:>12.4g} nm RMS {:>14.3f} s\n", name, rms, seconds);
  };
  std::string text = log_lines(r.log, r.aligned, s.program) +
                     "recorded  beside the program, from the first step that "
                     "removes to the last:\n";
  text +=
      row("commanded", s.executed ? s.executed->commanded.residual.rms : s.after.statistics.rms, r.commanded_seconds);
  if (r.machine_seconds) text += row("machine", s.after.statistics.rms, *r.machine_seconds);
  text += row("recorded", r.residual.rms, r.seconds);
  return text + fmt::format("          the recorded removal differs from that {} by {:.4g} nm RMS\n",
                            r.machine_seconds ? "on the machine" : "as commanded", r.change);
}

std::string simulation_text(const Simulation& s) {
  std::string notes;
  for (const std::string& note : s.program.notes) notes += fmt::format("          {}\n", note);
  std::string origin = s.plan.empty() ? "" : fmt::format("plan      {}\n", s.plan);
  for (const std::string& difference : s.differences) origin += fmt::format("differs   {}\n", difference);
  return origin +
         fmt::format("program   {}: {}, {:.6g} mm with removal, {}{}\n", s.program.file,
                     counted(s.program.steps.size(), "step"), s.program.removing_length(),
                     duration_text(s.program.run_seconds(s.max_feed)), lifted_words(s)) +
         notes + executed_lines(s) + recorded_lines(s) + map_line(s.map.grid, s.before.valid_pixels) +
         tool_lines(tool_sheet(s.tif)) +
         fmt::format("before    {} ({} removed, {})\n", in_words(s.before), to_string(s.terms),
                     counted(s.before.valid_pixels, "pixel")) +
         counted_lines(s.counted) +
         fmt::format("after     {} ({} removed)\n", in_words(s.after.statistics), to_string(s.terms)) +
         exact_lines(s.after) + anatomy_lines(s.anatomy, s.after.statistics) + fmt::format("help      {}\n", s.advice) +
         verdict_lines(s.acceptance);
}

/// Where another map is read with the plan's options of its own map, what is refused about them says whose they are.
InputError with_origin_of_options(const InputError& error, const SimulateArguments& a, const JobOptions& options) {
  const std::vector<const JobOptionRecord*> given = a.job->given();
  const auto is_given = [&given](const std::string& flag) {
    return std::any_of(given.begin(), given.end(), [&flag](const auto* record) { return record->flag == flag; });
  };
  const std::string what = with_option_names(error.what(), flag_of);
  std::string from_plan;
  for (const JobOptionRecord& record : job_option_table()) {
    const std::string flag = "--" + record.flag, value = record.get(options);
    const bool of_map = record.flag.starts_with("map-") && is_given("map");
    const bool of_tif = record.flag.starts_with("tif-") && is_given("tif");
    if (!(of_map || of_tif) || is_given(record.flag) || value.empty() || what.find(flag) == std::string::npos) continue;
    from_plan += fmt::format("{}{} {}", from_plan.empty() ? "" : ", ", flag, value);
  }
  if (a.plan.empty() || from_plan.empty()) return error;
  return InputError(fmt::format("{} ({} is of the plan {}; give the option anew for the file that takes its place)",
                                what, from_plan, a.plan));
}

Simulation simulated(const SimulateArguments& a, const SimulationRequest& request, const GcodeReading& reading,
                     const Progress& progress) {
  try {
    return simulate_file(request.program, reading, request.options, progress, a.exact, request.source,
                         !a.motion_table.empty());
  } catch (const InputError& error) {
    throw with_origin_of_options(error, a, request.options);
  }
}

int run_simulate(const SimulateArguments& arguments) {
  GcodeReading reading;
  const SimulateArguments& a = arguments;
  if (!a.gcode.empty()) reading.dialect = of_option("--gcode", [&a] { return parse_gcode_dialect(a.gcode); });
  if (!a.g4.empty()) reading.halts = of_option("--g4", [&a] { return parse_halt_unit(a.g4); });
  if (!a.start.empty()) reading.start = of_option("--start", [&a] { return parse_point(a.start); });
  const SimulationRequest request = request_of(arguments);
  reading.layout = request.layout;
  check_outputs(arguments, request.options, request.program, request.source.learnt.has_value());
  const Progress progress = terminal_progress();
  const Simulation s = simulated(arguments, request, reading, progress);
  progress.step("writing");
  PendingFiles files;
  files.add_map(arguments.residual, s.shown());
  files.add(arguments.png, [&] {
    const std::string title =
        fmt::format("After {}: {} ({} removed)", s.program.file, in_words(s.after.statistics), to_string(s.terms));
    return map_picture(s.shown(), {title, "nm", true, {}, {}, &s.after.surface}, figure_format_of_file(arguments.png));
  });
  files.add(arguments.log_png, [&] {
    return recorded_picture(*s.recorded,
                            fmt::format("Run of {} as {} recorded it", s.program.file, s.recorded->log.file),
                            figure_format_of_file(arguments.log_png));
  });
  files.add(arguments.motion_table,
            [&] { return motion_table_text(s.nodes, s.program.file, s.executed->machine.name, progress); });
  files.write();
  finish_progress();
  arguments.json.deliver(simulation_json(s), simulation_text(s));
  return say_limits(s.limits);
}

}  // namespace

void add_simulate_command(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("simulate", "predict the surface that a feed table or G-code program leaves");
  auto arguments = std::make_shared<SimulateArguments>();
  const std::vector<std::string> flags{
      "map",          "map-pixel",       "map-unit",     "wavelength",     "wave-scale", "map-origin",
      "map-no-data",  "map-max-pv",      "map-table",    "map-rows",       "map-grid",   "map-steps",
      "line-profile", "profile-columns", "profile-unit", "profile-remove", "line-width", "max-pixels",
      "tif",          "tif-pixel",       "tif-no-data",  "tif-table",      "tif-rows",   "tif-grid",
      "tif-unit",     "tif-dwell-time",  "tif-steps",    "tif-pedestal",   "tif-centre", "tif-angle",
      "tif-flip",     "tif-rate",        "tif-width",    "remove",         "aperture",   "clear-aperture",
      "weight",       "removal",         "piston",       "accept",         "machine",    "template",
      "threads"};
  command
      ->add_option("plan", arguments->plan,
                   "folder of a plan: its program, with the map, the removal function and all options that it was made "
                   "with; what is given beside it comes in their place")
      ->type_name("PLAN");
  command->add_option("--program", arguments->program, program_files() + ": a program alone")->type_name("FILE");
  arguments->job = std::make_unique<JobArguments>(*command, flags, false);
  command
      ->add_option("--gcode", arguments->gcode,
                   "what F means in a G93 program that does not say so: g93-per-minute or g93-seconds")
      ->type_name("DIALECT");
  command
      ->add_option("--g4", arguments->g4,
                   "unit of P in G4 of a program that does not say so: s or ms (default: P with a decimal point is in "
                   "seconds, a whole number is refused)")
      ->type_name("UNIT");
  command
      ->add_option("--start", arguments->start,
                   "where an XPS trajectory begins, which is relative, or a PMAC program that does not say so, in mm")
      ->type_name("X,Y");
  command->add_option("--residual", arguments->residual, "write the residual map [nm]: " + written_map_extensions())
      ->type_name("FILE");
  command->add_option("--png", arguments->png, "draw the residual map: .png, .svg or .pdf")->type_name("FILE");
  command
      ->add_option(
          "--log", arguments->log,
          "a controller's log of a run of the program (text, NPY, HDF5): what the recorded motion leaves, beside "
          "what was simulated")
      ->type_name("FILE");
  arguments->log_reading.add_to(*command);
  command
      ->add_option("--log-png", arguments->log_png,
                   "draw where the recorded times differ from the simulated ones, along the path: .png, .svg or .pdf")
      ->type_name("FILE");
  command
      ->add_option("--motion-table", arguments->motion_table,
                   "with a machine: write its motion, a row where its acceleration changes: .csv")
      ->type_name("FILE");
  command->add_flag("--exact", arguments->exact,
                    "integrate the removal function itself at every pixel, not only at as many as the stated figure "
                    "needs: the residual map is then exact everywhere; takes longer");
  command->add_flag("--other-map", arguments->other.map,
                    "the map is meant to be another than the one that the program was made for");
  command->add_flag("--other-tif", arguments->other.tif,
                    "the removal function is meant to be another than the one that the program was made with");
  arguments->json.add_to(*command);
  command->footer(
      "Example:\n  dwell simulate plan/\n  dwell simulate plan/ --map measured_again.csv\n  dwell simulate plan/ --log "
      "run.csv "
      "--machine machine.toml\n  dwell simulate --program "
      "plan/program.nc --map mirror.csv --map-pixel 0.0938 --tif spot.csv "
      "--tif-pixel 0.0938");
  command->callback([arguments, &exit_code] { exit_code = run_simulate(*arguments); });
}

}  // namespace dwell::cli
