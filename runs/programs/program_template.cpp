#include "runs/programs/program_template.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/utf8_text.h"
#include "core/base/word_list.h"
#include "runs/programs/program_comments.h"

namespace dwell {
namespace {

/// A block: its name in a template, and the fields that it may hold.
struct TemplateBlockRecord {
  std::string_view name;
  TemplateBlock ProgramTemplate::*block;
  std::vector<std::string_view> fields;
  bool required;
};

const std::vector<TemplateBlockRecord>& block_records() {
  static const std::vector<TemplateBlockRecord> kRecords{
      {"header", &ProgramTemplate::header, {}, false},
      {"begin", &ProgramTemplate::begin, {"x", "y", "z"}, false},
      {"travel", &ProgramTemplate::travel, {"x", "y", "z"}, true},
      {"lower", &ProgramTemplate::lower, {"x", "y", "z"}, true},
      {"move", &ProgramTemplate::move, {"x", "y", "dx", "dy", "vx", "vy", "f", "t", "time", "n"}, true},
      {"halt", &ProgramTemplate::halt, {"x", "y", "dx", "dy", "vx", "vy", "t", "time", "n"}, false},
      {"lift", &ProgramTemplate::lift, {"x", "y", "z"}, true},
      {"start", &ProgramTemplate::start, {}, false},
      {"group_begin", &ProgramTemplate::group_begin, {"n"}, false},
      {"group_end", &ProgramTemplate::group_end, {"n"}, false},
      {"footer", &ProgramTemplate::footer, {}, false},
  };
  return kRecords;
}

constexpr std::array<std::string_view, 11> kTemplateFields{"x",  "y", "z", "dx",   "dy", "vx",
                                                           "vy", "f", "t", "time", "n"};
constexpr std::string_view kTemplateKeys =
    "schema, name, ending, comment, line_end, longest_line, most_lines, longest_step_s, every, start_after, speeds, "
    "upper_case, block_numbers, [numbers], [blocks]";
constexpr int kMostTemplateDecimals = 12;
constexpr std::int64_t kMostTemplateCount = 100'000'000;
constexpr std::size_t kLongestEnding = 9;

/// What a template holds, for messages.
std::string shown_node(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return in_quotes(with_escaped_bytes(*text));
  if (const auto whole = node.value_exact<std::int64_t>()) return fmt::format("{}", *whole);
  if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
  if (const auto truth = node.value_exact<bool>()) return *truth ? "true" : "false";
  return node.is_table() ? "a table" : node.is_array() ? "a list" : "a date or time";
}

class TemplateParser {
 public:
  explicit TemplateParser(const std::string& file) { result_.file = file; }

  ProgramTemplate read(const toml::table& table) {
    for (const auto& [key, node] : table) read_entry(std::string(key.str()), node);
    check();
    return std::move(result_);
  }

 private:
  std::string where(const toml::node& node, const std::string& key) const {
    return fmt::format("{}: line {}: {}", result_.file, node.source().begin.line, key);
  }

  [[noreturn]] void refuse(const toml::node& node, const std::string& key, std::string_view required) const {
    throw InputError(fmt::format("{} = {}; required {}", where(node, key), shown_node(node), required));
  }

  std::string text_in(const toml::node& node, const std::string& key) const {
    const auto text = node.value_exact<std::string>();
    if (!text) refuse(node, key, "a text in quotes");
    return *text;
  }

  bool truth_in(const toml::node& node, const std::string& key) const {
    const auto truth = node.value_exact<bool>();
    if (!truth) refuse(node, key, "true or false");
    return *truth;
  }

  int whole_in(const toml::node& node, const std::string& key, std::int64_t least,
               std::int64_t most = kMostTemplateCount) const {
    const auto value = node.value_exact<std::int64_t>();
    if (!value || *value < least || *value > most)
      refuse(node, key, fmt::format("a whole number from {} to {}", least, most));
    return static_cast<int>(*value);
  }

  double above_zero_in(const toml::node& node, const std::string& key) const {
    constexpr double kLeast = 1e-9, kMost = 1e12;
    const auto value = node.value<double>();
    if (!value || !(*value >= kLeast && *value <= kMost))
      refuse(node, key, fmt::format("a number from {} to {}", kLeast, kMost));
    return *value;
  }

  void read_entry(const std::string& key, const toml::node& node) {
    if (key == "schema") {
      if (node.value_exact<std::int64_t>() != 1) refuse(node, key, "1");
    } else if (key == "name") {
      result_.name = text_in(node, key);
    } else if (key == "ending") {
      read_ending(node);
    } else if (key == "comment") {
      read_comment(node);
    } else if (key == "line_end") {
      result_.line_end = text_in(node, key);
      if (result_.line_end != "\n" && result_.line_end != "\r\n") refuse(node, key, "\"\\n\" or \"\\r\\n\"");
    } else if (key == "longest_line") {
      result_.longest_line = whole_in(node, key, 20);
    } else if (key == "most_lines") {
      result_.most_lines = whole_in(node, key, 1);
    } else if (key == "longest_step_s") {
      result_.longest_step = above_zero_in(node, key);
    } else if (key == "every") {
      result_.every = whole_in(node, key, 1);
    } else if (key == "start_after") {
      result_.start_after = whole_in(node, key, 1);
    } else if (key == "speeds") {
      result_.speeds = truth_in(node, key);
    } else if (key == "upper_case") {
      result_.upper_case = truth_in(node, key);
    } else {
      read_section(key, node);
    }
  }

  void read_section(const std::string& key, const toml::node& node) {
    if (key != "block_numbers" && key != "numbers" && key != "blocks")
      throw InputError(
          fmt::format("{}: unknown field; accepted: {}", where(node, with_escaped_bytes(key)), kTemplateKeys));
    const toml::table* table = node.as_table();
    if (table == nullptr) refuse(node, key, key == "block_numbers" ? "{ step = 10, last = 99999 }" : "a section");
    if (key == "block_numbers") result_.block_numbers.emplace();
    for (const auto& [name, value] : *table) {
      const std::string part(name.str());
      if (key == "numbers") {
        read_number(part, value);
      } else if (key == "blocks") {
        read_block(part, value);
      } else if (part == "step" || part == "last") {
        (part == "step" ? result_.block_numbers->step : result_.block_numbers->last) =
            whole_in(value, fmt::format("{}.{}", key, part), 1);
      } else {
        throw InputError(
            fmt::format("{}: unknown field; accepted: step, last", where(value, fmt::format("{}.{}", key, part))));
      }
    }
  }

  void read_ending(const toml::node& node) {
    result_.ending = text_in(node, "ending");
    const auto is_plain = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    };
    const std::string& e = result_.ending;
    if (e.size() < 2 || e.size() > kLongestEnding || e[0] != '.' || !std::all_of(e.begin() + 1, e.end(), is_plain))
      refuse(node, "ending", "the ending of the program's file, a point and one to eight letters or digits: \".mpf\"");
  }

  void read_comment(const toml::node& node) {
    constexpr std::string_view kText = "{text}";
    const std::string text = text_in(node, "comment");
    const std::size_t at = text.find(kText);
    if (at == std::string::npos || trim(text.substr(0, at)).empty() || !is_printable_ascii(text))
      refuse(node, "comment", "the sign of a comment and {text}, in ASCII: \"; {text}\" or \"({text})\"");
    result_.comment_begin = text.substr(0, at);
    result_.comment_end = text.substr(at + kText.size());
  }

  void read_number(const std::string& field, const toml::node& node) {
    const std::string key = "numbers." + field;
    if (!is_among(field, kTemplateFields))
      throw InputError(
          fmt::format("{}: unknown field; accepted: {}", where(node, key), fmt::join(kTemplateFields, ", ")));
    const toml::table* table = node.as_table();
    if (table == nullptr) refuse(node, key, "{ per_unit = 1, decimals = 6, rounding = \"nearest\" }");
    TemplateNumber number = result_.number(field);
    for (const auto& [part, value] : *table) read_number_part(number, key + "." + std::string(part.str()), value);
    result_.numbers[field] = number;
  }

  void read_number_part(TemplateNumber& number, const std::string& key, const toml::node& node) const {
    if (key.ends_with(".per_unit")) {
      number.per_unit = above_zero_in(node, key);
    } else if (key.ends_with(".decimals")) {
      number.decimals = whole_in(node, key, 0, kMostTemplateDecimals);
    } else if (key.ends_with(".rounding")) {
      const std::string text = text_in(node, key);
      if (text != "nearest" && text != "down" && text != "up") refuse(node, key, "nearest, down or up");
      number.rounding = text == "nearest" ? TemplateNumber::Rounding::Nearest
                        : text == "down"  ? TemplateNumber::Rounding::Down
                                          : TemplateNumber::Rounding::Up;
    } else {
      throw InputError(fmt::format("{}: unknown field; accepted: per_unit, decimals, rounding", where(node, key)));
    }
  }

  void read_block(const std::string& name, const toml::node& node) {
    const std::string key = "blocks." + name;
    const auto& records = block_records();
    const auto record = std::find_if(records.begin(), records.end(), [&](const auto& r) { return r.name == name; });
    if (record == records.end()) {
      std::vector<std::string_view> names;
      names.reserve(records.size());
      for (const TemplateBlockRecord& r : records) names.push_back(r.name);
      throw InputError(fmt::format("{}: unknown block; accepted: {}", where(node, key), fmt::join(names, ", ")));
    }
    const std::string text = text_in(node, key);
    for (const std::string_view line : split(text, '\n')) {
      if (trim(line).empty()) continue;
      if (!is_printable_ascii(line)) {
        throw InputError(
            fmt::format("{}: \"{}\" holds a character that is no printable ASCII; required what "
                        "controllers take",
                        where(node, key), with_escaped_bytes(line)));
      }
      TemplateLine parsed(line, where(node, key));
      for (const std::string& field : parsed.fields()) {
        if (is_among(field, record->fields)) continue;
        throw InputError(
            fmt::format("{}: unknown field {{{}}}; accepted: {}", where(node, key), field,
                        record->fields.empty() ? "none" : fmt::format("{}", fmt::join(record->fields, ", "))));
      }
      check_unit_words(parsed, line, where(node, key));
      (result_.*(record->block)).push_back(std::move(parsed));
    }
  }

  /// Remembers a line that sets inches on controllers of G-code, for numbers of places must then be inches.
  void check_unit_words(const TemplateLine& line, std::string_view text, const std::string& place) {
    for (const TemplateLine::Piece& piece : line.pieces()) {
      for (const std::string_view word : split(piece.literal, ' ')) {
        if (word == "G20" || word == "G70" || word == "G700") inches_ = fmt::format("{}: \"{}\"", place, text);
      }
    }
  }

  static int count_in(const TemplateBlock& block, std::initializer_list<std::string_view> any) {
    int count = 0;
    for (const std::string_view field : any) {
      count += std::any_of(block.begin(), block.end(),
                           [&](const TemplateLine& line) { return is_among(field, line.fields()); });
    }
    return count;
  }

  void require(bool holds, std::string_view what) const {
    if (!holds) throw InputError(fmt::format("{}: {}", result_.file, what));
  }

  void check() const {
    require(!trim(result_.name).empty(), "name: required, of the layout");
    require(!result_.ending.empty(), "ending: required, of the program's file: \".mpf\"");
    require(!result_.comment_begin.empty(), "comment: required, as \"; {text}\"");
    for (const TemplateBlockRecord& record : block_records())
      require(!record.required || !(result_.*(record.block)).empty(), fmt::format("blocks.{}: required", record.name));
    check_moves();
    require(count_in(result_.travel, {"x", "y"}) == 2, "blocks.travel: required {x} and {y}");
    require(result_.every.has_value() || (result_.group_begin.empty() && result_.group_end.empty()),
            "blocks.group_begin, group_end: required every = N, the moves of a group");
    require(result_.start_after.has_value() == !result_.start.empty(),
            "blocks.start, start_after = N: required both or none: a block, and after how many moves it stands");
    const auto& n = result_.block_numbers;
    require(!n || n->last >= n->step, "block_numbers: last is below step; required at least the first number");
    constexpr double kMostPerInch = 0.1;
    require(inches_.empty() || result_.number("x").per_unit < kMostPerInch,
            fmt::format("{} looks like inches, and numbers.x.per_unit = {}; required 0.03937007874015748 for every "
                        "place and feed, or lines in mm",
                        inches_, result_.number("x").per_unit));
  }

  void check_moves() const {
    const TemplateBlock &move = result_.move, &halt = result_.halt;
    const bool speeds = result_.speeds;
    require(count_in(move, {"x", "dx"}) == 1 && count_in(move, {"y", "dy"}) == 1,
            "blocks.move: required one of {x} and {dx}, and one of {y} and {dy}");
    require(count_in(halt, {"x", "dx"}) < 2 && count_in(halt, {"y", "dy"}) < 2,
            "blocks.halt: required at most one of {x} and {dx}, and one of {y} and {dy}");
    if (speeds) {
      require(count_in(move, {"t", "time"}) == 1 && count_in(move, {"f"}) == 0,
              "blocks.move: with speeds = true, required one of {t} and {time} and no {f}");
      require(count_in(move, {"vx", "vy"}) == 2, "blocks.move: with speeds = true, required {vx} and {vy}");
    } else {
      require(count_in(move, {"t", "time", "f"}) == 1, "blocks.move: required one of {t}, {time} and {f}");
      require(count_in(move, {"vx", "vy"}) == 0, "blocks.move: says velocities; required speeds = true");
      require(!result_.longest_step, "longest_step_s: is of moves with velocities; required speeds = true");
    }
    require(halt.empty() || count_in(halt, {"t", "time"}) == 1, "blocks.halt: required one of {t} and {time}");
    require(!count_in(move, {"time"}) || halt.empty() || count_in(halt, {"time"}) == 1,
            "blocks.halt: required {time}, as in blocks.move");
  }

  ProgramTemplate result_;
  std::string inches_;  // a line that sets them
};

}  // namespace

double TemplateNumber::step() const { return std::pow(10.0, -decimals) / per_unit; }

TemplateNumber ProgramTemplate::number(const std::string& field) const {
  if (const auto found = numbers.find(field); found != numbers.end()) return found->second;
  constexpr int kDecimalsOfTimes = 9;
  if (field == "t" || field == "time") return {1.0, kDecimalsOfTimes, TemplateNumber::Rounding::Nearest};
  if (field == "n") return {1.0, 0, TemplateNumber::Rounding::Nearest};
  return {};
}

ProgramTemplate parse_program_template(const std::string& text, const std::string& file) {
  try {
    return TemplateParser(file).read(toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: line {}: {}", file, error.source().begin.line, std::string(error.description())));
  }
}

}  // namespace dwell
