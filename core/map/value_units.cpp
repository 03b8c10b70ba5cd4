#include "core/map/value_units.h"

#include <fmt/format.h>

#include <span>
#include <string_view>
#include <vector>

#include "core/base/errors.h"
#include "core/base/units.h"

namespace dwell {
namespace {

struct Unit {
  std::string_view name;
  double factor;
};

constexpr Unit kHeights[] = {{"nm", 1.0}, {"um", units::kNmPerUm}, {"mm", units::kNmPerMm}, {"m", units::kNmPerM}};
constexpr Unit kRates[] = {{"nm/s", 1.0},
                           {"um/s", units::kNmPerUm},
                           {"um/min", units::kNmPerUm / units::kSecondsPerMinute},
                           {"m/s", units::kNmPerM}};

double factor_of(const std::string& unit, std::span<const Unit> accepted) {
  std::string names;
  for (const Unit& known : accepted) {
    if (unit == known.name) return known.factor;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", known.name);
  }
  throw InputError(fmt::format("'{}'; accepted: {}", unit, names));
}

}  // namespace

double height_unit_nm(const std::string& unit) { return factor_of(unit, kHeights); }
double rate_unit_nm_per_s(const std::string& unit) { return factor_of(unit, kRates); }

double unit_factor(const std::string& unit, MapQuantity quantity) {
  return quantity == MapQuantity::Rate ? rate_unit_nm_per_s(unit) : height_unit_nm(unit);
}

std::string unit_of(MapQuantity quantity) { return quantity == MapQuantity::Rate ? "nm/s" : "nm"; }

}  // namespace dwell
