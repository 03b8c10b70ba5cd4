#include "runs/machine/machine_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>

#include "core/base/errors.h"
#include "core/base/version.h"
#include "core/base/whole_file.h"
#include "runs/machine/machine_table.h"

namespace dwell {
namespace {

/// "key = value  # about", a comment where there is no limit.
std::string line_of(const MachineField& field, const Machine& machine) {
  const std::string value = field_text(field, machine);
  if (value.empty()) return fmt::format("# {} =  # {}; not given: no limit\n", field.key, field.about);
  return fmt::format("{} = {}  # {}\n", field.key, value, field.about);
}

}  // namespace

NamedMachine parse_machine(const std::string& text, const std::string& file) {
  try {
    return machine_of_table(toml::parse(text, file), file);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: line {}: {}", file, error.source().begin.line, std::string(error.description())));
  }
}

NamedMachine read_machine_file(const std::filesystem::path& file) {
  return parse_machine(read_whole_file(file), file.string());
}

std::string machine_text(const NamedMachine& machine) {
  std::ostringstream name;
  name << toml::value<std::string>(machine.name);
  std::string text = fmt::format(
      "# Machine file of dwell {}: dwell plan --machine THIS.toml, dwell simulate --machine THIS.toml\n"
      "# What is left out has no limit.\n\nschema = 1\nname = {}\n",
      version(), name.str());
  std::string section;
  for (const MachineField& field : machine_fields()) {
    if (field.section != section) {
      section = field.section;
      text += fmt::format("\n[{}]\n", section);
      if (section == "x" || section == "y") {
        const AxisLetters& letters = machine.machine.letters;
        text += fmt::format("letter = \"{}\"  # of this axis in programs\n", section == "x" ? letters.x : letters.y);
      }
      if (section == "corner") {
        text += fmt::format(
            "rule = \"{}\"  # exact-stop, junction-deviation, free or blend\n"
            "arcs = \"{}\"  # of the rule blend: largest that the tolerance allows, or as-needed by the feeds "
            "(LinuxCNC)\n",
            to_string(machine.machine.corner), to_string(machine.machine.blend_size));
      }
    }
    text += line_of(field, machine.machine);
  }
  return text;
}

NamedMachine example_machine() {
  NamedMachine named{"an example, no product", {}};
  Machine& m = named.machine;
  m.max_feed = 50.0;
  m.path_acceleration = 500.0;
  m.x = {-150.0, 150.0, 50.0, 500.0};
  m.y = {-150.0, 150.0, 50.0, 500.0};
  m.corner = CornerRule::ExactStop;
  m.lift = {0.5, 0.5, 0.1};
  return named;
}

}  // namespace dwell
