#include "runs/drawing/colour_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/errors.h"

namespace dwell {
namespace {

constexpr std::array<Colour, 11> kViridis{{{0x44, 0x01, 0x54},
                                           {0x48, 0x25, 0x76},
                                           {0x41, 0x44, 0x87},
                                           {0x35, 0x60, 0x8D},
                                           {0x2A, 0x78, 0x8E},
                                           {0x21, 0x90, 0x8C},
                                           {0x22, 0xA8, 0x84},
                                           {0x43, 0xBF, 0x71},
                                           {0x7A, 0xD1, 0x51},
                                           {0xBB, 0xDF, 0x27},
                                           {0xFD, 0xE7, 0x25}}};

// Every sixteenth of the 256 colours of CET-D1A (P. Kovesi, CC BY 4.0), the ends included.
constexpr std::array<Colour, 17> kBlueWhiteRed{{{23, 41, 114},
                                                {29, 59, 161},
                                                {40, 78, 207},
                                                {81, 101, 230},
                                                {119, 125, 243},
                                                {152, 151, 252},
                                                {184, 179, 250},
                                                {213, 208, 246},
                                                {238, 227, 232},
                                                {251, 201, 191},
                                                {253, 164, 146},
                                                {248, 126, 104},
                                                {232, 91, 70},
                                                {212, 53, 40},
                                                {184, 7, 16},
                                                {143, 3, 9},
                                                {102, 7, 2}}};

std::uint8_t blend(std::uint8_t a, std::uint8_t b, double weight) {
  return static_cast<std::uint8_t>(std::lround((1.0 - weight) * a + weight * b));
}

double quantile(std::vector<double>& values, double fraction) {
  const auto at = static_cast<std::ptrdiff_t>(std::lround(fraction * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

double robust_magnitude(std::vector<double> values, double largest) {
  for (double& v : values) v = std::abs(v);
  const double typical = quantile(values, 0.995);
  return typical > 0.0 ? std::min(largest, 1.5 * typical) : largest;
}

/// Smallest and largest of the finite values.
ColourLimits extent_of(const std::vector<double>& values) {
  ColourLimits limits;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    least = std::min(least, v);
    most = std::max(most, v);
  }
  limits.any = least <= most;
  if (limits.any) limits.smallest = least, limits.largest = most;
  return limits;
}

/// The finite values; if there are many, some million of them at equal distances, which is enough for quantiles. The
/// distance is odd, so as not to meet the same column of a map again and again.
std::vector<double> some_finite(const std::vector<double>& values) {
  constexpr std::size_t kEnough = 1000000;
  const std::size_t step = values.size() <= kEnough ? 1 : (values.size() / kEnough) | 1U;
  std::vector<double> finite;
  finite.reserve(values.size() / step + 1);
  for (std::size_t i = 0; i < values.size(); i += step) {
    if (std::isfinite(values[i])) finite.push_back(values[i]);
  }
  return finite;
}

void check_given(std::optional<double> limit, const char* name) {
  if (limit && !std::isfinite(*limit)) {
    throw InputError(fmt::format("{} colour limit = {}; must be finite", name, *limit));
  }
}

void set_diverging(ColourLimits& limits, const std::vector<double>& finite, std::optional<double> lower,
                   std::optional<double> upper) {
  if ((lower && !(*lower < 0.0)) || (upper && !(*upper > 0.0))) {
    throw InputError(fmt::format("{} colour limit = {}; a scale about zero needs lower < 0 < upper",
                                 lower && !(*lower < 0.0) ? "lower" : "upper",
                                 lower && !(*lower < 0.0) ? *lower : *upper));
  }
  if (lower || upper) {
    limits.lower = lower ? *lower : -*upper;
    limits.upper = upper ? *upper : -*lower;
    return;
  }
  const double largest = limits.any ? std::max(std::abs(limits.smallest), std::abs(limits.largest)) : 0.0;
  const double magnitude = largest > 0.0 ? robust_magnitude(finite, largest) : 1.0;
  limits.lower = -magnitude;
  limits.upper = magnitude;
}

void set_sequential(ColourLimits& limits, std::vector<double>& finite, std::optional<double> lower,
                    std::optional<double> upper) {
  if (limits.any) {
    const double low = quantile(finite, 0.005);
    const double high = quantile(finite, 0.995);
    const double margin = 0.5 * (high - low);
    limits.lower = margin > 0.0 ? std::max(limits.smallest, low - margin) : limits.smallest;
    limits.upper = margin > 0.0 ? std::min(limits.largest, high + margin) : limits.largest;
  }
  if (lower) limits.lower = *lower;
  if (upper) limits.upper = *upper;
  if (limits.lower < limits.upper) return;
  if (lower && upper) {
    throw InputError(fmt::format("colour limits = {}, {}; lower < upper required", *lower, *upper));
  }
  // For one value everywhere, or a single limit on the far side of all values, the range extends by some width beyond
  // it.
  const double width = limits.any && limits.largest != 0.0 ? 0.1 * std::abs(limits.largest) : 1.0;
  if (upper) {
    limits.lower = *upper - std::max(width, 0.1 * std::abs(*upper));
  } else if (lower) {
    limits.upper = *lower + std::max(width, 0.1 * std::abs(*lower));
  } else {
    limits.lower -= width;
    limits.upper += width;
  }
}

}  // namespace

Colour colour_at(ColourMap map, double fraction) {
  if (std::isnan(fraction)) return kNoDataColour;
  const std::span<const Colour> table =
      map == ColourMap::Sequential ? std::span<const Colour>(kViridis) : kBlueWhiteRed;
  const double position = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(table.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(position), table.size() - 2);
  const double weight = position - static_cast<double>(below);
  const Colour& a = table[below];
  const Colour& b = table[below + 1];
  return {blend(a.red, b.red, weight), blend(a.green, b.green, weight), blend(a.blue, b.blue, weight)};
}

ColourLimits colour_limits(const std::vector<double>& values, ColourMap map, std::optional<double> lower,
                           std::optional<double> upper) {
  check_given(lower, "lower");
  check_given(upper, "upper");
  ColourLimits limits = extent_of(values);
  std::vector<double> finite = some_finite(values);
  if (limits.any && finite.empty()) finite = {limits.smallest, limits.largest};
  if (map == ColourMap::Diverging) {
    set_diverging(limits, finite, lower, upper);
  } else {
    set_sequential(limits, finite, lower, upper);
  }
  return limits;
}

ColourLimits same_limits(const ColourLimits& chosen, const std::vector<double>& values) {
  ColourLimits limits = extent_of(values);
  limits.lower = chosen.lower;
  limits.upper = chosen.upper;
  return limits;
}

}  // namespace dwell
