#include "core/map/value_units.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;

TEST(ValueUnits, KnowLengthsBySignAndWord) {
  const std::pair<const char*, double> cases[] = {
      {"nm", 1.0},         {"NM", 1.0},         {" nm ", 1.0},      {"(nm)", 1.0},        {"[ 'um' ]", 1e3},
      {"nanometres", 1.0}, {"\xc2\xb5m", 1e3},  {"\xce\xbcm", 1e3}, {"\xb5m", 1e3},       {"micron", 1e3},
      {"Microns", 1e3},    {"Micrometer", 1e3}, {"mm", 1e6},        {"millimetres", 1e6}, {"cm", 1e7},
      {"m", 1e9},          {"meter", 1e9},      {"METRES", 1e9},    {"pm", 1e-3},         {"Angstrom", 0.1},
      {"\xc3\x85", 0.1},   {"inch", 25.4e6},    {"inches", 25.4e6}};
  for (const auto& [text, factor] : cases) EXPECT_EQ(known_length_unit(text), factor) << text;
  for (const char* text : {"", "s", "waves", "nms", "ms", "km", "nm/s", "n m", "(nm", "1", "mms"}) {
    EXPECT_FALSE(known_length_unit(text)) << text;
  }
}

TEST(ValueUnits, KnowRatesAsQuotients) {
  const std::pair<const char*, double> cases[] = {
      {"nm/s", 1.0},   {"nm / sec", 1.0}, {"um/min", 1e3 / 60.0},        {"microns per minute", 1e3 / 60.0},
      {"nm s-1", 1.0}, {"nm*s^-1", 1.0},  {"\xc2\xb5m/h", 1e3 / 3600.0}, {"m/s", 1e9}};
  for (const auto& [text, factor] : cases) {
    ASSERT_TRUE(known_rate_unit(text)) << text;
    EXPECT_DOUBLE_EQ(*known_rate_unit(text), factor) << text;
  }
  for (const char* text : {"nm", "s", "/s", "nm/", "nm/ms", "nm/s/s", "s-1", "mm^3/s"}) {
    EXPECT_FALSE(known_rate_unit(text)) << text;
  }
}

TEST(ValueUnits, OfEitherQuantityAreKnownTogether) {
  EXPECT_EQ(known_value_unit("um"), 1e3);
  EXPECT_EQ(known_value_unit("um/s"), 1e3);
  EXPECT_FALSE(known_value_unit("waves"));
}

TEST(ValueUnits, RefuseTheOtherQuantityByName) {
  expect_input_error([] { height_unit_nm("nm/s"); }, {"'nm/s' is a rate, not a height", "nm, um, mm, m"});
  expect_input_error([] { rate_unit_nm_per_s("nm"); }, {"'nm' is a height, not a rate", "nm/s, um/s, um/min, m/s"});
  expect_input_error([] { height_unit_nm("waves"); }, {"'waves'; accepted: nm, um, mm, m"});
}

}  // namespace
}  // namespace dwell
