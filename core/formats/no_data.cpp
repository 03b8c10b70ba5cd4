#include "core/formats/no_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/formats/smeared_marker.h"

namespace dwell {
namespace {

constexpr std::size_t kLeastRepeats = 4;
constexpr double kFarSpans = 10.0;
constexpr std::size_t kMostCodes = 3;  // heights of a step on the part are all different
constexpr double kNextCode = 1e-3;     // of a code, the distance to the next one
constexpr double kLeftOut = 0.01;      // of the values at either end, one at least, for the span of the others
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::size_t remove_huge(const RawValues& raw, double& largest) {
  std::size_t count = 0;
  for (double& value : *raw.values) {
    if (!is_huge_marker(value / raw.factor)) continue;
    if (!(std::abs(value) < std::abs(largest))) largest = value;
    value = kNone;
    ++count;
  }
  return count;
}

std::size_t remove_marker(const RawValues& raw, double marker) {
  std::size_t count = 0;
  for (double& value : *raw.values) {
    if (std::isnan(value) || !is_marker(value / raw.factor, marker)) continue;
    value = kNone;
    ++count;
  }
  return count;
}

/// An extreme value, and how many values it is or is next to: some programs have a code for each reason (-9999, -9998).
struct Extreme {
  double value = kNone;
  std::size_t count = 0;
  std::vector<double> codes;  // different values among them, up to one too many

  bool holds(double v) const { return std::abs(v - value) <= kNextCode * std::abs(value); }
  void count_if_next(double v) {
    if (!holds(v)) return;
    ++count;
    if (codes.size() <= kMostCodes && std::find(codes.begin(), codes.end(), v) == codes.end()) codes.push_back(v);
  }
  /// Whether it may stand for no data.
  bool may_mark() const { return count >= kLeastRepeats && codes.size() <= kMostCodes && value != 0.0; }
};

/// What 98 % of the values besides the two span, from at most a million of them; and the nearest to either end.
struct Rest {
  double span = 0.0, low = kNone, high = kNone;
};

Rest rest_of(const std::vector<double>& values, const Extreme& low, const Extreme& high) {
  constexpr std::size_t kSamples = 1'000'000;
  const std::size_t step = values.size() / kSamples + 1;
  Rest rest;
  std::vector<double> samples;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double v = values[i];
    const bool marks = (low.may_mark() && low.holds(v)) || (high.may_mark() && high.holds(v));
    if (std::isnan(v) || marks) continue;
    if (!(v >= rest.low)) rest.low = v;
    if (!(v <= rest.high)) rest.high = v;
    if (i % step == 0) samples.push_back(v);
  }
  if (samples.size() < kLeastRepeats) return rest;
  const auto cut =
      std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(kLeftOut * static_cast<double>(samples.size())), 1);
  const auto first = samples.begin() + cut, last = samples.end() - 1 - cut;
  std::nth_element(samples.begin(), first, samples.end());
  const double from = *first;
  std::nth_element(samples.begin(), last, samples.end());
  rest.span = *last - from;
  return rest;
}

void refuse_smeared(const RawValues& raw, double extreme, const std::string& where, const std::string& name) {
  const double shown = extreme / raw.factor;
  const MarkerRim rim = rim_of_marker(*raw.values, raw.cols, extreme, shown);
  if (rim == MarkerRim::None) return;
  const bool interpolated = rim == MarkerRim::Interpolated;
  throw InputError(fmt::format(
      "{}: {} pixels are {}, {}? Give `{} no data` {} if so{}, or `{} no data` none if it is a height", where,
      std::count(raw.values->begin(), raw.values->end(), extreme), shown,
      interpolated ? "and what lies between it and the others stands at its rim alone: a mark for no data, over which "
                     "was interpolated"
                   : "far from all others: a mark for no data",
      name, shown, interpolated ? " (the rim stays: better take the map from before that)" : "", name));
}

void refuse_far_marks(const RawValues& raw, const Extreme& low, const Extreme& high, const std::string& where,
                      const std::string& name) {
  const Rest rest = rest_of(*raw.values, low, high);
  const auto refuse = [&](const Extreme& extreme, double nearest) {
    const double shown = extreme.value / raw.factor;
    throw InputError(fmt::format(
        "{}: {} pixels are {}{}, and no other is nearer than {}: a mark for no data? Give `{} no data` {} if so, or "
        "`{} no data` none if it is a height",
        where, extreme.count, shown, extreme.codes.size() > 1 ? " or next to it" : "", nearest / raw.factor, name,
        shown, name));
  };
  const auto lone = [&](const Extreme& extreme, double nearest) {
    const double gap = std::abs(nearest - extreme.value);
    return extreme.may_mark() && rest.span > 0.0 && gap > kFarSpans * rest.span;
  };
  if (lone(low, rest.low)) refuse(low, rest.low);
  if (lone(high, rest.high)) refuse(high, rest.high);
}

void refuse_lone_extreme(const RawValues& raw, const std::string& where, const std::string& name) {
  Extreme low, high;
  for (const double v : *raw.values) {
    if (std::isnan(v)) continue;
    if (!(v >= low.value)) low.value = v;
    if (!(v <= high.value)) high.value = v;
  }
  for (const double v : *raw.values) {
    low.count_if_next(v);
    high.count_if_next(v);
  }
  if (low.may_mark() || high.may_mark()) refuse_far_marks(raw, low, high, where, name);
  refuse_smeared(raw, low.value, where, name);
  refuse_smeared(raw, high.value, where, name);
}

}  // namespace

bool is_huge_marker(double value) {
  const double size = std::abs(value);
  if (!(size >= kLeastMarker) || std::isinf(value)) return false;
  // The largest numbers are often written with two or three digits, as 3.4e38.
  constexpr double kFewDigits = 5e-3, kSinglePrecision = 1e-6;
  constexpr std::array kLargest{3.4028234663852886e38,
                                1.7014117331926443e38,
                                9.969209968386869e36,
                                1.2676506002282294e30,
                                1.7976931348623157e308,
                                8.988465674311579e307,
                                1e300};
  // Of netCDF, Surfer and others; and those of GrADS.
  constexpr std::array kWritten{9.999e20, 9.99e33, 1e308};
  const auto within = [size](double part) {
    return [size, part](double marker) { return std::abs(size / marker - 1.0) <= part; };
  };
  if (std::any_of(kLargest.begin(), kLargest.end(), within(kFewDigits))) return true;
  if (std::any_of(kWritten.begin(), kWritten.end(), within(kSinglePrecision))) return true;
  constexpr double kLargestPower = 38.0;  // that single precision holds
  const double power = std::round(std::log10(size));
  return power <= kLargestPower && within(kSinglePrecision)(std::pow(10.0, power));
}

bool is_marker(double value, double marker) {
  constexpr double kRounding = 1e-12;  // of a factor that the reader has multiplied by
  return value == marker || value == static_cast<double>(static_cast<float>(marker)) ||
         std::abs(value - marker) <= kRounding * std::abs(value);
}

NoDataMarkers parse_no_data(const std::string& text) {
  NoDataMarkers markers;
  if (text == "none") return markers;
  for (const std::string_view field : split(text, ',')) {
    const auto value = finite_number(field);
    if (!value) {
      throw InputError(
          fmt::format("'{}'; accepted: a finite number as the file holds it, several separated by commas, "
                      "or none",
                      text));
    }
    markers.values.push_back(*value);
  }
  return markers;
}

std::string to_string(const NoDataMarkers& markers) {
  std::string text;
  for (const double value : markers.values) text += (text.empty() ? "" : ",") + fmt::format("{}", value);
  return text.empty() ? "none" : text;
}

std::vector<std::string> remove_no_data(const RawValues& raw, const std::optional<NoDataMarkers>& asked,
                                        const std::string& where, const std::string& name) {
  std::vector<std::string> history;
  double largest = 0.0;
  if (const std::size_t count = remove_huge(raw, largest); count > 0) {
    history.push_back(fmt::format("no data: {} of the usual marks ({:g} and more), as {:g}", counted(count, "pixel"),
                                  kLeastMarker, largest / raw.factor));
  }
  for (const double marker : raw.no_data) {
    history.push_back(
        fmt::format("no data: {} of {}, as the file says", counted(remove_marker(raw, marker), "pixel"), marker));
  }
  for (const double marker : asked ? asked->values : std::vector<double>()) {
    history.push_back(fmt::format("no data: {} of {}, as asked", counted(remove_marker(raw, marker), "pixel"), marker));
  }
  if (!asked || !asked->values.empty()) refuse_lone_extreme(raw, where, name);
  return history;
}

}  // namespace dwell
