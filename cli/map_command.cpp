#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/terminal.h"
#include "core/aperture.h"
#include "core/errors.h"
#include "core/map_io.h"
#include "core/map_statistics.h"
#include "core/whole_file.h"
#include "runs/input_files.h"
#include "runs/map_steps.h"
#include "runs/picture.h"

namespace dwell::cli {
namespace {

struct MapArguments {
  std::unique_ptr<JobArguments> job;
  std::string file, write, png;
  std::vector<std::string> steps;
};

int run_map(const MapArguments& arguments) {
  JobOptions options = arguments.job->options();
  options.map = arguments.file;
  std::vector<InputFile> inputs;
  for (const std::string& step : arguments.steps) {
    if (parse_map_steps(step).empty())
      throw InputError(fmt::format("--step '{}': empty; --steps lists what is accepted", step));
    options.map_steps += (options.map_steps.empty() ? "" : ";") + step;
  }
  HeightMap map = within(load_map(options, inputs, terminal_hooks()), parse_aperture(options.aperture));
  finish_progress();
  if (options.aperture != "map") map.history.push_back(fmt::format("aperture {}", options.aperture));
  const FormTerms terms = parse_form_terms(options.remove);
  const MapStatistics statistics = map_statistics(map, terms);
  const Grid& g = map.grid;
  fmt::print("file      {} (sha256 {})\n", inputs[0].file, inputs[0].sha256);
  fmt::print("size      {} rows (y) x {} columns (x), {:.6g} mm in x, {:.6g} mm in y\n", g.rows, g.cols, g.width(),
             g.height());
  fmt::print("pitch     {:.9g} mm in x, {:.9g} mm in y\n", g.pitch_x, g.pitch_y);
  fmt::print("origin    first pixel at ({:.9g}, {:.9g}) mm\n", g.origin.x, g.origin.y);
  fmt::print("valid     {} of {} pixels\n", statistics.valid_pixels, g.size());
  fmt::print("PV        {:.6g} nm ({} removed)\n", statistics.pv, to_string(terms));
  fmt::print("RMS       {:.6g} nm ({} removed)\n", statistics.rms, to_string(terms));
  for (const std::string& step : map.history) fmt::print("made      {}\n", step);
  if (!arguments.write.empty()) write_map(arguments.write, map);
  if (!arguments.png.empty()) {
    const std::string title = fmt::format("{}: RMS {:.4g} nm, PV {:.4g} nm ({} removed)", inputs[0].file,
                                          statistics.rms, statistics.pv, to_string(terms));
    write_whole_file(arguments.png, map_picture(without_form(map, terms), {title, "nm", true, {}, {}}));
  }
  return kDone;
}

}  // namespace

void add_map_command(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("map", "print size, pitch, PV and RMS of a map; prepare, convert or draw it");
  auto arguments = std::make_shared<MapArguments>();
  command->add_option("file", arguments->file, "matrix CSV/TXT, XYZ or NPY")->type_name("FILE")->required();
  const std::vector<std::string> flags{"map-pixel", "map-unit", "map-origin", "map-steps",
                                       "remove",    "aperture", "threads"};
  arguments->job = std::make_unique<JobArguments>(*command, flags, false);
  command->add_option("--write", arguments->write, "write the map as measured [nm]: .csv, .txt, .xyz or .npy")
      ->type_name("FILE");
  command->add_option("--png", arguments->png, "draw the map, form terms removed")->type_name("FILE");
  command
      ->add_option("--step", arguments->steps,
                   "prepare the map: a step of --steps; may be given often, done in the order given")
      ->type_name("NAME[:ARGS]")
      ->allow_extra_args(false);
  command->add_flag_callback(
      "--steps",
      [] {
        fmt::print("{}", map_steps_help());
        throw CLI::Success();
      },
      "list the steps with their arguments, units and examples, and stop");
  command->footer("Example:\n  dwell map mirror.csv --map-pixel 0.0938 --remove piston,tilt --png mirror.png");
  command->callback([arguments, &exit_code] { exit_code = run_map(*arguments); });
}

}  // namespace dwell::cli
