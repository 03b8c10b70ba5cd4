#include "runs/reports/program_record.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <string_view>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/spec_text.h"
#include "core/base/text_lines.h"
#include "core/base/utf8_text.h"
#include "core/base/whole_file.h"
#include "core/tif/models/removal_models.h"
#include "runs/programs/program_comments.h"
#include "runs/programs/recorded_option.h"

namespace dwell {
namespace {

/// The text of a line that holds a comment and nothing else; nothing for any other line. A blank at its end may be one
/// within an option that goes on in the next line.
std::optional<std::string_view> comment_of(std::string_view line, const ProgramTemplate* layout) {
  const auto begun = [](std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
  };
  line = trim(line);
  if (layout != nullptr) {
    const std::string_view begin = trim(layout->comment_begin), end = trim(layout->comment_end);
    if (line.size() < begin.size() + end.size() || !line.starts_with(begin) || !line.ends_with(end))
      return std::nullopt;
    return begun(line.substr(begin.size(), line.size() - begin.size() - end.size()));
  }
  if (line.starts_with('#')) return begun(line.substr(1));
  if (line.starts_with(';')) return begun(line.substr(1));
  if (line.starts_with('(') && line.ends_with(')')) return begun(line.substr(1, line.size() - 2));
  return std::nullopt;
}

InputFile input_of(std::string_view text, const std::string& program) {
  constexpr std::string_view kHash = " sha256=";
  const std::size_t hash = text.rfind(kHash), role = text.find(' ');
  if (hash == std::string_view::npos || role >= hash) {
    throw InputError(fmt::format("{}: \"input: {}\" in its header; required ROLE FILE sha256=HASH", program, text));
  }
  return {std::string(text.substr(0, role)), std::string(text.substr(role + 1, hash - role - 1)),
          std::string(text.substr(hash + kHash.size()))};
}

void take_comment(std::string_view comment, const std::string& program, ProgramRecord& record) {
  constexpr std::string_view kInput = "input: ", kOption = "option: ", kMore = "option+: ", kEquals = " = ",
                             kRecord = "record: ";
  if (comment.starts_with(kInput)) {
    record.inputs.push_back(input_of(trim(comment.substr(kInput.size())), program));
  } else if (comment.starts_with(kRecord)) {
    record.stated_hash = trim(comment.substr(kRecord.size()));
  } else if (comment.starts_with(kOption) || comment.starts_with(kMore)) {
    const bool more = comment.starts_with(kMore);
    comment.remove_prefix(more ? kMore.size() : kOption.size());
    const std::size_t equals = comment.find(kEquals);
    if (equals == std::string_view::npos) return;
    std::string& value = record.options[std::string(comment.substr(0, equals))];
    value = (more ? value : "") + std::string(comment.substr(equals + kEquals.size()));
  }
}

/// Says so where the header's lines are not those that were written; older programs have no hash of them.
std::optional<std::string> changed_header(const ProgramRecord& record) {
  if (record.stated_hash.empty()) return std::nullopt;
  std::vector<std::pair<std::string, std::string>> inputs;
  for (const InputFile& input : record.inputs) inputs.emplace_back(input.role, input.sha256);
  const std::string now = record_hash(inputs, record.options);
  if (now == record.stated_hash) return std::nullopt;
  return fmt::format(
      "the comments of the program that say how it was made have changed since: their SHA-256 is {}, and was {}, so "
      "that files or options may be others than they say",
      short_hash(now), short_hash(record.stated_hash));
}

bool is_formula(const std::string& tif) { return is_removal_model(split_kind(tif).first); }

/// Those of one kind: the removal function, or the map and the maps of its steps.
std::vector<InputFile> inputs_of(const std::vector<InputFile>& inputs, bool tif) {
  std::vector<InputFile> some;
  for (const InputFile& input : inputs) {
    if (!is_of_program_alone(input.role) && (input.role == "tif") == tif) some.push_back(input);
  }
  return some;
}

std::string with_hashes(const std::vector<InputFile>& inputs, const std::string& none) {
  std::string words;
  for (const InputFile& input : inputs) {
    words += fmt::format("{}{} (SHA-256 {})", words.empty() ? "" : ", ", input.file, short_hash(input.sha256));
  }
  return words.empty() ? none : words;
}

bool same_files(const std::vector<InputFile>& a, const std::vector<InputFile>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const InputFile& x, const InputFile& y) { return is_same_hash(x.sha256, y.sha256); });
}

/// The formula of the plan, if its header states one.
std::string formula_of(const ProgramRecord& record) {
  const auto tif = record.options.find("tif");
  return tif == record.options.end() || !is_formula(tif->second) ? "a formula" : std::string(trim(tif->second));
}

/// The difference of one kind of inputs, in words; empty if there is none.
std::string difference_of_inputs(const ProgramRecord& record, const Job& job, bool tif) {
  const std::vector<InputFile> then = inputs_of(record.inputs, tif), now = inputs_of(job.inputs, tif);
  const std::string formula = tif ? formula_of(record) : "";
  const bool same_formula = !then.empty() || !now.empty() || formula == "a formula" || !tif ||
                            comment_text(formula) == comment_text(job.options.tif);
  if (same_files(then, now) && same_formula) return "";
  return fmt::format("was made with the {} {}, and is simulated with {}", tif ? "removal function" : "map",
                     with_hashes(then, formula), with_hashes(now, job.options.tif));
}

/// Of a program by a template, whose header's lines come before its comments.
ProgramRecord record_by_template(std::string_view text, const std::string& program, const ProgramTemplate& layout) {
  ProgramRecord record;
  for (TextLines lines(text); lines.next();) {
    const auto comment = comment_of(lines.line(), &layout);
    if (!comment) continue;
    take_comment(layout.upper_case ? lower_case(*comment) : std::string(*comment), program, record);
  }
  if (layout.upper_case) {
    record.options.clear();
    record.stated_hash.clear();
  }
  return record;
}

}  // namespace

bool is_of_program_alone(const std::string& role) {
  return role == "path" || role == "machine" || role == "header" || role == "footer" || role == "template" ||
         role == "log" || role == "log-program";
}

std::string short_hash(const std::string& sha256) {
  constexpr std::size_t kDigits = 12;
  return sha256.size() <= kDigits ? sha256 : sha256.substr(0, kDigits) + "...";
}

ProgramRecord read_program_record(const std::filesystem::path& program, const ProgramTemplate* layout) {
  const std::string text = read_whole_file(program);
  if (layout != nullptr) return record_by_template(text, program.string(), *layout);
  std::string_view rest = without_byte_order_mark(text);
  ProgramRecord record;
  if (rest.starts_with('{')) {  // pvt.json
    const nlohmann::json json = nlohmann::json::parse(rest.begin(), rest.end(), nullptr, false);
    if (!json.is_object() || !json.contains("made") || !json["made"].is_array()) return record;
    for (const nlohmann::json& line : json["made"]) {
      if (line.is_string()) take_comment(line.get_ref<const std::string&>(), program.string(), record);
    }
    return record;
  }
  while (!rest.empty()) {
    const std::size_t newline = rest.find('\n');
    const std::string_view line = rest.substr(0, newline);
    rest.remove_prefix(newline == std::string_view::npos ? rest.size() : newline + 1);
    if (const auto comment = comment_of(line, nullptr)) {
      take_comment(*comment, program.string(), record);
    } else if (!trim(line).empty() && trim(line) != "%") {
      break;
    }
  }
  return record;
}

std::vector<std::pair<std::string, std::string>> options_of_record(const JobOptions& options) {
  std::vector<std::pair<std::string, std::string>> recorded;
  for (const JobOptionRecord& option : job_option_table()) {
    if (!is_recorded_option(option.key)) continue;
    const std::string value = option.get(options);
    if (!value.empty()) recorded.emplace_back(option.key, value);
  }
  return recorded;
}

std::vector<std::string> differences_from_record(const ProgramRecord& record, const std::string& program,
                                                 const Job& job, const OtherInputs& meant, bool compare_options) {
  std::vector<std::string> differences;
  if (auto changed = changed_header(record)) differences.push_back(std::move(*changed));
  if (record.inputs.empty()) return differences;
  for (const bool tif : {false, true}) {
    const std::string difference = difference_of_inputs(record, job, tif);
    if (difference.empty()) continue;
    if (!(tif ? meant.tif : meant.map)) {
      throw InputError(fmt::format("{}: {}; required the same, or {} where another is meant", program, difference,
                                   tif ? "--other-tif" : "--other-map"));
    }
    differences.push_back("the program " + difference);
  }
  if (!compare_options || record.options.empty()) return differences;
  for (const JobOptionRecord& option : job_option_table()) {
    if (!is_recorded_option(option.key)) continue;
    if (option.key == "tif") continue;
    const auto found = record.options.find(option.key);
    const std::string then = found == record.options.end() ? "" : comment_text(trim(found->second)),
                      now = comment_text(option.get(job.options));
    if (then == now) continue;
    differences.push_back(fmt::format("--{} is {}, but was {} when the program was made", option.flag,
                                      now.empty() ? "not given" : now, then.empty() ? "not given" : then));
  }
  return differences;
}

}  // namespace dwell
