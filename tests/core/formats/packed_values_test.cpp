#include "core/formats/packed_values.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dwell {
namespace {

TEST(PackedValues, LeavesPlainHeightsAlone) {
  std::vector<double> values{1, -2, NAN};
  EXPECT_EQ(unpack_values({}, values), "");
  EXPECT_EQ(values[1], -2.0);
}

TEST(PackedValues, ScalesWhatIsNoMarker) {
  PackedValues packing;
  packing.scale = 0.5;
  packing.offset = 100;
  packing.no_data = {{"_FillValue", -32767}};
  std::vector<double> values{10, -32767, 30};
  EXPECT_EQ(unpack_values(packing, values), "height = stored x 0.5 + 100, pixels without data: 1 of _FillValue -32767");
  EXPECT_EQ(values[0], 105.0);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_EQ(values[2], 115.0);
}

TEST(PackedValues, ReadsIntegersOfTheOtherSign) {
  PackedValues packing;
  packing.other_sign_bits = 8;
  packing.no_data = {{"_FillValue", -1}};
  std::vector<double> values{-2, 127, -1};
  EXPECT_NE(unpack_values(packing, values).find("1 of _FillValue 255"), std::string::npos);
  EXPECT_EQ(values[0], 254.0);
  EXPECT_EQ(values[1], 127.0);
  EXPECT_TRUE(std::isnan(values[2]));
  packing = {};
  packing.other_sign_bits = -8;
  values = {254, 127};
  unpack_values(packing, values);
  EXPECT_EQ(values, (std::vector<double>{-2, 127}));
}

TEST(PackedValues, CutsAtTheRangeOfWhatIsStoredOrOfHeights) {
  PackedValues packing;
  packing.scale = 10;
  packing.least = 0;
  packing.most = 20;
  std::vector<double> values{-1, 0, 20, 21};
  EXPECT_NE(unpack_values(packing, values).find("2 beyond the valid range of 0 to 20"), std::string::npos);
  EXPECT_EQ(values[2], 200.0);
  EXPECT_TRUE(std::isnan(values[0]) && std::isnan(values[3]));
  packing.range_of_heights = true;
  packing.least.reset();
  values = {-5, 2, 3};
  EXPECT_NE(unpack_values(packing, values).find("1 beyond the valid range of any to 20"), std::string::npos);
  EXPECT_EQ(values[0], -50.0);
  EXPECT_TRUE(std::isnan(values[2]));
}

TEST(PackedValues, RoundsAMarkerAsTheValuesAre) {
  PackedValues packing;
  packing.no_data = {{"missing_value", 1e20}};
  std::vector<double> values{static_cast<double>(1e20F), 1.0};
  unpack_values(packing, values);
  EXPECT_TRUE(std::isnan(values[0]));
}

}  // namespace
}  // namespace dwell
