#include "runs/programs/template_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {
namespace {

/// How many characters at the beginning of a text are a decimal number; 0 if it begins with none.
std::size_t decimal_number_length(std::string_view text) {
  std::size_t at = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  std::size_t digits = 0;
  bool point = false;
  for (; at < text.size(); ++at) {
    if (text[at] >= '0' && text[at] <= '9') {
      ++digits;
    } else if (text[at] == '.' && !point) {
      point = true;
    } else {
      break;
    }
  }
  return digits > 0 ? at : 0;
}

}  // namespace

TemplateLine::TemplateLine(std::string_view text, const std::string& where) {
  Piece piece;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '}')
      throw InputError(fmt::format("{}: '{}' has a closing brace without an opening one", where, text));
    if (text[at] != '{') {
      piece.literal += text[at];
      continue;
    }
    const std::size_t end = text.find('}', at);
    if (end == std::string_view::npos)
      throw InputError(fmt::format("{}: '{}' has a brace that is not closed", where, text));
    piece.field = text.substr(at + 1, end - at - 1);
    if (piece.field.empty()) throw InputError(fmt::format("{}: '{}' has a field without a name", where, text));
    if (!pieces_.empty() && piece.literal.empty())
      throw InputError(fmt::format("{}: '{}' has two fields with nothing between them", where, text));
    pieces_.push_back(std::exchange(piece, {}));
    at = end;
  }
  pieces_.push_back(piece);
}

std::vector<std::string> TemplateLine::fields() const {
  std::vector<std::string> names;
  for (const Piece& piece : pieces_) {
    if (!piece.field.empty()) names.push_back(piece.field);
  }
  return names;
}

std::string TemplateLine::text() const {
  std::string text;
  for (const Piece& piece : pieces_) text += piece.literal + (piece.field.empty() ? "" : "{" + piece.field + "}");
  return text;
}

std::string TemplateLine::fill(const std::vector<std::string>& texts) const {
  std::string line;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    line += pieces_[k].literal;
    if (!pieces_[k].field.empty()) line += texts.at(k);
  }
  return line;
}

std::optional<std::vector<std::string_view>> TemplateLine::match(std::string_view line) const {
  line = trim(line);
  std::vector<std::string_view> texts;
  for (const Piece& piece : pieces_) {
    std::string_view literal = piece.literal;
    if (&piece == &pieces_.front()) literal.remove_prefix(std::min(literal.find_first_not_of(" \t"), literal.size()));
    if (piece.field.empty()) literal = literal.substr(0, literal.find_last_not_of(" \t") + 1);
    if (!line.starts_with(literal)) return std::nullopt;
    line.remove_prefix(literal.size());
    if (piece.field.empty()) continue;
    const std::size_t length = decimal_number_length(line);
    if (length == 0) return std::nullopt;
    texts.push_back(line.substr(0, length));
    line.remove_prefix(length);
  }
  if (!line.empty()) return std::nullopt;
  return texts;
}

}  // namespace dwell
