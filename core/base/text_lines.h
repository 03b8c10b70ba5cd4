#pragma once

#include <string_view>

namespace dwell {

/// The text without the byte-order mark that editors of some systems put before UTF-8.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

/// Walks the lines of a text. A line ends with LF or CR LF, or with CR where the text has no LF at all; the first one
/// is number 1, and a UTF-8 byte-order mark is skipped.
class TextLines {
 public:
  explicit TextLines(std::string_view text)
      : rest_(without_byte_order_mark(text)), end_(text.find('\n') == std::string_view::npos ? '\r' : '\n') {}

  /// Moves to the next line; false at the end.
  bool next() {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find(end_);
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    ++number_;
    return true;
  }

  std::string_view line() const { return line_; }
  long number() const { return number_; }

 private:
  std::string_view rest_;
  char end_;
  std::string_view line_;
  long number_ = 0;
};

}  // namespace dwell
