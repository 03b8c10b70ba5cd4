#include "core/formats/value_span.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/base/units.h"

namespace dwell {

void check_value_span(const HeightMap& map, double most, const std::string& name, const std::string& where) {
  double low = std::nan(""), high = low;
  for (const double value : map.values) {
    if (!(value >= low)) low = std::isnan(value) ? low : value;
    if (!(value <= high)) high = std::isnan(value) ? high : value;
  }
  if (std::isnan(low)) {
    throw InputError(fmt::format("{}: all {} values are no data (nan); at least one finite value is required", where,
                                 map.values.size()));
  }
  if (high - low <= most) return;
  const bool rate = map.quantity == MapQuantity::Rate;
  const char* const unit = rate ? "mm/s" : "mm";
  throw InputError(
      fmt::format("{}: {} from {:.6g} to {:.6g} {} (peak to valley {:.6g} {}); at most {:.6g} {} is accepted: is their "
                  "unit right, is "
                  "one of them a mark for no data (`{} no data`)?{}",
                  where, rate ? "rates" : "heights", low / units::kNmPerMm, high / units::kNmPerMm, unit,
                  (high - low) / units::kNmPerMm, unit, most / units::kNmPerMm, unit, name,
                  rate ? "" : fmt::format(" Or give `{} max pv` [mm]", name)));
}

}  // namespace dwell
