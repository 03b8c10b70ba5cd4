#include "core/formats/slope_unit.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace dwell {
namespace {

TEST(SlopeUnit, IsKnownInManySpellings) {
  constexpr double kArcsec = 4.84813681109536;  // urad
  const std::vector<std::pair<const char*, double>> units{{"rad", 1e6},
                                                          {"Radians", 1e6},
                                                          {"mrad", 1e3},
                                                          {" urad ", 1.0},
                                                          {"\xC2\xB5rad", 1},
                                                          {"\xCE\xBCrad", 1},
                                                          {"\xB5rad", 1},
                                                          {"micro-rad", 1.0},
                                                          {"microradians", 1},
                                                          {"micro radian", 1},
                                                          {"nrad", 1e-3},
                                                          {"deg", 3600 * kArcsec},
                                                          {"degrees", 3600 * kArcsec},
                                                          {"arcmin", 60 * kArcsec},
                                                          {"arcsec", kArcsec},
                                                          {"arc-seconds", kArcsec},
                                                          {"marcsec", 1e-3 * kArcsec},
                                                          {"nm/mm", 1.0},
                                                          {"um/m", 1.0},
                                                          {"mm/m", 1e3},
                                                          {"nm / mm", 1.0},
                                                          {"um/mm", 1e3}};
  for (const auto& [text, urad] : units) {
    const auto known = known_slope_unit(text);
    ASSERT_TRUE(known) << text;
    EXPECT_NEAR(*known, urad, 1e-12 * urad) << text;
  }
}

TEST(SlopeUnit, IsNoOtherUnit) {
  for (const char* text : {"", "nm", "mm", "um/s", "-urad", "micror-rad", "grad", "m/", "/m", "s", "rad/m", "5 urad"})
    EXPECT_FALSE(known_slope_unit(text)) << text;
}

}  // namespace
}  // namespace dwell
