#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dwell {

/// The text without the blanks, tabs and carriage returns at both ends.
std::string_view trim(std::string_view text);

std::string lower_case(std::string_view text);

/// The fields between separators, untrimmed; n separators make n + 1 fields.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The number that the whole of `text` spells, blanks around it and one leading '+' allowed, whatever the locale;
/// nothing if it spells none or one out of range. "inf" and "nan" are numbers here: the caller checks the range.
std::optional<double> parse_number(std::string_view text);

/// The finite number that the whole of `text` spells, blanks around it and a leading '+' allowed; nothing if it
/// spells anything else (NaN and infinity included). Decimal point only, whatever the locale.
std::optional<double> finite_number(std::string_view text);

/// Two numbers with four digits, or as many more as make them differ (17 tell any two apart).
std::pair<std::string, std::string> told_apart(double a, double b);

/// Whether a line begins with what spreadsheets write where a formula has no value (#N/A, #DIV/0!, #REF!): '#' begins
/// no comment there.
bool starts_with_spreadsheet_error(std::string_view line);

/// The number of fewest digits, ten at most, that agrees to 1e-12 of the value: 0.003 of 0.0029999999999999996, which a
/// change of units made of it. A value that has more digits, as 1/3, stays.
double fewest_digits(double value);

/// A height as map files write it: a finite number, or NaN for "no data" (empty, nan, No Data, NA, N/A, None, NULL,
/// masked, --, BAD, 1.#QNAN, -1.#IND, and the #N/A, #DIV/0!, #NUM!, #VALUE!, #NULL! of spreadsheets; any case), in
/// quotes or not. Nothing if it is neither: #REF! and #NAME? are a broken formula.
std::optional<double> height_number(std::string_view text);

/// The text in quotes for an error message: its first 40 characters, a tab as \t, other control characters as
/// blanks.
std::string in_quotes(std::string_view text);

/// Why height_number refused `text`, with the text quoted, for an error message.
std::string why_no_height(std::string_view text);

}  // namespace dwell
