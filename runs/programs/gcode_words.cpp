#include "runs/programs/gcode_words.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool is_numeric(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; }

// The letters and underscores at the beginning: a command of another language, as TRANS.
std::string_view whole_word(std::string_view text) {
  std::size_t size = 0;
  while (size < text.size() && (is_letter(text[size]) || text[size] == '_')) ++size;
  return text.substr(0, size);
}

GcodeWord read_word(std::string_view line, std::size_t& at, const GcodePlace& where) {
  const std::size_t start = at;
  const char letter = line[at++];
  while (at < line.size() && is_blank(line[at])) ++at;
  const std::size_t number_start = at;
  while (at < line.size() && is_numeric(line[at])) ++at;
  GcodeWord word;
  word.letter = letter >= 'a' ? static_cast<char>(letter - 'a' + 'A') : letter;
  word.text = line.substr(start, at - start);
  std::string_view number = line.substr(number_start, at - number_start);
  if (number.starts_with('+') && !number.starts_with("+-")) number.remove_prefix(1);
  const char* const number_end = number.data() + number.size();
  const auto [end, error] = std::from_chars(number.data(), number_end, word.value, std::chars_format::fixed);
  if (error != std::errc() || end != number_end || !std::isfinite(word.value)) {
    throw InputError(fmt::format("{}: \"{}\" has no readable number; required a letter and a decimal number, as X-1.5",
                                 where.text(), word.text.size() == 1 ? whole_word(line.substr(start)) : word.text));
  }
  return word;
}

// What is between the parenthesis at `at` and the next closing one. Some controllers end a comment at the first
// closing parenthesis and others at that which matches, so that what follows an inner one is a move on some machines
// only.
std::string_view read_comment(std::string_view line, std::size_t& at, const GcodePlace& where) {
  const std::size_t close = line.find(')', at);
  if (close == std::string_view::npos) {
    throw InputError(fmt::format("{}: comment \"{}\" is not closed; required )", where.text(), line.substr(at)));
  }
  const std::string_view comment = line.substr(at + 1, close - at - 1);
  if (comment.find('(') != std::string_view::npos) {
    throw InputError(
        fmt::format("{}: comment \"{}\" holds another: controllers disagree on where it ends; required no ( within ( )",
                    where.text(), line.substr(at, line.rfind(')') - at + 1)));
  }
  at = close + 1;
  return comment;
}

// Why a character begins no word.
std::string_view why_no_word(char c) {
  switch (c) {
    case '/':
      return "is a line that the operator may have skipped; required without /";
    case '#':
    case '[':
    case '=':
      return "is an expression or a variable, which is not honoured; required numbers";
    case '%':
      return "stands alone on the first line and after the program; names behind % are not accepted";
    default:
      return "begins no word; required a letter and a decimal number, as X-1.5";
  }
}

}  // namespace

std::string GcodePlace::text() const { return fmt::format("{}, line {}", file, line); }

void split_gcode_line(std::string_view line, const GcodePlace& where, GcodeLine& result) {
  result.words.clear();
  result.comments.clear();
  std::size_t at = 0;
  while (at < line.size()) {
    const char c = line[at];
    if (is_blank(c)) {
      ++at;
    } else if (c == ';') {
      result.comments.push_back(line.substr(at + 1));
      break;
    } else if (c == '(') {
      result.comments.push_back(read_comment(line, at, where));
    } else if (is_letter(c)) {
      result.words.push_back(read_word(line, at, where));
    } else {
      throw InputError(fmt::format("{}: \"{}\" {}", where.text(), trim(line.substr(at)), why_no_word(c)));
    }
  }
}

bool is_tape_mark(std::string_view line) { return trim(line) == "%"; }

}  // namespace dwell
