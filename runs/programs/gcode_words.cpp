#include "runs/programs/gcode_words.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/base/errors.h"

namespace dwell {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
bool is_numeric(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; }

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
                                 where.text(), word.text));
  }
  return word;
}

}  // namespace

std::string GcodePlace::text() const { return fmt::format("{}, line {}", file, line); }

void split_gcode_line(std::string_view line, const GcodePlace& where, GcodeLine& result) {
  result.words.clear();
  result.comments.clear();
  std::size_t at = 0;
  while (at < line.size()) {
    const char c = line[at];
    if (is_blank(c) || c == '%') {
      ++at;
    } else if (c == ';') {
      result.comments.push_back(line.substr(at + 1));
      break;
    } else if (c == '(') {
      const std::size_t close = line.find(')', at);
      if (close == std::string_view::npos) {
        throw InputError(fmt::format("{}: comment \"{}\" is not closed; required )", where.text(), line.substr(at)));
      }
      result.comments.push_back(line.substr(at + 1, close - at - 1));
      at = close + 1;
    } else if (is_letter(c)) {
      result.words.push_back(read_word(line, at, where));
    } else {
      throw InputError(fmt::format("{}: \"{}\" begins no word; required a letter and a decimal number, as X-1.5",
                                   where.text(), line.substr(at)));
    }
  }
}

}  // namespace dwell
