#include "runs/base/exact_json.h"

#include <cmath>
#include <limits>

namespace dwell {

nlohmann::ordered_json exact_number_json(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

double exact_number(const nlohmann::ordered_json& json) {
  if (!json.is_string()) return json.get<double>();
  const auto& word = json.get_ref<const std::string&>();
  if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  return word == "inf" ? infinite : -infinite;
}

}  // namespace dwell
