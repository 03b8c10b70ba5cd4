#include "core/formats/packed_values.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/formats/no_data.h"

namespace dwell {
namespace {

/// The number that the same bits are with the other sign convention.
double with_other_sign(double value, int bits) {
  const double all = std::ldexp(1.0, std::abs(bits));
  if (bits > 0) return value < 0.0 ? value + all : value;
  return value >= 0.5 * all ? value - all : value;
}

class Unpacker {
 public:
  explicit Unpacker(const PackedValues& packing) : packing_(packing), counts_(packing.no_data.size(), 0) {
    for (NoDataMarker& marker : packing_.no_data) marker.value = stored(marker.value);
    if (packing_.range_of_heights) return;
    if (packing_.least) packing_.least = stored(*packing_.least);
    if (packing_.most) packing_.most = stored(*packing_.most);
  }

  double height(double value) {
    constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
    const double number = stored(value);
    for (std::size_t i = 0; i < packing_.no_data.size(); ++i) {
      if (!is_marker(number, packing_.no_data[i].value)) continue;
      ++counts_[i];
      return kNoValue;
    }
    const double result = number * packing_.scale + packing_.offset;
    const double ranged = packing_.range_of_heights ? result : number;
    if ((packing_.least && ranged < *packing_.least) || (packing_.most && ranged > *packing_.most)) {
      ++beyond_;
      return kNoValue;
    }
    return result;
  }

  std::string describe() const {
    std::string text, none;
    const auto add = [](std::string& list, const std::string& part) { list += (list.empty() ? "" : ", ") + part; };
    if (packing_.other_sign_bits > 0) add(text, "integers stored without a sign");
    if (packing_.other_sign_bits < 0) add(text, "integers stored with a sign");
    if (packing_.scale != 1.0 || packing_.offset != 0.0) {
      add(text, fmt::format("height = stored x {} + {}", packing_.scale, packing_.offset));
    }
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (counts_[i] == 0) continue;
      add(none, fmt::format("{} of {} {}", counts_[i], packing_.no_data[i].name, packing_.no_data[i].value));
    }
    if (beyond_ > 0) {
      add(none,
          fmt::format("{} beyond the valid range of {} to {}", beyond_, bound(packing_.least), bound(packing_.most)));
    }
    if (!none.empty()) add(text, "pixels without data: " + none);
    return text;
  }

 private:
  double stored(double value) const {
    return packing_.other_sign_bits == 0 ? value : with_other_sign(value, packing_.other_sign_bits);
  }
  static std::string bound(const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : std::string("any");
  }

  PackedValues packing_;
  std::vector<long> counts_;
  long beyond_ = 0;
};

}  // namespace

std::string unpack_values(const PackedValues& packing, std::vector<double>& values) {
  const bool plain = packing.scale == 1.0 && packing.offset == 0.0 && packing.no_data.empty() && !packing.least &&
                     !packing.most && packing.other_sign_bits == 0;
  if (plain) return "";
  Unpacker unpacker(packing);
  for (double& value : values) value = unpacker.height(value);
  return unpacker.describe();
}

}  // namespace dwell
