#include "runs/machine/machine_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "core/base/whole_file.h"

namespace dwell {
namespace {

constexpr double kPerMinute = units::mm_per_s(1.0);
constexpr double kAny = -std::numeric_limits<double>::infinity();
constexpr std::array<CornerRule, 3> kRules{CornerRule::ExactStop, CornerRule::JunctionDeviation, CornerRule::Free};

using Access = double& (*)(Machine&);

void add_axis(std::vector<MachineField>& fields, const char* section, const char* words, std::array<Access, 4> access) {
  fields.push_back({section, "lowest_mm", fmt::format("end of the travel {}", words), kAny, false, access[0], 1.0});
  fields.push_back({section, "highest_mm", "the other end", kAny, false, access[1], 1.0});
  fields.push_back({section, "max_speed_mm_per_s", "of this axis alone", 0.0, true, access[2], 1.0});
  fields.push_back({section, "max_acceleration_mm_per_s2", "of this axis alone", 0.0, true, access[3], 1.0});
}

std::vector<MachineField> make_fields() {
  std::vector<MachineField> fields{{"", "max_feed_mm_per_min", "along the path, for feed moves and rapids", 0.0, true,
                                    [](Machine& m) -> double& { return m.max_feed; }, kPerMinute},
                                   {"", "min_feed_mm_per_min", "along the path", 0.0, false,
                                    [](Machine& m) -> double& { return m.min_feed; }, kPerMinute},
                                   {"", "path_acceleration_mm_per_s2", "along the path", 0.0, true,
                                    [](Machine& m) -> double& { return m.path_acceleration; }, 1.0},
                                   {"corner", "junction_deviation_mm", "for the rule junction-deviation", 0.0, true,
                                    [](Machine& m) -> double& { return m.junction_deviation; }, 1.0},
                                   {"corner", "delay_s", "at rest at each exact stop", 0.0, false,
                                    [](Machine& m) -> double& { return m.corner_delay; }, 1.0},
                                   {"lift", "up_s", "rest with the tool up when it is lifted, beside its way up", 0.0,
                                    false, [](Machine& m) -> double& { return m.lift.lift; }, 1.0},
                                   {"lift", "down_s", "rest with the tool up when it is lowered, beside its way down",
                                    0.0, false, [](Machine& m) -> double& { return m.lift.plunge; }, 1.0},
                                   {"lift", "settle_s", "rest with the tool down before it moves: that removes", 0.0,
                                    false, [](Machine& m) -> double& { return m.lift.settle; }, 1.0}};
  add_axis(fields, "x", "[mm in the program's coordinates]",
           {[](Machine& m) -> double& { return m.x.lowest; }, [](Machine& m) -> double& { return m.x.highest; },
            [](Machine& m) -> double& { return m.x.max_speed; },
            [](Machine& m) -> double& { return m.x.max_acceleration; }});
  add_axis(fields, "y", "[mm in the program's coordinates]",
           {[](Machine& m) -> double& { return m.y.lowest; }, [](Machine& m) -> double& { return m.y.highest; },
            [](Machine& m) -> double& { return m.y.max_speed; },
            [](Machine& m) -> double& { return m.y.max_acceleration; }});
  return fields;
}

/// "corner, x, y": those of the fields, in their order.
std::vector<std::string> sections() {
  std::vector<std::string> names;
  for (const MachineField& field : machine_fields()) {
    if (!field.section.empty() && (names.empty() || names.back() != field.section)) names.push_back(field.section);
  }
  return names;
}

std::string keys_of(const std::string& section) {
  std::vector<std::string> keys;
  if (section.empty()) keys = {"name", "schema"};
  if (section == "corner") keys = {"rule"};
  for (const MachineField& field : machine_fields()) {
    if (field.section == section) keys.push_back(field.key);
  }
  return fmt::format("{}", fmt::join(keys, ", "));
}

std::string value_text(const toml::node& node) {
  std::ostringstream text;
  node.visit([&text](const auto& v) {
    if constexpr (toml::is_value<decltype(v)>) {
      text << v;
    } else {
      text << "a table or list";
    }
  });
  return text.str();
}

double number_of(const toml::node& node, const std::string& source, const MachineField& field) {
  const auto value = node.value<double>();
  const bool number = node.is_integer() || node.is_floating_point();
  const bool in_range =
      number && std::isfinite(*value) && (field.beyond ? *value > field.least : *value >= field.least);
  if (in_range) return *value;
  std::string range = "a finite number";
  if (field.least > kAny) range += fmt::format(" {} {}", field.beyond ? ">" : ">=", field.least);
  throw InputError(fmt::format("{} = {}; required {} (without quotes)", source, value_text(node), range));
}

CornerRule rule_of(const toml::node& node, const std::string& source) {
  const auto text = node.value<std::string>();
  for (const CornerRule rule : kRules) {
    if (text && *text == to_string(rule)) return rule;
  }
  throw InputError(
      fmt::format("{} = {}; accepted: \"exact-stop\", \"junction-deviation\", \"free\"", source, value_text(node)));
}

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  NamedMachine read(const toml::table& table) {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (const toml::table* section = node.as_table()) {
        read_section(name, *section);
      } else {
        read_field("", name, node);
      }
    }
    try {
      validate(result_.machine);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", file_, error.what()));
    }
    return result_;
  }

 private:
  void read_section(const std::string& section, const toml::table& table) {
    const std::vector<std::string> known = sections();
    if (std::find(known.begin(), known.end(), section) == known.end())
      throw InputError(fmt::format("{}: unknown section [{}]; accepted: {}", file_, section, fmt::join(known, ", ")));
    for (const auto& [key, node] : table) read_field(section, std::string(key.str()), node);
  }

  void read_field(const std::string& section, const std::string& key, const toml::node& node) {
    const std::string where = section.empty() ? key : section + "." + key;
    const std::string source = fmt::format("{}: line {}: {}", file_, node.source().begin.line, where);
    if (where == "schema") return check_schema(node, source);
    if (where == "name") return read_name(node, source);
    if (where == "corner.rule") {
      result_.machine.corner = rule_of(node, source);
      return;
    }
    for (const MachineField& field : machine_fields()) {
      if (field.section != section || field.key != key) continue;
      field.value(result_.machine) = field.scale * number_of(node, source, field);
      return;
    }
    throw InputError(fmt::format("{}: unknown field; accepted{}: {}", source,
                                 section.empty() ? "" : " in [" + section + "]", keys_of(section)));
  }

  void check_schema(const toml::node& node, const std::string& source) const {
    if (node.value<int>() == 1) return;
    throw InputError(fmt::format("{} = {}; accepted: 1 (the layout of dwell {})", source, value_text(node), version()));
  }

  void read_name(const toml::node& node, const std::string& source) {
    const auto text = node.value<std::string>();
    if (!text) throw InputError(fmt::format("{} = {}; required a string (in quotes)", source, value_text(node)));
    result_.name = *text;
  }

  std::string file_;
  NamedMachine result_;
};

/// "key = value  # about", a comment where there is no limit.
std::string line_of(const MachineField& field, const Machine& machine) {
  Machine copy = machine;
  const double value = field.value(copy) / field.scale;
  if (!std::isfinite(value)) return fmt::format("# {} =  # {}; not given: no limit\n", field.key, field.about);
  return fmt::format("{} = {}  # {}\n", field.key, value, field.about);
}

}  // namespace

const std::vector<MachineField>& machine_fields() {
  static const std::vector<MachineField> kFields = make_fields();
  return kFields;
}

NamedMachine parse_machine(const std::string& text, const std::string& file) {
  try {
    return Reader(file).read(toml::parse(text, file));
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
      if (section == "corner")
        text +=
            fmt::format("rule = \"{}\"  # exact-stop, junction-deviation or free\n", to_string(machine.machine.corner));
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
