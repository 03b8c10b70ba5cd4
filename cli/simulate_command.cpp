#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/json_option.h"
#include "cli/output_files.h"
#include "cli/progress_line.h"
#include "cli/terminal.h"
#include "core/base/duration_text.h"
#include "core/formats/map_formats.h"
#include "runs/drawing/picture.h"
#include "runs/programs/program_formats.h"
#include "runs/reports/exact_lines.h"
#include "runs/reports/simulation.h"
#include "runs/reports/tool_sheet.h"

namespace dwell::cli {
namespace {

struct SimulateArguments {
  std::unique_ptr<JobArguments> job;
  std::string program, gcode, g4, residual, png;
  JsonOption json;
  bool exact = false;
};

void check_outputs(const SimulateArguments& a, const JobOptions& options) {
  std::vector<ReadFile> read = a.job->files_read(options);
  read.push_back({"the program", a.program});
  check_output_files(
      {{OutputFile::Kind::Map, "--residual", a.residual}, {OutputFile::Kind::Figure, "--png", a.png}, a.json.output()},
      read);
}

std::string simulation_text(const Simulation& s) {
  std::string notes;
  for (const std::string& note : s.program.notes) notes += fmt::format("          {}\n", note);
  return fmt::format("program   {}: {} steps, {:.6g} mm with removal, {}\n", s.program.file, s.program.steps.size(),
                     s.program.removing_length(), duration_text(s.program.total_seconds())) +
         notes + tool_lines(tool_sheet(s.tif)) +
         fmt::format("before    {} ({} removed, {} pixels)\n", in_words(s.before), to_string(s.terms),
                     s.before.valid_pixels) +
         fmt::format("after     {} ({} removed)\n", in_words(s.after.statistics), to_string(s.terms)) +
         exact_lines(s.after);
}

int run_simulate(const SimulateArguments& arguments) {
  GcodeReading reading;
  if (!arguments.gcode.empty()) reading.dialect = parse_gcode_dialect(arguments.gcode);
  if (!arguments.g4.empty()) reading.halts = parse_halt_unit(arguments.g4);
  const JobOptions options = arguments.job->options();
  JobArguments::require(options, {"map", "tif"});
  check_outputs(arguments, options);
  const Progress progress = terminal_progress();
  const Simulation s = simulate_file(arguments.program, reading, options, progress, arguments.exact);
  progress.step("writing");
  PendingFiles files;
  files.add_map(arguments.residual, s.after.surface);
  files.add(arguments.png, [&] {
    const std::string title =
        fmt::format("After {}: {} ({} removed)", s.program.file, in_words(s.after.statistics), to_string(s.terms));
    return map_picture(s.after.surface, {title, "nm", true, {}, {}}, figure_format_of_file(arguments.png));
  });
  files.write();
  finish_progress();
  arguments.json.deliver(simulation_json(s), simulation_text(s));
  return kDone;
}

/// "feed.csv or program.nc".
std::string program_files() {
  std::string names;
  for (const ProgramFormat& format : program_formats()) names += (names.empty() ? "" : " or ") + format.file;
  return names;
}

}  // namespace

void add_simulate_command(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("simulate", "predict the surface that a feed table or G-code program leaves");
  auto arguments = std::make_shared<SimulateArguments>();
  command->add_option("--program", arguments->program, program_files())->type_name("FILE")->required();
  const std::vector<std::string> flags{
      "map",      "map-pixel", "map-unit",       "map-origin", "map-no-data",  "map-max-pv",  "map-table", "map-rows",
      "map-grid", "map-steps", "max-pixels",     "tif",        "tif-pixel",    "tif-no-data", "tif-table", "tif-rows",
      "tif-grid", "tif-unit",  "tif-dwell-time", "tif-steps",  "tif-pedestal", "tif-centre",  "tif-angle", "tif-flip",
      "remove",   "aperture",  "threads"};
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
  command->add_option("--residual", arguments->residual, "write the residual map [nm]: " + written_map_extensions())
      ->type_name("FILE");
  command->add_option("--png", arguments->png, "draw the residual map: .png, .svg or .pdf")->type_name("FILE");
  command->add_flag("--exact", arguments->exact,
                    "integrate the removal function itself at every pixel, not only at as many as the stated figure "
                    "needs: the residual map is then exact everywhere; takes longer");
  arguments->json.add_to(*command);
  command->footer(
      "Example:\n  dwell simulate --program plan/program.nc --map mirror.csv --map-pixel 0.0938 --tif spot.csv "
      "--tif-pixel 0.0938");
  command->callback([arguments, &exit_code] { exit_code = run_simulate(*arguments); });
}

}  // namespace dwell::cli
