#pragma once

#include <string_view>

namespace dwell {

/// Whether a line of a text map is a comment: it begins with '#', in quotes or not, and not with what a spreadsheet
/// writes for a missing number ("#N/A").
bool is_text_comment(std::string_view line);

/// What a comment says: without '#', the quotes around it, and the separators that spreadsheets pad a line with
/// (`"# unit: um",,`).
std::string_view bare_comment(std::string_view line);

}  // namespace dwell
