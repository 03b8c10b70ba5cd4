#include "runs/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace dwell {
namespace {

void check_finite(double value) {
  if (!std::isfinite(value))
    throw std::logic_error(fmt::format("number {} cannot be exported; required finite", value));
}

// Decimals that give a value kExportDigits significant digits (one more where a rounding reaches the next power).
int decimals_for(double value) {
  check_finite(value);
  if (!(value >= 0.0)) throw std::logic_error(fmt::format("number {} cannot be exported; required >= 0", value));
  if (!(value > 0.0)) return 0;
  return std::max(0, kExportDigits - 1 - static_cast<int>(std::floor(std::log10(value))));
}

}  // namespace

double number_of(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw std::logic_error(fmt::format("exported number \"{}\" does not read back", text));
  }
  return value;
}

std::string coordinate_text(double mm) {
  check_finite(mm);
  std::string text = fmt::format("{:.6f}", mm);
  if (text == "-0.000000") text.erase(0, 1);
  return text;
}

std::string digits_nearest(double value) {
  const int decimals = decimals_for(value);
  return fmt::format("{:.{}f}", value, decimals);
}

// The nearest text is at most half a unit of its last digit off, so a step of one unit puts it on the wanted side.
std::string digits_not_above(double value) {
  const int decimals = decimals_for(value);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (number_of(text) > value) text = fmt::format("{:.{}f}", number_of(text) - std::pow(10.0, -decimals), decimals);
  return text;
}

std::string digits_not_below(double value) {
  const int decimals = decimals_for(value);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (number_of(text) < value) text = fmt::format("{:.{}f}", number_of(text) + std::pow(10.0, -decimals), decimals);
  return text;
}

}  // namespace dwell
