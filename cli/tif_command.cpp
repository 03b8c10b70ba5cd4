#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/json_option.h"
#include "cli/number_option.h"
#include "cli/output_files.h"
#include "cli/progress_line.h"
#include "cli/terminal.h"
#include "core/base/errors.h"
#include "core/formats/map_formats.h"
#include "runs/reports/tif_picture.h"
#include "runs/reports/tif_report.h"
#include "runs/reports/tif_run.h"

namespace dwell::cli {
namespace {

struct TifArguments {
  std::unique_ptr<JobArguments> options;
  TifJob job;
  JsonOption json;
  std::string tif, write, png, section_png, fit_png, mtf_png;
};

void check_outputs(const TifArguments& a, const JobOptions& options) {
  std::vector<ReadFile> read = a.options->files_read(options);
  read.insert(read.end(), {{"the map of --spot", a.job.spot},
                           {"the map of --trench", a.job.trench},
                           {"the map of --before", a.job.before}});
  using Kind = OutputFile::Kind;
  check_output_files({{Kind::Map, "--write", a.write},
                      a.json.output(),
                      {Kind::Figure, "--png", a.png},
                      {Kind::Figure, "--section-png", a.section_png},
                      {Kind::Figure, "--fit-png", a.fit_png},
                      {Kind::Figure, "--mtf-png", a.mtf_png}},
                     read);
}

int run_tif(const TifArguments& arguments) {
  TifJob job = arguments.job;
  job.job = arguments.options->options();
  job.job.tif = arguments.tif;
  if (!arguments.fit_png.empty() && job.fits.empty()) throw InputError("--fit-png: needs --fit");
  check_outputs(arguments, job.job);
  const Progress progress = terminal_progress();
  const TifResult result = make_tif(job, progress);
  progress.step("writing");
  PendingFiles files;
  files.add_map(arguments.write, result.rates);
  files.add(arguments.png, [&] { return tif_picture(result, figure_format_of_file(arguments.png)); });
  files.add(arguments.section_png,
            [&] { return section_picture(result, figure_format_of_file(arguments.section_png)); });
  files.add(arguments.fit_png, [&] { return fit_picture(result, figure_format_of_file(arguments.fit_png)); });
  files.add(arguments.mtf_png, [&] { return transfer_picture(result, figure_format_of_file(arguments.mtf_png)); });
  files.write();
  finish_progress();
  arguments.json.deliver(tif_json(result), tif_text(result));
  return say_limits(unfinished_fits(result));
}

void add_inputs(CLI::App& command, TifArguments& arguments) {
  TifJob& job = arguments.job;
  command
      .add_option("tif", arguments.tif, "a removal function to look at: file of rates [nm/s], or a model with its keys")
      ->type_name("TIF");
  command.add_option("--spot", job.spot, "map of the part after the tool stood on it at one place or several")
      ->type_name("FILE");
  command.add_option("--trench", job.trench, "map of the part after the tool ran straight through it")
      ->type_name("FILE");
  command.add_option("--before", job.before, "map before, on the same grid (default: it was flat around the spots)")
      ->type_name("FILE");
  constexpr ValueRange kCut{0.0, 0.5, ""}, kSigmas{0.0, 1e3, ""};
  add_number(command, "--dwell-time", job.dwell_time_s, ranges::kTime, "time that the tool stood on each spot in s")
      ->type_name("S");
  add_number(command, "--feed", job.feed_mm_per_min, ranges::kFeed, "speed along the trench in mm/min")
      ->type_name("MM/MIN");
  add_number(command, "--direction", job.direction_deg, ranges::kAngle,
             "direction of the trench in degrees, counter-clockwise from +x (default: as fitted; a given one must "
             "agree)")
      ->type_name("DEG");
  command.add_option("--at", job.at, "where a spot is in mm; once for each (default: all that are found)")
      ->type_name("X,Y")
      ->expected(1)
      ->take_all();
  add_number(command, "--radius", job.radius_mm, ranges::kSize,
             "how far a spot or trench reaches in mm (default: found)")
      ->type_name("MM");
  add_number(command, "--noise-cut", job.noise_cut, kCut,
             "share of the peak below which a rate is set to 0 (default 0.01, trench 0)")
      ->type_name("SHARE");
  add_number(command, "--noise-sigmas", job.noise_sigmas, kSigmas,
             "the same in standard deviations of the surroundings (default 0)")
      ->type_name("N");
  command
      .add_option("--centre", job.centre,
                  "tool axis in the spot: centroid, peak, or at (as given by --at); default centroid")
      ->type_name("WHERE");
  command.add_option("--baseline", job.baseline, "what is taken off: plane, constant or none; default plane")
      ->type_name("HOW");
  command
      .add_option("--register", job.registration,
                  "how several spots are aligned: least-squares or centroid; default least-squares")
      ->type_name("HOW");
}

void add_outputs(CLI::App& command, TifArguments& arguments) {
  command
      .add_option(
          "--fit", arguments.job.fits,
          "models to fit: names separated by commas, all, or one with parameters to hold, as planetary:ratio=-1; "
          "may be repeated")
      ->type_name("MODELS")
      ->expected(1)
      ->take_all();
  command.add_flag("--robust", arguments.job.robust, "outliers count less in the fits");
  command
      .add_option("--write", arguments.write,
                  "write the rates in nm/s, the tool axis at (0, 0) mm: " + written_map_extensions())
      ->type_name("FILE");
  arguments.json.add_to(command);
  command.add_option("--png", arguments.png, "draw the removal function: .png, .svg or .pdf, as the others")
      ->type_name("FILE");
  command.add_option("--section-png", arguments.section_png, "draw cross sections along x and y, with the best fits")
      ->type_name("FILE");
  command.add_option("--fit-png", arguments.fit_png, "draw measured, best fit and residual")->type_name("FILE");
  command.add_option("--mtf-png", arguments.mtf_png, "draw the transfer function against wavelength")
      ->type_name("FILE");
}

}  // namespace

void add_tif_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "tif", "removal function (TIF) from measured spots or a trench; its properties, model fits and pictures");
  auto arguments = std::make_shared<TifArguments>();
  add_inputs(*command, *arguments);
  add_outputs(*command, *arguments);
  const std::vector<std::string> flags{
      "map-pixel", "map-unit", "wavelength", "wave-scale",   "map-origin", "map-no-data", "map-max-pv", "map-table",
      "map-rows",  "map-grid", "map-steps",  "max-pixels",   "tif-pixel",  "tif-no-data", "tif-table",  "tif-rows",
      "tif-grid",  "tif-unit", "tif-steps",  "tif-pedestal", "tif-centre", "tif-angle",   "tif-flip",   "threads"};
  arguments->options = std::make_unique<JobArguments>(*command, flags, false);
  command->footer(
      "Example:\n"
      "  dwell tif --spot after.csv --before before.csv --map-pixel 0.1 --dwell-time 5 --fit gaussian,super-gaussian "
      "--write tif.csv\n"
      "  dwell plan --map part.csv --tif tif.csv --path raster:pitch=1 --out plan\n"
      "  dwell tif planetary:radius=5,eccentricity=0.8,ratio=-1,peak=20 --mtf-png mtf.png");
  command->callback([arguments, &exit_code] { exit_code = run_tif(*arguments); });
}

}  // namespace dwell::cli
