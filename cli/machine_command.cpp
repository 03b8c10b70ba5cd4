#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/json_option.h"
#include "cli/standard_streams.h"
#include "cli/terminal.h"
#include "core/base/errors.h"
#include "runs/machine/machine_file.h"
#include "runs/reports/machine_report.h"

namespace dwell::cli {
namespace {

struct MachineArguments {
  std::string file;
  bool example = false;
  JsonOption json;
};

int run_machine(const MachineArguments& a) {
  if (a.example == !a.file.empty())
    throw InputError(a.example ? "--example: prints a file to begin with; give it or a MACHINE file"
                               : "MACHINE: required, or --example for a file to begin with");
  if (a.example) {
    if (a.json.printed() || !a.json.file().empty()) throw InputError("--json: of a MACHINE file, not of --example");
    print(machine_text(example_machine()));
    return kDone;
  }
  a.json.check({{"the machine", a.file}}, "");
  const NamedMachine machine = read_machine_file(a.file);
  a.json.deliver(machine_json(machine, a.file), machine_lines(machine));
  return kDone;
}

}  // namespace

void add_machine_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("machine",
                                             "what a machine can do: check its file, begin one, or learn one "
                                             "from a controller's log (fit)");
  auto arguments = std::make_shared<MachineArguments>();
  command->add_option("machine", arguments->file, "machine file (docs/motion.md)")->type_name("MACHINE");
  command->add_flag("--example", arguments->example, "print a machine file with comments to begin with");
  arguments->json.add_to(*command);
  command->footer(
      "Example:\n  dwell machine --example\n  dwell machine machine.toml\n  dwell machine fit run.csv --program "
      "plan/program.nc --out fitted.toml\n  dwell simulate plan/ --machine machine.toml");
  add_machine_fit_command(*command, exit_code);
  command->callback([arguments, command, &exit_code] {
    if (command->get_subcommands().empty()) exit_code = run_machine(*arguments);
  });
}

}  // namespace dwell::cli
