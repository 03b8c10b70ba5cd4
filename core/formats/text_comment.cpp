#include "core/formats/text_comment.h"

#include "core/base/number_text.h"

namespace dwell {
namespace {

std::string_view without_padding(std::string_view text) {
  constexpr std::string_view kPadding = ",; \t\r";
  const std::size_t last = text.find_last_not_of(kPadding);
  return trim(text.substr(0, last == std::string_view::npos ? 0 : last + 1));
}

std::string_view without_quotes(std::string_view text) {
  if (!text.starts_with('"')) return text;
  text.remove_prefix(1);
  if (text.ends_with('"')) text.remove_suffix(1);
  return trim(text);
}

}  // namespace

bool is_text_comment(std::string_view line) {
  line = trim(line);
  if (starts_with_spreadsheet_error(line)) return false;
  return line.starts_with('#') || line.starts_with("\"#");
}

std::string_view bare_comment(std::string_view line) {
  line = without_quotes(without_padding(line));
  while (line.starts_with('#')) line = trim(line.substr(1));
  return without_quotes(without_padding(line));
}

}  // namespace dwell
