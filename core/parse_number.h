#pragma once

#include <optional>
#include <string_view>

namespace dwell {

/// The number that the whole text spells, blanks around it and one leading '+' allowed, independent of the locale;
/// nothing if it spells none or one out of range. "inf" and "nan" are numbers here: the caller checks the range.
std::optional<double> parse_number(std::string_view text);

/// The text without blanks and tabs (and a carriage return) at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace dwell
