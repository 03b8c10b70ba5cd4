#include "core/formats/slope_unit.h"

#include <array>
#include <string>

#include "core/base/number_text.h"
#include "core/base/numbers.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

/// In lower case, micro signs as u, without blanks, '-' and '_' within.
std::string folded_slope_unit(std::string_view text) {
  std::string folded;
  const std::string lower = lower_case(trim(text));
  for (std::size_t i = 0; i < lower.size(); ++i) {
    const std::string_view rest = std::string_view(lower).substr(i);
    if (rest.starts_with("\xC2\xB5") || rest.starts_with("\xCE\xBC") || rest.starts_with("\xCE\x9C")) {
      folded += 'u';
      ++i;
    } else if (rest.front() == '\xB5') {
      folded += 'u';
    } else if (rest.starts_with("\xC2\xB0")) {
      folded += "deg";
      ++i;
    } else if (rest.front() != ' ' && rest.front() != '_' && (rest.front() != '-' || i == 0)) {
      folded += rest.front();
    }
  }
  return folded;
}

struct SlopeUnit {
  std::string_view word;
  double urad;
};

constexpr double kUradPerDegree = 1e6 * kPi / 180.0;

/// Without the s of many, and with "radian" as "rad".
constexpr std::array<SlopeUnit, 20> kSlopeUnits{{{"rad", 1e6},
                                                 {"mrad", 1e3},
                                                 {"millirad", 1e3},
                                                 {"urad", 1.0},
                                                 {"microrad", 1.0},
                                                 {"nrad", 1e-3},
                                                 {"nanorad", 1e-3},
                                                 {"prad", 1e-6},
                                                 {"picorad", 1e-6},
                                                 {"deg", kUradPerDegree},
                                                 {"degree", kUradPerDegree},
                                                 {"arcmin", kUradPerDegree / 60.0},
                                                 {"arcminute", kUradPerDegree / 60.0},
                                                 {"arcsec", kUradPerDegree / 3600.0},
                                                 {"arcsecond", kUradPerDegree / 3600.0},
                                                 {"asec", kUradPerDegree / 3600.0},
                                                 {"marcsec", 1e-3 * kUradPerDegree / 3600.0},
                                                 {"milliarcsec", 1e-3 * kUradPerDegree / 3600.0},
                                                 {"milliarcsecond", 1e-3 * kUradPerDegree / 3600.0},
                                                 {"uarcsec", 1e-6 * kUradPerDegree / 3600.0}}};

}  // namespace

std::optional<double> known_slope_unit(std::string_view text) {
  std::string word = folded_slope_unit(text);
  if (const std::size_t slash = word.find('/'); slash != std::string::npos) {
    const auto above = known_length_unit(std::string_view(word).substr(0, slash));
    const auto below = known_length_unit(std::string_view(word).substr(slash + 1));
    if (!above || !below) return std::nullopt;
    return 1e6 * *above / *below;
  }
  if (word.size() > 1 && word.ends_with('s')) word.pop_back();
  if (word.ends_with("radian")) word.erase(word.size() - 3);
  for (const SlopeUnit& unit : kSlopeUnits) {
    if (unit.word == word) return unit.urad;
  }
  return std::nullopt;
}

}  // namespace dwell
