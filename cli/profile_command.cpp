#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/json_option.h"
#include "cli/named_option.h"
#include "cli/output_files.h"
#include "cli/progress_line.h"
#include "cli/terminal.h"
#include "runs/reports/profile_report.h"

namespace dwell::cli {
namespace {

struct ProfileArguments {
  std::string file, remove = "piston,tilt", write, png;
  ProfileReadOptions read;
  JsonOption json;
};

int run_profile(const ProfileArguments& a) {
  const ProfileForm form = of_option("--remove", [&a] { return parse_profile_form(a.remove); });
  using Kind = OutputFile::Kind;
  check_output_files({{Kind::Table, "--write", a.write}, a.json.output(), {Kind::Figure, "--png", a.png}},
                     {{"the profile", a.file}});
  const ProfileReport report = read_profile(a.file, a.read, form);
  PendingFiles files;
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
  text("--png", arguments->png, "FILE", "draw slope and height of the rest: .png, .svg or .pdf");
  command->footer(
      "Example:\n  dwell profile nom.dat --columns x,slope --unit mm,-urad --remove "
      "ellipse:p=7500,q=2500,angle=0.6 --png rest.png\n  dwell profile ltp.txt --remove sphere --write rest.csv");
  command->callback([arguments, &exit_code] { exit_code = run_profile(*arguments); });
}

}  // namespace dwell::cli
