#include <memory>
#include <optional>
#include <string>

#include "cli/commands.h"
#include "cli/json_option.h"
#include "cli/named_option.h"
#include "cli/number_option.h"
#include "cli/output_files.h"
#include "cli/progress_line.h"
#include "cli/terminal.h"
#include "core/base/errors.h"
#include "core/formats/map_formats.h"
#include "runs/profile/profile_strip.h"
#include "runs/reports/profile_report.h"

namespace dwell::cli {
namespace {

struct ProfileArguments {
  std::string file, remove = "piston,tilt", write, write_map, png;
  std::optional<double> line_width;
  ProfileReadOptions read;
  JsonOption json;
};

int run_profile(const ProfileArguments& a) {
  const ProfileForm form = of_option("--remove", [&a] { return parse_profile_form(a.remove); });
  if (a.line_width && a.write_map.empty()) throw InputError("--line-width: of --write-map, which is not given");
  using Kind = OutputFile::Kind;
  check_output_files({{Kind::Table, "--write", a.write},
                      {Kind::Map, "--write-map", a.write_map},
                      a.json.output(),
                      {Kind::Figure, "--png", a.png}},
                     {{"the profile", a.file}});
  const ProfileInput report = read_profile(a.file, a.read, form);
  std::optional<HeightMap> strip;
  if (!a.write_map.empty()) strip = profile_strip(report, a.line_width.value_or(0.0));
  PendingFiles files;
  if (strip) files.add_map(a.write_map, *strip);
  files.add(a.write, [&report] { return profile_rest_csv(report); });
  files.add(a.png, [&] { return profile_rest_picture(report, figure_format_of_file(a.png)); });
  files.write();
  finish_progress();
  a.json.deliver(profile_json(report), profile_text(report));
  return kDone;
}

}  // namespace

void add_profile_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "profile", "slope and height along a line of a mirror, from a long-trace profiler or NOM, without its ellipse");
  auto arguments = std::make_shared<ProfileArguments>();
  const auto text = [command](const char* flag, std::string& value, const char* type, const char* help) {
    command->add_option(flag, value, help)->type_name(type)->expected(1);
  };
  command->add_option("file", arguments->file, "text with a place and a slope or height on each line")
      ->type_name("FILE")
      ->required();
  text("--columns", arguments->read.columns, "PLACE,VALUE",
       "columns of place and value, by name or by number from 1, as x,slope (default: as the header names them)");
  text("--unit", arguments->read.unit, "PLACE,VALUE",
       "their units, as mm,urad or mm,nm; mm,-urad turns the sign of the values (default: as the header says)");
  text("--remove", arguments->remove, "FORM",
       "form that does not count: none; piston; piston,tilt; polynomial:N; sphere[:radius=MM]; "
       "ellipse:p=MM,q=MM,angle=DEG[,at=MM][,source=low|high][,fit=position|angle|position+angle|none], p and q the "
       "arms to source and image, angle grazing (default piston,tilt)");
  arguments->json.add_to(*command);
  text("--write", arguments->write, "FILE.csv", "write the rest: x [mm], slope [urad] and height [nm]");
  text("--write-map", arguments->write_map, "FILE",
       "write the heights of the rest as a map to plan on, one row of pixels or --line-width wide");
  constexpr ValueRange kWidths{1e-6, 1e6, "mm"};
  add_number(*command, "--line-width", arguments->line_width, kWidths,
             "width of that map in mm, the same height in every row (default: one row)")
      ->type_name("MM");
  text("--png", arguments->png, "FILE", "draw slope and height of the rest: .png, .svg or .pdf");
  command->footer(
      "Example:\n  dwell profile nom.dat --columns x,slope --unit mm,-urad --remove "
      "ellipse:p=7500,q=2500,angle=0.6 --png rest.png\n  dwell profile ltp.txt --remove sphere --write rest.csv");
  command->callback([arguments, &exit_code] { exit_code = run_profile(*arguments); });
}

}  // namespace dwell::cli
