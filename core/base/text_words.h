#pragma once

#include <algorithm>
#include <string_view>

#include "core/base/text_lines.h"

namespace dwell {

/// Walks the words of a text, separated by blanks and line ends. What follows the comment character on a line is
/// skipped. Takes whole lines from `lines`, which goes on below the line of the last word.
class TextWords {
 public:
  TextWords(TextLines& lines, char comment) : lines_(lines), comment_(comment) {}

  /// Moves to the next word; false at the end.
  bool next() {
    constexpr std::string_view kBlanks = " \t\r\f\v";
    while (true) {
      rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
      if (!rest_.empty()) break;
      if (!lines_.next()) return false;
      rest_ = lines_.line().substr(0, lines_.line().find(comment_));
    }
    word_ = rest_.substr(0, rest_.find_first_of(kBlanks));
    rest_.remove_prefix(word_.size());
    return true;
  }

  std::string_view word() const { return word_; }
  long line() const { return lines_.number(); }

 private:
  TextLines& lines_;
  char comment_;
  std::string_view rest_;  // of the line
  std::string_view word_;
};

}  // namespace dwell
