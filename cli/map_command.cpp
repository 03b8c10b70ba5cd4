#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/json_option.h"
#include "cli/named_option.h"
#include "cli/output_files.h"
#include "cli/progress_line.h"
#include "cli/standard_streams.h"
#include "cli/terminal.h"
#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/threads.h"
#include "core/formats/map_formats.h"
#include "core/map/aperture.h"
#include "runs/drawing/height_image.h"
#include "runs/drawing/picture.h"
#include "runs/job/input_files.h"
#include "runs/map_steps/map_steps.h"
#include "runs/reports/map_profile.h"
#include "runs/reports/map_report.h"

namespace dwell::cli {
namespace {

struct MapArguments {
  std::unique_ptr<JobArguments> job;
  std::string file, write, write_image, png;
  std::vector<std::string> steps;
  std::string remove = "piston,tilt", form, window = "hann", bands = "33,0.12", limit, accept, psd_png, profile,
              profile_png;
  JsonOption json;
  bool psd = false;
};

/// What the report of the map shall hold.
MapReportOptions report_options(const MapArguments& arguments, const CLI::App& command, int threads) {
  MapReportOptions options;
  const MapArguments& a = arguments;
  options.removed = of_option("--remove", [&a] { return parse_polynomial_spec(a.remove); });
  if (!a.form.empty()) options.form = of_option("--form", [&a] { return parse_polynomial_spec(a.form); });
  options.window = of_option("--window", [&a] { return parse_spectral_window(a.window); });
  options.band_edges = of_option("--bands", [&a] { return parse_band_edges(a.bands); });
  if (!a.limit.empty()) options.limit = of_option("--limit", [&a] { return parse_psd_limit(a.limit); });
  if (!a.accept.empty()) {
    options.accept = of_option("--accept", [&] { return parse_surface_limits(a.accept, options.band_edges); });
  }
  const bool asked = command.count("--bands") + command.count("--limit") + command.count("--window") > 0;
  options.spectrum = arguments.psd || asked || !arguments.psd_png.empty();
  if (!arguments.profile_png.empty() && arguments.profile.empty()) {
    throw InputError("--profile-png needs --profile, the line to draw");
  }
  options.threads = threads;
  return options;
}

/// A picture's title names the file, not its folder.
std::string name_of(const std::string& file) { return std::filesystem::path(file).filename().string(); }

/// The steps of --map-steps, then those of --step.
void add_steps(JobOptions& options, const MapArguments& arguments) {
  for (const std::string& step : arguments.steps) {
    if (parse_map_steps(step).empty())
      throw InputError(fmt::format("--step '{}': empty; --steps lists what is accepted", step));
    options.map_steps += (options.map_steps.empty() ? "" : ";") + step;
  }
}

void check_outputs(const MapArguments& a, const JobOptions& options) {
  using Kind = OutputFile::Kind;
  check_output_files({{Kind::Map, "--write", a.write},
                      {Kind::Png, "--write-image", a.write_image},
                      a.json.output(),
                      {Kind::Figure, "--png", a.png},
                      {Kind::Figure, "--psd-png", a.psd_png},
                      {Kind::Figure, "--profile-png", a.profile_png}},
                     a.job->files_read(options));
}

/// The map as read and prepared by the steps, within the aperture; `valid_pixels` are those before the aperture.
HeightMap prepared_map(const JobOptions& options, std::vector<InputFile>& inputs, Index& valid_pixels,
                       const Progress& progress) {
  HeightMap whole = load_map(options, inputs, progress);
  valid_pixels = whole.valid_pixels();
  HeightMap map = within(std::move(whole), options.aperture, progress);
  if (options.aperture.kind != Aperture::Kind::Map) map.history.push_back("aperture " + to_string(options.aperture));
  return map;
}

std::string told(const HeightMap& map, const MapReport& report, const std::optional<MapProfile>& profile,
                 const InputFile& input) {
  const Grid& g = map.grid;
  std::string text = fmt::format("file      {} (sha256 {})\n", input.file, input.sha256);
  text += fmt::format("size      {} (y) x {} columns (x), {:.6g} mm in x, {:.6g} mm in y\n", counted(g.rows, "row"),
                      g.cols, g.width(), g.height());
  text += fmt::format("pitch     {:.9g} mm in x, {:.9g} mm in y\n", g.pitch_x, g.pitch_y);
  text += fmt::format("origin    first pixel at ({:.9g}, {:.9g}) mm\n", g.origin.x, g.origin.y);
  text += fmt::format("valid     {} of {} pixels\n", report.statistics.valid_pixels, g.size());
  text += map_report_text(report);
  for (const std::string& step : map.history) text += fmt::format("made      {}\n", step);
  if (profile) {
    text += fmt::format("profile   {}: PV {:.6g} nm, RMS {:.6g} nm about its mean\n", profile->name, profile->pv(),
                        profile->rms());
  }
  return text;
}

/// All pictures and texts, made before the first file is written.
PendingFiles files_of(const MapArguments& a, const HeightMap& map, const MapReport& report,
                      const std::optional<MapProfile>& profile) {
  const std::string removed = to_string(report.removed);
  const std::string title = fmt::format("{}: {} ({} removed)", name_of(a.file), in_words(report.statistics), removed);
  PendingFiles files;
  files.add_map(a.write, map);
  files.add(a.write_image, [&] { return height_image_png(map); });
  files.add(a.png, [&] {
    return map_picture(report.figure, {title, "nm", true, {}, {}}, figure_format_of_file(a.png));
  });
  files.add(a.psd_png, [&] { return psd_picture(report, title, figure_format_of_file(a.psd_png)); });
  files.add(a.profile_png, [&] {
    return profile_picture(*profile,
                           fmt::format("{}, {}: RMS {:.4g} nm, PV {:.4g} nm ({} removed)", name_of(a.file),
                                       profile->name, profile->rms(), profile->pv(), removed),
                           figure_format_of_file(a.profile_png));
  });
  return files;
}

int run_map(const MapArguments& arguments, const CLI::App& command) {
  JobOptions options = arguments.job->options();
  options.map = arguments.file;
  const MapReportOptions wanted = report_options(arguments, command, thread_count(options.threads));
  std::optional<ProfileSpec> line;
  if (!arguments.profile.empty())
    line = of_option("--profile", [&arguments] { return parse_profile_spec(arguments.profile); });
  add_steps(options, arguments);
  check_outputs(arguments, options);
  std::vector<InputFile> inputs;
  Index valid_pixels = 0;
  const Progress progress = terminal_progress();
  const HeightMap map = prepared_map(options, inputs, valid_pixels, progress);
  const MapReport report = map_report(map, wanted, progress);
  std::optional<MapProfile> profile;
  if (line) profile = map_profile(report.figure, *line);
  const std::string text = told(map, report, profile, inputs[0]);
  const std::string json =
      map_report_json(report, map_figures(report, options.map, map, valid_pixels, to_string(options.aperture)), inputs,
                      profile ? &*profile : nullptr);
  progress.step("writing");
  files_of(arguments, map, report, profile).write();
  finish_progress();
  arguments.json.deliver(json, text);
  return say_limits(report.broken_limits());
}

/// The figures of a map besides its size.
void add_report_options(CLI::App& command, MapArguments& arguments) {
  const auto text = [&command](const char* flag, std::string& value, const char* type, const char* help) {
    command.add_option(flag, value, help)->type_name(type)->expected(1);
  };
  text("--remove", arguments.remove, "FORM",
       "form that does not count: piston,tilt,power,astigmatism or none; zernike-noll:1-36, zernike-fringe:1-37 or "
       "zernike-ansi:0-35 [,x=MM,y=MM][,radius=MM][,obscuration=RATIO]; legendre:4 or chebyshev:4 (total degree), "
       "legendre:4x3 (along x and y) (default piston,tilt)");
  text("--form", arguments.form, "FORM", "list the coefficients of such polynomials [nm]");
  command.add_flag("--psd", arguments.psd, "power spectra along x, along y and radial; RMS in bands of wavelength");
  text("--window", arguments.window, "WINDOW", "of the spectra: hann, tukey:R or none (default hann)");
  text("--bands", arguments.bands, "MM,MM", "wavelengths between the bands in mm (default 33,0.12)");
  text("--limit", arguments.limit, "A,B",
       "line A f^-B that the spectra along x and y must not exceed, A in nm^2 mm, f in 1/mm; radial:A,B in nm^2 mm^2 "
       "for "
       "the radial one");
  text(
      "--accept", arguments.accept, "LIMITS",
      "limits that the map, form removed, is judged by, as rms<=1,pv<=10nm,slope<=0.2urad, of rms, pv, pvr, slope, mid "
      "(the middle of --bands) and band(A..Bmm): exit code 3 where one is not met");
  text("--profile", arguments.profile, "LINE", "y=MM (along x), x=MM (along y) or X0,Y0,X1,Y1 in mm");
  arguments.json.add_to(command);
  text("--psd-png", arguments.psd_png, "FILE", "draw the spectra: .png, .svg or .pdf");
  text("--profile-png", arguments.profile_png, "FILE", "draw the profile, form removed: .png, .svg or .pdf");
}

void add_step_options(CLI::App& command, MapArguments& arguments) {
  command
      .add_option("--step", arguments.steps,
                  "prepare the map: a step of --steps; may be given often, done in the order given")
      ->type_name("NAME[:ARGS]")
      ->allow_extra_args(false);
  command.add_flag_callback(
      "--steps",
      [] {
        print(map_steps_help());
        throw CLI::Success();
      },
      "list the steps with their arguments, units and examples, and stop");
}

}  // namespace

void add_map_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "map", "print size, pitch, statistics, form and spectra of a map; prepare, convert or draw it");
  auto arguments = std::make_shared<MapArguments>();
  command->add_option("file", arguments->file, "a file in any map format, or run.h5:/path/in/it")
      ->type_name("FILE")
      ->required();
  const std::vector<std::string> flags{"map-pixel",   "map-unit",   "wavelength", "wave-scale", "map-origin",
                                       "map-no-data", "map-max-pv", "map-table",  "map-rows",   "map-grid",
                                       "map-steps",   "max-pixels", "aperture",   "threads"};
  arguments->job = std::make_unique<JobArguments>(*command, flags, false);
  add_report_options(*command, *arguments);
  command->add_option("--write", arguments->write, "write the map after all steps [nm]: " + written_map_extensions())
      ->type_name("FILE");
  add_step_options(*command, *arguments);
  command->add_option("--write-image", arguments->write_image, "write the map as a 16-bit grey PNG, levels = heights")
      ->type_name("FILE.png");
  command->add_option("--png", arguments->png, "draw the map, form removed: .png, .svg or .pdf")->type_name("FILE");
  command->footer(
      "Example:\n  dwell map mirror.csv --map-pixel 0.0938 --remove piston,tilt --png mirror.png\n"
      "  dwell map mirror.csv --map-pixel 0.0938 --step crop:data --form zernike-noll:1-15 --psd-png spectra.png");
  command->callback([arguments, command, &exit_code] { exit_code = run_map(*arguments, *command); });
}

}  // namespace dwell::cli
