#include "core/formats/said_wavelength.h"

#include <gtest/gtest.h>

namespace dwell {
namespace {

TEST(SaidWavelength, HasManyNames) {
  for (const char* name :
       {"wavelength", "Wavelength_nm", "laser wavelength", "WAVELEN", "Wellenl\xc3\xa4nge", "longueur d'onde"}) {
    EXPECT_TRUE(names_wavelength(name)) << name;
  }
  for (const char* name : {"wave", "length", "lambda_count", ""}) EXPECT_FALSE(names_wavelength(name)) << name;
}

TEST(SaidWavelength, IsThatOfLightAndOfSeveralNoneCounts) {
  MapHeader header;
  EXPECT_FALSE(add_wavelength(5e6, "cutoff", header)) << "no light";
  EXPECT_FALSE(header.wavelength);
  EXPECT_TRUE(add_wavelength(632.8, "laser", header));
  EXPECT_EQ(header.wavelength, 632.8);
  EXPECT_EQ(header.wave_field, "laser");
  EXPECT_TRUE(add_wavelength(632.8 * (1.0 + 1e-8), "again", header));
  EXPECT_EQ(header.wavelength, 632.8);
  EXPECT_TRUE(add_wavelength(532.0, "second", header));
  EXPECT_FALSE(header.wavelength);
  EXPECT_TRUE(add_wavelength(532.0, "third", header));
  EXPECT_FALSE(header.wavelength) << "still two";
}

}  // namespace
}  // namespace dwell
