#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dwell {

/// A word of a sentence with what stands around it.
struct RemarkWord {
  std::string text;     // as written
  std::string folded;   // as fold_letters gives it
  char before = ' ';    // the last sign before it, blanks aside: one of ,;:=()[]"| or a blank
  bool dot = false;     // a full stop is behind it
  bool number = false;  // begins or ends with a digit: "5", "1e-3", "5mm", "M2"
  bool clause = false;  // a new clause begins here: after , ; | . or at the beginning
  bool closed = false;  // a closing bracket is behind it

  bool bracketed() const { return before == '(' || before == '['; }
};

/// The words of a comment or a text attribute. Commas and colons between digits are part of the word; the sign of
/// multiplication is a word "x". Cost O(length).
std::vector<RemarkWord> remark_words(std::string_view text);

}  // namespace dwell
