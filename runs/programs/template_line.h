#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dwell {

/// A line of a program with places for numbers: "G1 X{x} Y{y} F{f}".
class TemplateLine {
 public:
  struct Piece {
    std::string literal;  // before the field
    std::string field;    // its name; empty after the last one
  };

  /// `where` begins messages. Throws InputError for a brace that is not closed, an empty name and two fields without
  /// anything between them, which could not be told apart when read.
  TemplateLine(std::string_view text, const std::string& where);

  const std::vector<Piece>& pieces() const { return pieces_; }
  std::vector<std::string> fields() const;
  /// As the template has it.
  std::string text() const;

  /// The line with the texts of its fields, in their order.
  std::string fill(const std::vector<std::string>& texts) const;

  /// The texts that the fields have in a line, each a decimal number; nothing if the line is not one of these. Blanks
  /// at both ends do not count.
  std::optional<std::vector<std::string_view>> match(std::string_view line) const;

 private:
  std::vector<Piece> pieces_;
};

}  // namespace dwell
