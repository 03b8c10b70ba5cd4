#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dwell {

/// How many bytes the character at the front takes, or 0 if these are no UTF-8 (RFC 3629).
std::size_t utf8_length(std::string_view text);

bool is_utf8(std::string_view text);

/// The text with each byte that is no UTF-8 written as \xE9: names of files may hold any byte, JSON, figures and the
/// comments of programs may not. What is UTF-8 stays as it is.
std::string with_escaped_bytes(std::string_view text);

/// The text with each \xE9 as that byte: what with_escaped_bytes was given, unless that held such letters itself.
std::string with_bytes_of_escapes(std::string_view text);

}  // namespace dwell
