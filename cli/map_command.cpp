#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/terminal.h"
#include "core/aperture.h"
#include "core/map_formats.h"
#include "core/map_io.h"
#include "core/map_statistics.h"
#include "core/whole_file.h"
#include "runs/height_image.h"
#include "runs/input_files.h"
#include "runs/picture.h"

namespace dwell::cli {
namespace {

struct MapArguments {
  std::unique_ptr<JobArguments> job;
  std::string file, write, write_image, png;
};

int run_map(const MapArguments& arguments) {
  JobOptions options = arguments.job->options();
  options.map = arguments.file;
  std::vector<InputFile> inputs;
  const HeightMap map = within(load_map(options, inputs), parse_aperture(options.aperture));
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
  if (!arguments.write.empty()) write_map(arguments.write, map);
  if (!arguments.write_image.empty()) write_whole_file(arguments.write_image, height_image_png(map));
  if (!arguments.png.empty()) {
    const std::string title = fmt::format("{}: RMS {:.4g} nm, PV {:.4g} nm ({} removed)", inputs[0].file,
                                          statistics.rms, statistics.pv, to_string(terms));
    write_whole_file(arguments.png, map_picture(without_form(map, terms), {title, "nm", true, {}, {}}));
  }
  return kDone;
}

}  // namespace

void add_map_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("map", "print size, pitch, PV and RMS of a map; convert or draw it");
  auto arguments = std::make_shared<MapArguments>();
  command->add_option("file", arguments->file, "a file in any map format, or run.h5:/path/in/it")
      ->type_name("FILE")
      ->required();
  const std::vector<std::string> flags{"map-pixel", "map-unit", "map-origin", "remove", "aperture"};
  arguments->job = std::make_unique<JobArguments>(*command, flags, false);
  command->add_option("--write", arguments->write, "write the map as measured [nm]: " + written_map_extensions())
      ->type_name("FILE");
  command->add_option("--write-image", arguments->write_image, "write the map as a 16-bit grey PNG, levels = heights")
      ->type_name("FILE.png");
  command->add_option("--png", arguments->png, "draw the map, form terms removed")->type_name("FILE");
  command->footer("Example:\n  dwell map mirror.csv --map-pixel 0.0938 --remove piston,tilt --png mirror.png");
  command->callback([arguments, &exit_code] { exit_code = run_map(*arguments); });
}

}  // namespace dwell::cli
