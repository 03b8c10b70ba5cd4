#include "runs/machine/machine_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "core/base/errors.h"
#include "core/base/version.h"

namespace dwell {
namespace {

constexpr std::array<CornerRule, 4> kRules{CornerRule::ExactStop, CornerRule::JunctionDeviation, CornerRule::Free,
                                           CornerRule::Blend};
constexpr std::array<BlendSize, 2> kSizes{BlendSize::Largest, BlendSize::AsNeeded};

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
  if (section == "corner") keys = {"rule", "arcs"};
  if (section == "x" || section == "y") keys = {"letter"};
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
  if (std::isfinite(field.least)) range += fmt::format(" {} {}", field.beyond ? ">" : ">=", field.least);
  throw InputError(fmt::format("{} = {}; required {} (without quotes)", source, value_text(node), range));
}

/// One of several words, each as to_string has it.
template <class Words>
auto word_of(const Words& words, const toml::node& node, const std::string& source) {
  const auto text = node.value<std::string>();
  std::vector<std::string> accepted;
  for (const auto word : words) {
    if (text && *text == to_string(word)) return word;
    accepted.push_back(fmt::format("\"{}\"", to_string(word)));
  }
  throw InputError(fmt::format("{} = {}; accepted: {}", source, value_text(node), fmt::join(accepted, ", ")));
}

char letter_of(const toml::node& node, const std::string& source) {
  const auto text = node.value<std::string>();
  if (text && text->size() == 1 && kAxisLetters.find(*text) != std::string_view::npos) return text->front();
  throw InputError(fmt::format("{} = {}; accepted: one of {} (in quotes)", source, value_text(node), kAxisLetters));
}

class MachineReader {
 public:
  MachineReader(std::string source, bool says_lines) : source_(std::move(source)), says_lines_(says_lines) {}

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
      throw InputError(fmt::format("{}: {}", source_, error.what()));
    }
    return result_;
  }

 private:
  void read_section(const std::string& section, const toml::table& table) {
    const std::vector<std::string> known = sections();
    if (std::find(known.begin(), known.end(), section) == known.end())
      throw InputError(fmt::format("{}: unknown section [{}]; accepted: {}", source_, section, fmt::join(known, ", ")));
    for (const auto& [key, node] : table) read_field(section, std::string(key.str()), node);
  }

  void read_field(const std::string& section, const std::string& key, const toml::node& node) {
    const std::string where = section.empty() ? key : section + "." + key;
    const std::string line = says_lines_ ? fmt::format("line {}: ", node.source().begin.line) : "";
    const std::string source = fmt::format("{}: {}{}", source_, line, where);
    if (where == "schema") return check_schema(node, source);
    if (where == "name") return read_name(node, source);
    if (where == "corner.rule") {
      result_.machine.corner = word_of(kRules, node, source);
      return;
    }
    if (where == "corner.arcs") {
      result_.machine.blend_size = word_of(kSizes, node, source);
      return;
    }
    if (where == "x.letter" || where == "y.letter") {
      (section == "x" ? result_.machine.letters.x : result_.machine.letters.y) = letter_of(node, source);
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

  std::string source_;
  bool says_lines_;
  NamedMachine result_;
};

void set_inline(toml::table& table) {
  table.is_inline(true);
  for (auto&& [key, node] : table) {
    if (toml::table* inner = node.as_table()) set_inline(*inner);
  }
}

}  // namespace

NamedMachine machine_of_table(const toml::table& table, const std::string& source, bool says_lines) {
  return MachineReader(source, says_lines).read(table);
}

std::string inline_machine_text(const toml::table& table) {
  toml::table copy = table;
  set_inline(copy);
  std::ostringstream text;
  text << toml::toml_formatter{
      copy, toml::toml_formatter::default_flags &
                ~(toml::format_flags::allow_multi_line_strings | toml::format_flags::allow_literal_strings)};
  return text.str();
}

}  // namespace dwell
