#include "runs/drawing/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runs/drawing/sheet.h"

namespace dwell {
namespace {

// mantissa * 10^exponent, the multiple by which ticks are apart. Powers of ten below one divide, since 10^-k is
// not a binary fraction but 10^k is exact: 3 / 10 prints as 0.3 where 3 * 0.1 would not.
struct Step {
  int mantissa = 1;
  int exponent = 0;

  double multiple(double count) const {
    const double power = std::pow(10.0, std::abs(exponent));
    return exponent < 0 ? count * mantissa / power : count * mantissa * power;
  }
};

struct Multiples {
  double first = 0.0;
  double last = -1.0;

  double count() const { return last - first + 1.0; }
};

// Multiples within the range; an end that misses one by rounding has it.
Multiples multiples_within(const Step& step, double lower, double upper) {
  constexpr double kSlack = 1e-9;
  const double size = step.multiple(1.0);
  return {std::ceil(lower / size - kSlack), std::floor(upper / size + kSlack)};
}

std::string label(double value, double largest, const Step& step) {
  if (value == 0.0) return "0";
  if (largest >= 1e6 || largest < 1e-3) {
    const int digits = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9)) - step.exponent;
    return fmt::format("{:.{}e}", value, std::max(0, digits));
  }
  return fmt::format("{:.{}f}", value, std::max(0, -step.exponent));
}

bool is_decade_multiple(int mantissa) { return mantissa == 1 || mantissa == 2 || mantissa == 5; }

}  // namespace

AxisTicks round_ticks(double lower, double upper, int most) {
  if (!(std::isfinite(lower) && std::isfinite(upper) && lower < upper) || most < 1) {
    throw std::invalid_argument(fmt::format("ticks of [{}, {}], at most {}", lower, upper, most));
  }
  const double largest = std::max(std::abs(lower), std::abs(upper));
  const double range = upper - lower;
  if (!(range > 1e-9 * largest) || !std::isfinite(range)) return {{lower}, {fmt::format("{:g}", lower)}};

  // Starting a decade too fine, the first step that is coarse enough is the smallest one.
  Step step{1, static_cast<int>(std::floor(std::log10(range / most))) - 1};
  Multiples found = multiples_within(step, lower, upper);
  while (found.count() > most) {
    const Step coarser{step.mantissa == 1   ? 2
                       : step.mantissa == 2 ? 5
                                            : 1,
                       step.exponent + (step.mantissa == 5 ? 1 : 0)};
    const Multiples fewer = multiples_within(coarser, lower, upper);
    if (fewer.count() < 1.0) {
      // Between two and none (possible for most = 1 only): one of the two.
      found.last = found.first;
      break;
    }
    step = coarser;
    found = fewer;
  }
  AxisTicks ticks;
  for (double k = found.first; k <= found.last; k += 1.0) {
    const double value = k == 0.0 ? 0.0 : step.multiple(k);
    ticks.values.push_back(value);
    ticks.labels.push_back(label(value, largest, step));
  }
  return ticks;
}

AxisTicks log_ticks(double lower, double upper, int most) {
  if (!(0.0 < lower && lower < upper && std::isfinite(upper)) || most < 3) {
    throw std::invalid_argument(fmt::format("logarithmic ticks of [{}, {}], at most {}", lower, upper, most));
  }
  AxisTicks fine, decades;
  const int first = static_cast<int>(std::floor(std::log10(lower))), last = static_cast<int>(std::log10(upper)) + 1;
  for (int exponent = first; exponent <= last; ++exponent) {
    for (int mantissa = 1; mantissa < 10; ++mantissa) {
      const double value = mantissa * std::pow(10.0, exponent);
      if (!is_decade_multiple(mantissa) || value < lower || value > upper) continue;
      for (AxisTicks* ticks : {&fine, &decades}) {
        if (ticks == &decades && mantissa != 1) continue;
        ticks->values.push_back(value);
        ticks->labels.push_back(fmt::format("{:.6g}", value));
      }
    }
  }
  if (fine.values.size() < 3) return round_ticks(lower, upper, most);
  return fine.values.size() <= static_cast<std::size_t>(most) ? fine : decades;
}

double AxisRange::share(double value) const {
  if (!(value > lower)) return 0.0;
  const double share = scale == AxisScale::Linear ? (value - lower) / (upper - lower)
                                                  : std::log(value / lower) / std::log(upper / lower);
  return std::min(share, 1.0);
}

bool AxisRange::holds(double value) const {
  return std::isfinite(value) && (scale == AxisScale::Linear || value > 0.0);
}

AxisTicks AxisRange::ticks(double length, AxisDirection direction, const TextStyle& style) const {
  const bool is_linear = scale == AxisScale::Linear;
  const int least = is_linear ? 1 : 3;
  for (int most = 10;; --most) {
    AxisTicks ticks = is_linear ? round_ticks(lower, upper, most) : log_ticks(lower, upper, most);
    double room = 1.6 * style.size, gap = length;
    for (std::size_t i = 0; i < ticks.values.size(); ++i) {
      if (direction == AxisDirection::Across)
        room = std::max(room, Sheet::text_width(ticks.labels[i], style) + style.size);
      if (i > 0) gap = std::min(gap, length * (share(ticks.values[i]) - share(ticks.values[i - 1])));
    }
    if (gap >= room || most == least) return ticks;
  }
}

}  // namespace dwell
