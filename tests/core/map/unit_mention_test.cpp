#include "core/map/unit_mention.h"

#include <gtest/gtest.h>

#include <string>

namespace dwell {
namespace {

TEST(UnitMention, FindsUnitsThatNoPathHas) {
  const struct {
    const char* comment;
    const char* unit;
  } kCases[] = {
      {"coordinates in um", "um"},
      {"x_um y_um", "x_um"},
      {"units: inch", "inch"},
      {"feed in mm/s", "mm/s"},
      {"all dimensions in inches", "inches"},
      {"F in mm/s", "mm/s"},
      {"units inch", "inch"},
      {"Unit = IN", "IN"},
      {"X, Y [um]", "um"},
      {"x[um], y[um]", "um"},
      {"um", "um"},
      {"X (in), Y (in)", "in"},
      {"x in, y in", "in"},
      {"POST: HAAS INCH", "INCH"},
      {"imperial", "imperial"},
      {"units are microns", "microns"},
      {"positions in \xc2\xb5m.", "\xc2\xb5m"},
      {"F is mm per second", "mm per second"},
      {"feed: mm s-1", "mm s-1"},
      {"feed in inch per minute", "inch per minute"},
      {"F is mm/rev", "mm/rev"},
      {"dwell in ms", "ms"},
      {"P = ms", "ms"},
      {"time_ms", "time_ms"},
      {"dwell [min]", "min"},
      {"1 unit = 10 um", "um"},
      {"x/um y/um", "x/um"},
      {"lift height in inches", "inches"},
      {"coordinates of the surface in um", "um"},
      {"F in ipm", "ipm"},
      {"feed_mm_per_s", "feed_mm_per_s"},
      {"feed_mm_s", "feed_mm_s"},
  };
  for (const auto& [comment, unit] : kCases) {
    EXPECT_EQ(find_other_unit(comment).value_or("(none)"), unit) << comment;
  }
}

TEST(UnitMention, LeavesProseAndOurOwnUnitsAlone) {
  for (const char* comment : {"any number of comment lines",
                              "begins in the middle",
                              "x_mm, y_mm",
                              "all dimensions in mm",
                              "F in mm/min",
                              "feed mm per minute",
                              "units: millimetres",
                              "a tool of 10 um",
                              "T1 D=0.25 in endmill",
                              "speed at most 50 mm/s",
                              "heights in nm",
                              "removal rates [nm/s]",
                              "lines of 2 mm",
                              "made in 1998 at 3 pm",
                              "feed: min 10, max 20",
                              "dwell in s",
                              "check-in of part 5",
                              "hold for 5 min",
                              "in order of the run",
                              "path in",
                              "see run/in/m.csv",
                              "units: x_mm and y_mm mm, dwell_s s, feed_mm_per_min mm/min",
                              "units: X Y Z mm, F mm/min, P seconds",
                              "units: X Y Z mm, F 1/[minutes of the move], P seconds",
                              "units: X Y Z mm, F seconds of the move, P seconds",
                              ""}) {
    EXPECT_EQ(find_other_unit(comment), std::nullopt) << comment;
  }
}

TEST(UnitMention, TakesMillisecondsWhereTheyAreMeant) {
  EXPECT_TRUE(find_other_unit("P in ms"));
  EXPECT_FALSE(find_other_unit("P in ms", true));
  EXPECT_FALSE(find_other_unit("P in milliseconds", true));
}

}  // namespace
}  // namespace dwell
