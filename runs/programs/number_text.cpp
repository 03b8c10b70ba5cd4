#include "runs/programs/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "core/base/units.h"

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

/// "{:.<decimals>f}", by integers where the value times 10^decimals is clearly nearest to one: its rounding, below
/// 2e-4 there, cannot reach the next one. Millions of numbers are written so.
std::string fixed_text(double value, int decimals) {
  constexpr double kMost = 1e12, kClearly = 0.499;
  constexpr int kMostDecimals = 15;  // powers of ten that are exact, as a double and as an integer
  static constexpr auto kPowers = [] {
    std::array<std::int64_t, kMostDecimals + 1> powers{1};
    for (std::size_t k = 1; k < powers.size(); ++k) powers[k] = 10 * powers[k - 1];
    return powers;
  }();
  if (decimals <= kMostDecimals) {
    const std::int64_t power = kPowers[static_cast<std::size_t>(decimals)];
    const double scaled = std::abs(value) * static_cast<double>(power), nearest = std::floor(scaled + 0.5);
    if (nearest < kMost && std::abs(scaled - nearest) <= kClearly) {
      const auto units = static_cast<std::int64_t>(nearest);
      std::array<char, 40> buffer;
      char* at = buffer.data();
      if (std::signbit(value)) *at++ = '-';
      at = std::to_chars(at, buffer.data() + buffer.size(), units / power).ptr;
      if (decimals > 0) {
        *at = '.';
        std::int64_t rest = units % power;
        for (int k = decimals; k > 0; --k, rest /= 10) at[k] = static_cast<char>('0' + rest % 10);
        at += decimals + 1;
      }
      return {buffer.data(), at};
    }
  }
  return fmt::format("{:.{}f}", value, decimals);
}

std::string place_text(double value, int decimals) {
  check_finite(value);
  std::string text = fixed_text(value, decimals);
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
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
  constexpr int kDecimals = 6;
  return place_text(mm, kDecimals);
}

std::string inches_text(double mm) {
  constexpr int kDecimals = 8;
  return place_text(mm / units::kMmPerInch, kDecimals);
}

std::string seconds_text(double s) {
  check_finite(s);
  if (!(s >= 0.0)) throw std::logic_error(fmt::format("time {} s cannot be exported; required >= 0", s));
  return fixed_text(s, 9);
}

std::string digits_nearest(double value) {
  const int decimals = decimals_for(value);
  return fixed_text(value, decimals);
}

// The nearest text is at most half a unit of its last digit off, so a step of one unit puts it on the wanted side.
std::string digits_not_above(double value) {
  const int decimals = decimals_for(value);
  std::string text = fixed_text(value, decimals);
  if (number_of(text) > value) text = fixed_text(number_of(text) - std::pow(10.0, -decimals), decimals);
  return text;
}

std::string digits_not_below(double value) {
  const int decimals = decimals_for(value);
  std::string text = fixed_text(value, decimals);
  if (number_of(text) < value) text = fixed_text(number_of(text) + std::pow(10.0, -decimals), decimals);
  return text;
}

}  // namespace dwell
