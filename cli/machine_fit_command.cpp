#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/json_option.h"
#include "cli/log_arguments.h"
#include "cli/named_option.h"
#include "cli/output_files.h"
#include "cli/progress_line.h"
#include "cli/terminal.h"
#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "core/formats/map_name.h"
#include "runs/base/inputs_json.h"
#include "runs/base/json_blocks.h"
#include "runs/logs/log_alignment.h"
#include "runs/logs/log_file.h"
#include "runs/logs/machine_fit.h"
#include "runs/machine/machine_file.h"
#include "runs/programs/program_reader.h"
#include "runs/programs/shipped_templates.h"
#include "runs/reports/log_report.h"
#include "runs/reports/machine_report.h"

namespace dwell::cli {
namespace {

struct FitArguments {
  std::string log, program, machine, out, gcode, g4, layout;
  LogArguments reading;
  JsonOption json;
};

GcodeReading program_reading(const FitArguments& a, const Machine& start) {
  GcodeReading reading;
  reading.letters = start.letters;
  if (!a.gcode.empty()) reading.dialect = of_option("--gcode", [&a] { return parse_gcode_dialect(a.gcode); });
  if (!a.layout.empty()) reading.layout = of_option("--template", [&a] { return find_program_template(a.layout); });
  if (!a.g4.empty()) reading.halts = of_option("--g4", [&a] { return parse_halt_unit(a.g4); });
  return reading;
}

std::string fit_json(const FitArguments& a, const std::string& log_file, const MotionLog& log,
                     const AlignedLog& aligned, const MachineFit& fit, const NamedMachine& machine) {
  nlohmann::ordered_json json = json_of_command("machine fit");
  json["log"] = log_block(log, aligned);
  json["fit"] = fit_block(fit);
  json["machine"] = machine_block(machine);
  std::vector<InputFile> inputs{{"log", a.log, sha256_of_file(log_file)},
                                {"program", a.program, sha256_of_file(a.program)}};
  if (!a.machine.empty()) inputs.push_back({"machine", a.machine, sha256_of_file(a.machine)});
  json["inputs"] = inputs_json(inputs);
  return json_text(std::move(json));
}

int run_fit(const FitArguments& a) {
  if (a.log.empty()) throw InputError("LOG: required, a controller's record of time and places");
  if (a.program.empty()) throw InputError("--program: required, the program that the log is of");
  const std::string log_file = split_map_name(a.log).file.string();
  check_output_files({{OutputFile::Kind::Machine, "--out", a.out}, a.json.output()},
                     {{"the log", log_file}, {"the program", a.program}, {"the machine", a.machine}});
  const Progress progress = terminal_progress();
  const NamedMachine start = a.machine.empty()
                                 ? NamedMachine{"fitted to " + std::filesystem::path(log_file).filename().string(), {}}
                                 : read_machine_file(a.machine);
  progress.step("read: log and program");
  const MotionLog log = read_motion_log(a.log, a.reading.reading(), progress);
  const Program program = read_program(a.program, program_reading(a, start.machine), progress);
  progress.step("align the log");
  const AlignedLog aligned = align_log(log, program, a.reading.tolerance(), progress);
  const MachineFit fit = fit_machine(aligned, program, start.machine, progress.of_part("fit"));
  const NamedMachine machine{start.name, fit.machine};
  PendingFiles files;
  files.add(a.out, [&] { return fitted_machine_text(fit, start.name, a.log); });
  files.write();
  finish_progress();
  const std::string written = a.out.empty() ? "" : fmt::format("written   {}\n", a.out);
  a.json.deliver(fit_json(a, log_file, log, aligned, fit, machine),
                 log_lines(log, aligned, program) + fit_lines(fit, machine) + written);
  return kDone;
}

}  // namespace

void add_machine_fit_command(CLI::App& machine, int& exit_code) {
  CLI::App* command = machine.add_subcommand("fit", "learn a machine from a controller's log of a program's run");
  auto arguments = std::make_shared<FitArguments>();
  command
      ->add_option("log", arguments->log,
                   "the controller's log, columns of time and places: text, an NPY array, or an HDF5 data set "
                   "(FILE.h5:/path)")
      ->type_name("LOG");
  command->add_option("--program", arguments->program, "the program that ran (program.nc or feed.csv of a plan)")
      ->type_name("FILE");
  command
      ->add_option("--machine", arguments->machine,
                   "machine file to begin with: what the log does not determine stays as it says (default: no limits, "
                   "exact stops)")
      ->type_name("FILE");
  command->add_option("--out", arguments->out, "write the machine file: .toml")->type_name("FILE");
  arguments->reading.add_to(*command);
  command
      ->add_option("--gcode", arguments->gcode,
                   "what F means in a G93 program that does not say so: g93-per-minute or g93-seconds")
      ->type_name("DIALECT");
  command->add_option("--g4", arguments->g4, "unit of P in G4 of a program that does not say so: s or ms")
      ->type_name("UNIT");
  command
      ->add_option("--template", arguments->layout,
                   "template by which the program is read: a file (docs/formats.md), or " + shipped_template_names())
      ->type_name("FILE");
  arguments->json.add_to(*command);
  command->footer(
      "Example:\n  dwell machine fit run.csv --program plan/program.nc --out machine.toml\n  dwell machine fit "
      "sampler.txt --log-columns 1:samples,2:mm,3:mm --log-period 0.001 --program plan/program.nc");
  command->callback([arguments, &exit_code] { exit_code = run_fit(*arguments); });
}

}  // namespace dwell::cli
