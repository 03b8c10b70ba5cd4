#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runs/programs/template_line.h"

namespace dwell {

/// How a template writes the numbers of a field.
struct TemplateNumber {
  enum class Rounding { Nearest, Down, Up };

  double per_unit = 1.0;  // what is written for 1 mm, mm/s, mm/min or s: 1000 for micrometres, or counts a mm
  int decimals = 6;
  Rounding rounding = Rounding::Nearest;

  /// The least difference of two numbers, in mm, mm/s, mm/min or s.
  double step() const;
};

/// Numbers before the lines of a program: N10, N20, ... and after `last` again from the first.
struct TemplateBlockNumbers {
  int step = 10;
  int last = 99999;
};

/// The lines that a template writes on one occasion.
using TemplateBlock = std::vector<TemplateLine>;

/// The name of a program by a template in a plan's folder, without the ending that the template gives it.
inline constexpr std::string_view kTemplateProgram = "program_by_template";

/// A layout of machine programs that a shop describes in a file (docs/formats.md, "Templates").
struct ProgramTemplate {
  std::string file;    // of the template, for messages
  std::string name;    // of the layout
  std::string ending;  // of the program's file, with its point
  std::string line_end = "\n";
  std::string comment_begin, comment_end;  // around a comment's text
  int longest_line = 80;
  bool upper_case = false;             // of comments
  bool speeds = false;                 // its moves say velocities: a schedule of speeds is needed
  std::optional<int> every;            // moves of a group, which group_begin and group_end stand around
  std::optional<int> start_after;      // moves after which the block `start` stands; at the end where there are fewer
  std::optional<int> most_lines;       // of a program
  std::optional<double> longest_step;  // of a move [s]; longer ones are cut
  std::optional<TemplateBlockNumbers> block_numbers;
  std::map<std::string, TemplateNumber> numbers;  // of the fields that are not written by default
  TemplateBlock header, begin, travel, lower, move, halt, lift, start, group_begin, group_end, footer;

  TemplateNumber number(const std::string& field) const;
  /// The name of the program in a plan's folder.
  std::string output() const { return std::string(kTemplateProgram) + ending; }
};

/// Reads a template (TOML) from its text; `file` is the name for messages. Throws InputError naming file, line or
/// field, value and what is accepted: an unknown field or section, a field in a block that does not know it, a move
/// without a place or without a time or with two, characters that are no printable ASCII, inches in its lines with
/// numbers that are none.
ProgramTemplate parse_program_template(const std::string& text, const std::string& file);

}  // namespace dwell
