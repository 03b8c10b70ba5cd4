#include "core/formats/remark_words.h"

#include "core/base/number_text.h"
#include "core/formats/map_terms.h"

namespace dwell {
namespace {

constexpr std::string_view kBlanks = " \t\r\n", kSigns = ",;:=()[]{}\"'|<>";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_between_digits(std::string_view text, std::size_t at) {
  return at > 0 && at + 1 < text.size() && is_digit(text[at - 1]) && is_digit(text[at + 1]);
}

bool ends_word(std::string_view text, std::size_t at) {
  const char c = text[at];
  if (kBlanks.find(c) != std::string_view::npos) return true;
  if (kSigns.find(c) == std::string_view::npos) return false;
  return !((c == ',' || c == ':') && is_between_digits(text, at));
}

bool begins_with_number(std::string_view word) {
  const std::size_t at = word.find_first_not_of("+-.~<>");
  return at != std::string_view::npos && is_digit(word[at]);
}

void finish(RemarkWord& word) {
  while (word.text.size() > 1 && (word.text.back() == '.' || word.text.back() == '!' || word.text.back() == '?')) {
    word.text.pop_back();
    word.dot = true;
  }
  word.folded = fold_letters(word.text);
  word.number = begins_with_number(word.text) || is_digit(word.text.back());
}

}  // namespace

std::vector<RemarkWord> remark_words(std::string_view remark) {
  const std::string text = with_letter_times(remark);
  std::vector<RemarkWord> words;
  RemarkWord word;
  word.clause = true;
  const auto end_word = [&] {
    if (word.text.empty()) return;
    finish(word);
    words.push_back(word);
    word = RemarkWord();
    word.clause = words.back().dot;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!ends_word(text, i)) {
      word.text += text[i];
      continue;
    }
    end_word();
    const char c = text[i];
    if (kBlanks.find(c) != std::string_view::npos) continue;
    word.before = c == '{' ? '[' : c;
    word.clause = word.clause || c == ',' || c == ';' || c == '|';
    if ((c == ')' || c == ']' || c == '}') && !words.empty()) words.back().closed = true;
  }
  end_word();
  return words;
}

}  // namespace dwell
