#include "core/base/value_range.h"

#include <fmt/format.h>

#include "core/base/errors.h"

namespace dwell {

std::string ValueRange::text() const {
  const std::string with_unit = *unit == '\0' ? "" : fmt::format(" ({})", unit);
  return fmt::format("a number from {:g} to {:g}{}", least, most, with_unit);
}

void check_range(const std::string& field, double value, const ValueRange& range) {
  if (range.holds(value)) return;
  throw InputError(field, fmt::format("{}{}{}", value, *range.unit == '\0' ? "" : " ", range.unit), range.text());
}

}  // namespace dwell
