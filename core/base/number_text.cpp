#include "core/base/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace dwell {
namespace {

struct Parsed {
  double value = 0.0;
  bool whole = false;  // the text is one number and nothing else
  bool out_of_range = false;
};

Parsed parse(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Parsed parsed;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, parsed.value);
  parsed.out_of_range = error == std::errc::result_out_of_range;
  parsed.whole = error == std::errc() && stop == end;
  return parsed;
}

}  // namespace

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string shown;
  for (const char c : text.substr(0, kLongest)) {
    if (c == '\t') {
      shown += "\\t";
    } else {
      shown += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return fmt::format("'{}{}'", shown, text.size() > kLongest ? "..." : "");
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    fields.push_back(text.substr(begin, end == std::string_view::npos ? end : end - begin));
    if (end == std::string_view::npos) return fields;
    begin = end + 1;
  }
}

std::optional<double> parse_number(std::string_view text) {
  const Parsed parsed = parse(trim(text));
  return parsed.whole ? std::optional(parsed.value) : std::nullopt;
}

std::optional<double> finite_number(std::string_view text) {
  const Parsed parsed = parse(trim(text));
  if (!parsed.whole || !std::isfinite(parsed.value)) return std::nullopt;
  return parsed.value;
}

double fewest_digits(double value) {
  constexpr double kSame = 1e-12;
  constexpr int kMostDigits = 10;
  if (!std::isfinite(value)) return value;
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof(text), value, std::chars_format::scientific, digits - 1).ptr;
    double shorter = 0.0;
    std::from_chars(text, end, shorter);
    if (std::abs(shorter - value) <= kSame * std::abs(value)) return shorter;
  }
  return value;
}

std::pair<std::string, std::string> told_apart(double a, double b) {
  constexpr int kFewest = 4, kMost = 17;
  for (int digits = kFewest;; ++digits) {
    std::pair<std::string, std::string> texts{fmt::format("{:.{}g}", a, digits), fmt::format("{:.{}g}", b, digits)};
    if (texts.first != texts.second || digits == kMost) return texts;
  }
}

bool starts_with_spreadsheet_error(std::string_view line) {
  line = trim(line);
  if (line.starts_with('"')) line.remove_prefix(1);
  // As spreadsheets in English, German and French write them.
  constexpr std::array<std::string_view, 19> kErrors{
      "#n/a",    "#div/0!", "#num!", "#value!", "#null!", "#ref!",   "#name?",   "#spill!",  "#calc!", "#getting_data",
      "#field!", "#busy!",  "#nv",   "#zahl!",  "#wert!", "#bezug!", "#nombre!", "#valeur!", "#nul!"};
  const std::string lower = lower_case(line.substr(0, 16));
  return std::any_of(kErrors.begin(), kErrors.end(), [&](std::string_view error) { return lower.starts_with(error); });
}

namespace {

/// What spreadsheets (English, German, French), R, Python and its libraries, databases and the C library of Windows
/// write where a value is missing or has no number. #REF! and #NAME? are a broken formula, and 1.#INF is infinite.
bool means_no_value(std::string_view text) {
  constexpr std::array<std::string_view, 29> kWords{
      "no data", "n/a",      "na",       "#n/a",  "#div/0!", "#num!",    "#value!", "#null!",  "#nv",    "#zahl!",
      "#wert!",  "#nombre!", "#valeur!", "#nul!", "nodata",  "no_data",  "none",    "null",    "masked", "--",
      "bad",     "missing",  "invalid",  "<na>",  "1.#qnan", "-1.#qnan", "1.#ind",  "-1.#ind", "1.#snan"};
  return std::find(kWords.begin(), kWords.end(), lower_case(text)) != kWords.end();
}

}  // namespace

std::optional<double> height_number(std::string_view text) {
  text = trim(text);
  if (text.size() >= 2 && text.starts_with('"') && text.ends_with('"')) text = trim(text.substr(1, text.size() - 2));
  const Parsed parsed = parse(text);
  if (parsed.whole && std::isfinite(parsed.value)) return parsed.value;
  const bool no_data = text.empty() || (parsed.whole && std::isnan(parsed.value)) || means_no_value(text);
  if (no_data) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

std::string why_no_height(std::string_view text) {
  text = trim(text);
  const Parsed parsed = parse(text);
  if (parsed.whole)
    return fmt::format("{} is infinite; a finite number, or nan for no data, is required", in_quotes(text));
  if (parsed.out_of_range) return fmt::format("{} is outside the range of a double", in_quotes(text));
  std::string reason = fmt::format("{} is not a number", in_quotes(text));
  std::string pointed(text);
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  if (pointed != text && parse(pointed).whole) return reason + "; a decimal comma is not accepted, write a point";
  return reason + "; a number with a decimal point, or nan for no data, is required (one kind of separator a file)";
}

}  // namespace dwell
