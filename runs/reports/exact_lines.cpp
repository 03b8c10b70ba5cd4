#include "runs/reports/exact_lines.h"

#include <fmt/format.h>

#include "core/base/counted.h"
#include "core/base/number_text.h"

namespace dwell {

std::string exact_lines(const ExactResidual& e) {
  const std::string pixels = e.all ? fmt::format("all {}", counted(e.checked, "pixel"))
                                   : fmt::format("{} of {} pixels (standard error {:.2g} nm)", e.checked,
                                                 e.statistics.valid_pixels, e.standard_error);
  return fmt::format(
             "exact     from the removal function itself at {}; its spline on the lattice is {:.2g} nm RMS off\n",
             pixels, e.lattice_error) +
         fmt::format(
             "ripple    RMS {:.3g} nm (standard error {:.2g} nm) within pixels, finer than the map shows; with it RMS "
             "{:.4g} nm{} in all\n",
             e.ripple, e.ripple_error, e.total(), about_zero_in_words(e.statistics));
}

std::optional<std::string> more_than_before(const ExactResidual& exact, const MapStatistics& before) {
  const double left = exact.statistics.rms_about_zero(), was = before.rms_about_zero();
  constexpr double kRounding = 1e-9;  // relative: a program that removes nothing leaves what there was
  if (left <= (1.0 + kRounding) * was) return std::nullopt;
  const auto [now, before_it] = told_apart(left, was);
  const char* const about =
      *about_zero_in_words(before) != '\0' ? about_zero_in_words(before) : about_zero_in_words(exact.statistics);
  return fmt::format("the program leaves more than there was: {} nm RMS{}, before {} nm", now, about, before_it);
}

}  // namespace dwell
