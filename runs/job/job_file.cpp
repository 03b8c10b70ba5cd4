#include "runs/job/job_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/spec_text.h"
#include "core/base/utf8_text.h"
#include "core/base/version.h"
#include "core/base/whole_file.h"
#include "core/tif/models/removal_models.h"
#include "runs/job/keep_out_option.h"
#include "runs/job/pixel_weight_option.h"
#include "runs/job/tool_option.h"
#include "runs/machine/machine_option.h"
#include "runs/machine/machine_table.h"
#include "runs/map_steps/map_steps.h"
#include "runs/programs/shipped_templates.h"

namespace dwell {
namespace {

const JobOptionRecord& record_of(const std::string& key, const std::string& file) {
  std::string known = "schema";
  for (const JobOptionRecord& record : job_option_table()) {
    if (record.key == key) return record;
    known += ", " + record.key;
  }
  throw InputError(fmt::format("{}: unknown field '{}'; accepted: {}", file, key, known));
}

/// Whether an option takes this string: a number is written as one.
bool takes_text(const JobOptionRecord& record, const std::string& text) {
  return !record.is_number || (record.takes_words && !parse_number(text));
}

/// The strings of a list, separated by semicolons; nothing if it is no list of strings alone.
std::optional<std::string> joined(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (!list || !list->is_homogeneous(toml::node_type::string)) return std::nullopt;
  std::string text;
  for (const toml::node& part : *list) text += (text.empty() ? "" : "; ") + part.as_string()->get();
  return text;
}

/// A tool of a job, [[tool]] with its name and its own options by their fields, as --tool has it.
std::string tool_text(const toml::table& fields, const std::string& source) {
  const auto name = fields["name"].value<std::string>();
  if (!name) throw InputError(fmt::format("{}: a [[tool]] without a name; required name = \"...\", a string", source));
  std::string text = *name;
  for (const auto& [key, node] : fields) {
    const std::string field(key.str());
    if (field == "name") continue;
    const auto& table = job_option_table();
    const auto record = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.key == field; });
    std::string word = record == table.end() ? field : record->flag, value;
    if (field == "change_over") word = "change-over";
    if (const auto number = node.value<double>()) value = fmt::format("{}", *number);
    if (const auto string = node.value<std::string>()) value = *string;
    if (const auto* machine = node.as_table(); machine && field == "machine") {
      machine_of_table(*machine, source);
      value = inline_machine_text(*machine);
    }
    if (value.empty()) {
      std::ostringstream type;
      type << node.type();
      throw InputError(fmt::format("{}: '{}': {} is empty or of type {}; required a string or a number", source, *name,
                                   field, type.str()));
    }
    if (value.find(';') != std::string::npos || value.find('\n') != std::string::npos)
      throw InputError(
          fmt::format("{}: {} = '{}'; required a value without semicolons and line breaks", source, field, value));
    text += fmt::format(";{}={}", word, value);
  }
  return text;
}

/// Several values of an option: a list of strings, or of tables; nothing if it is neither.
std::optional<std::string> lines_of(const toml::node& node, const std::string& source) {
  const toml::array* list = node.as_array();
  if (!list || list->empty()) return std::nullopt;
  std::string text;
  for (const toml::node& part : *list) {
    const toml::table* fields = part.as_table();
    if (!fields && !part.is_string()) return std::nullopt;
    text += (text.empty() ? "" : "\n") + (fields ? tool_text(*fields, source) : part.as_string()->get());
  }
  return text;
}

std::string text_of(const toml::node& node, const JobOptionRecord& record, const std::string& source) {
  if (record.repeats) {
    if (const auto text = lines_of(node, source)) return *text;
  }
  if (record.takes_list) {
    if (const auto text = joined(node)) return *text;
  }
  if (const toml::table* fields = node.as_table(); fields && record.key == "machine") {
    machine_of_table(*fields, source);  // refuses with the lines of this file
    return inline_machine_text(*fields);
  }
  if (record.is_number) {
    if (const auto whole = node.as_integer()) return fmt::format("{}", whole->get());
    if (const auto real = node.as_floating_point()) return fmt::format("{}", real->get());
  }
  if (const auto truth = node.as_boolean(); truth && !record.is_number && !record.alone.empty())
    return truth->get() ? "true" : "false";
  if (const auto text = node.as_string(); text && takes_text(record, text->get())) return text->get();
  std::ostringstream type, value;
  type << node.type();
  if (node.is_value())
    node.visit([&value](const auto& v) {
      if constexpr (toml::is_value<decltype(v)>) value << ' ' << v;
    });
  throw InputError(fmt::format("{}:{} is of type {}; required {}", source, value.str(), type.str(),
                               record.repeats       ? "tables [[tool]], or a list of strings"
                               : record.takes_list  ? "a string, or a list of strings, (in quotes)"
                               : record.takes_words ? "a number (without quotes) or words (in quotes)"
                               : record.is_number   ? "a number (without quotes)"
                                                    : "a string (in quotes)"));
}

/// Refuses a layout that this program does not know. No field: layout 1, from version 0.1.
void check_schema(const toml::node& node, const std::string& file) {
  const auto number = node.as_integer();
  if (number && number->get() >= 1 && number->get() <= kJobSchema) return;
  std::ostringstream value;
  node.visit([&value](const auto& v) {
    if constexpr (toml::is_value<decltype(v)>) value << v;
  });
  throw InputError(fmt::format("{}: schema: {}; accepted: 1 (the layout of dwell 0.1) or {} (that of dwell {})", file,
                               value.str().empty() ? "no number" : value.str(), kJobSchema, version()));
}

/// Whether the value of a file option names a file: a removal function may be a formula, a machine its fields.
bool names_a_file(const std::string& value) {
  return !is_inline_machine(value) && !is_removal_model(split_kind(value).first);
}

/// Says so where a word of layout 1 has another meaning now.
void note_changed_words(int schema, const std::string& source, const std::string& value, JobOptions& options) {
  const bool is_weight = source.ends_with("smoothness") || source.ends_with("time_price_nm2_per_s");
  if (schema > 1 || !is_weight || lower_case(trim(value)) != "auto") return;
  options.notes.push_back(fmt::format(
      "{} = \"auto\": this is no longer the corner of the L-curve, as in dwell 0.1, but the weight that belongs "
      "to tool, path and part; the corner is \"corner\" now (`schema = {}` in the file ends this line)",
      source, kJobSchema));
}

/// Tools with other names for their files.
std::string renamed_tools(const std::string& text, const FileNames& name) {
  std::string renamed;
  for (ToolSpec& tool : parse_tool_specs(text)) {
    for (auto& [flag, value] : tool.values) {
      const JobOptionRecord& record = option_of_tool(tool, flag);
      value = renamed_option(record, value, name, fmt::format("tool '{}': {}", tool.name, flag));
    }
    renamed += (renamed.empty() ? "" : "\n") + to_string(tool);
  }
  return renamed;
}

}  // namespace

std::string renamed_option(const JobOptionRecord& record, const std::string& value, const FileNames& name,
                           const std::string& source) {
  if (value.empty()) return value;
  if (record.key == "template" && is_shipped_template(value)) return value;
  if (record.is_file && names_a_file(value)) return name(value);
  if (record.key == "map_steps" || record.key == "tif_steps" || record.key == "tool") {
    try {
      return record.key == "tool" ? renamed_tools(value, name) : renamed_map_steps(value, name);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", source, error.what()));
    }
  }
  if (record.key == "keep_out") return renamed_keep_out(value, name);
  if (record.key == "weight") return renamed_pixel_weights(value, name);
  constexpr std::string_view kPathFile = "file:";
  if (record.key == "path" && value.starts_with(kPathFile) && value != kPathFile)
    return std::string(kPathFile) + name(value.substr(kPathFile.size()));
  return value;
}

std::string rebased_option(const JobOptionRecord& record, const std::string& value, const std::filesystem::path& folder,
                           const std::string& source) {
  const auto rebased = [&folder](const std::string& file) { return (folder / file).lexically_normal().string(); };
  return renamed_option(record, value, rebased, source);
}

void read_job_file(const std::filesystem::path& file, JobOptions& options) {
  const std::string text = read_whole_file(file);
  toml::table table;
  try {
    table = toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}: line {}: {}", file.string(), error.source().begin.line, std::string(error.description())));
  }
  if (const toml::node* schema = table.get("schema")) check_schema(*schema, file.string());
  const int schema = table["schema"].value_or(1);
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (name == "schema") continue;
    const JobOptionRecord& record = record_of(name, file.string());
    const std::string source = fmt::format("{}: {}", file.string(), name);
    const std::string value = text_of(node, record, source);
    set_job_option(options, record, rebased_option(record, value, file.parent_path(), source), source);
    note_changed_words(schema, source, value, options);
  }
}

std::string job_file_text(const JobOptions& options) {
  std::string text = fmt::format(
      "# Job file of dwell {}: dwell plan --job THIS.toml\n# File names are relative to this file's folder.\n\n"
      "# layout of this file\nschema = {}\n",
      version(), kJobSchema);
  for (const JobOptionRecord& record : job_option_table()) {
    const std::string value = record.get(options);
    if (!is_utf8(value)) {
      throw InputError(
          fmt::format("--{} '{}': a job file is UTF-8 and can name no other bytes (shown as \\xE9); rename "
                      "the file",
                      record.flag, with_escaped_bytes(value)));
    }
    std::ostringstream quoted;
    quoted << toml::value<std::string>(value);
    text += fmt::format("\n# {}\n", record.help);
    if (value.empty()) {
      text += fmt::format("# {} = {}\n", record.key, record.is_number ? "" : "\"\"");
    } else if (record.repeats) {
      toml::array list;
      for (const std::string_view line : split(value, '\n')) list.push_back(std::string(line));
      std::ostringstream lines;
      lines << list;
      text += fmt::format("{} = {}\n", record.key, lines.str());
    } else {
      const bool in_quotes = takes_text(record, value) && !(record.key == "machine" && is_inline_machine(value));
      text += fmt::format("{} = {}\n", record.key, in_quotes ? quoted.str() : value);
    }
  }
  return text;
}

}  // namespace dwell
