#include "solvers/weights/time_worth.h"

#include <fmt/format.h>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"

namespace dwell {

RuledPrice worth_of_time(const TimeWorth& worth, const LeftAndTotal& least, const LeftAndTotal& plan) {
  RuledPrice ruled;
  if (plan.total > 0.0) ruled.price = worth.share * plan.half_mean_square / plan.total;
  const double gained = least.half_mean_square - plan.half_mean_square, taken = plan.total - least.total;
  if (!(gained > 0.0) || !(taken > 0.0)) return ruled;
  const double average = worth.average * gained / taken;
  if (average < ruled.price) ruled = {average, PriceRule::Average};
  return ruled;
}

TimeWorth parse_time_worth(const std::string& text) {
  constexpr ValueRange kWorths{1e-6, 1e3, ""};
  const std::string words(trim(text));
  const std::size_t comma = words.find(',');
  const auto share = finite_number(trim(std::string_view(words).substr(0, comma)));
  TimeWorth worth;
  bool good = share && kWorths.holds(*share);
  if (good) worth.share = *share;
  if (comma != std::string::npos) {
    const auto average = finite_number(trim(std::string_view(words).substr(comma + 1)));
    good = good && average && kWorths.holds(*average);
    if (good) worth.average = *average;
  }
  if (!good) {
    throw InputError(
        fmt::format("'{}'; required K or K,MU, each {}: one per cent more time must lower the mean square "
                    "left by K per cent; the next second must be worth MU of the average one",
                    text, kWorths.text()));
  }
  return worth;
}

std::string to_string(const TimeWorth& worth) { return fmt::format("{},{}", worth.share, worth.average); }

}  // namespace dwell
