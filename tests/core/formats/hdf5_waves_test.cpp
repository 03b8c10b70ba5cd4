#include "core/formats/hdf5_waves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/formats/hdf5_map.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/formats/hdf5_test_file.h"

namespace dwell {
namespace {

MapSource read_waves(const std::string& wavelength, const std::string& pixel) {
  test::Hdf5TestFile file;
  file.data_set<double>("/measurement0/genraw/data", {2, 3}, {0.5, -0.25, 3.4028234663852886e38, 1.0, 2.0, 3.0},
                        H5T_NATIVE_DOUBLE, H5T_IEEE_F32LE);
  if (!wavelength.empty()) file.text("/measurement0/genraw", "wavelength", wavelength, true);
  if (!pixel.empty()) file.text("/measurement0/genraw", "xpix", pixel, true);
  return parse_hdf5(file.bytes(), "map a.h5");
}

TEST(Hdf5Waves, BecomeNanometresWithTheFirstRowOnTop) {
  const MapSource source = read_waves("600 nm", "0.12 mm");
  EXPECT_EQ(source.header.unit, "nm");
  EXPECT_EQ(source.header.pitch, (Point{0.12, 0.12}));
  EXPECT_NEAR(source.values[0], 600.0, 1e-9);
  EXPECT_NEAR(source.values[3], 300.0, 1e-9);
  EXPECT_NEAR(source.values[4], -150.0, 1e-9);
  EXPECT_TRUE(std::isnan(source.values[5]));
  EXPECT_NE(source.header.history.at(0).find("waves of 600 nm"), std::string::npos);
}

TEST(Hdf5Waves, NeedLengthsWithTheirUnits) {
  EXPECT_FALSE(read_waves("600 nm", "").header.pitch);
  test::expect_input_error([] { read_waves("600", "0.12 mm"); },
                           {"map a.h5", "wavelength", "'/measurement0/genraw'", "'600'", "with its unit"});
  test::expect_input_error([] { read_waves("600 nm", "0 mm"); }, {"xpix", "'0 mm'"});
  EXPECT_FALSE(read_waves("", "0.12 mm").header.unit) << "without a wavelength nobody knows";
}

}  // namespace
}  // namespace dwell
