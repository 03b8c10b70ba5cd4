#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dwell {

/// One word of a G-code line: a letter and its number, "X-1.5".
struct GcodeWord {
  char letter = ' ';      // upper case
  double value = 0.0;     // finite
  std::string_view text;  // as written
};

/// What a G-code line holds. Views point into the line.
struct GcodeLine {
  std::vector<GcodeWord> words;            // in order
  std::vector<std::string_view> comments;  // between ( and ), and after ;
};

/// A line of a program, for messages.
struct GcodePlace {
  const std::string& file;
  std::size_t line = 0;

  std::string text() const;  // "program.nc, line 7"
};

/// Splits a line into `result`, whose memory is used again. Letters in either case, blanks before letters and numbers
/// optional. Numbers are decimal, without exponent. Throws InputError that begins with the place and names the text: a
/// comment that is not closed or holds another, a letter without a number, a character that begins no word.
void split_gcode_line(std::string_view line, const GcodePlace& where, GcodeLine& result);

/// Whether a line is the % that stands before and after a program on tape.
bool is_tape_mark(std::string_view line);

}  // namespace dwell
