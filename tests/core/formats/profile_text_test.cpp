#include "core/formats/profile_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;
using LineValues = std::vector<double>;

ProfileText read_line(const std::string& text, const std::string& columns = "", const std::string& unit = "") {
  return parse_profile_text(text, {columns, unit}, "a.dat");
}

/// The rows that most tests have, behind a header.
std::string line_rows(const std::string& header) { return header + "\n0 5\n1 6.5\n1.5 -7\n4 8e0\n"; }

void line_refused(const std::string& text, std::initializer_list<std::string> words, const std::string& columns = "",
                  const std::string& unit = "") {
  SCOPED_TRACE(text);
  expect_input_error([&] { read_line(text, columns, unit); }, words);
}

TEST(ProfileTextReader, TakesColumnsAndUnitsFromTheHeader) {
  for (const char* header :
       {"x[mm] slope[urad]", "# x-position [mm]; y-slope [urad]", "x(mm)\tSlope (urad)\t", "x_mm,slope_urad",
        "\"x (mm)\",\"slope (\xC2\xB5rad)\"", "x [mm]  slope [micro-rad]", "% pos/mm slope/urad",
        "x in mm; slope in urad", "# unit: mm, urad", "# unit of x: mm\n# slope units = urad",
        "# units: mm; urad\nx slope", "X (mm) Steigung (nm/mm)"}) {
    SCOPED_TRACE(header);
    const ProfileText profile = read_line(line_rows(header));
    EXPECT_EQ(profile.quantity, ProfileQuantity::Slope);
    EXPECT_EQ(profile.x, (LineValues{0.0, 1.0, 1.5, 4.0}));
    EXPECT_EQ(profile.values, (LineValues{5.0, 6.5, -7.0, 8.0}));
    EXPECT_FALSE(profile.turned);
  }
}

TEST(ProfileTextReader, ConvertsUnits) {
  const ProfileText slope = read_line(line_rows("x[um] slope[mrad]"));
  EXPECT_EQ(slope.x, (LineValues{0.0, 0.001, 0.0015, 0.004}));
  EXPECT_EQ(slope.values, (LineValues{5e3, 6.5e3, -7e3, 8e3}));
  const ProfileText height = read_line(line_rows("x [m], height [um]"), "", "");
  EXPECT_EQ(height.quantity, ProfileQuantity::Height);
  EXPECT_EQ(height.x, (LineValues{0.0, 1e3, 1.5e3, 4e3}));
  EXPECT_EQ(height.values, (LineValues{5e3, 6.5e3, -7e3, 8e3}));
  const ProfileText told = read_line(line_rows("any words"), "", "cm,-arcsec");
  EXPECT_EQ(told.x, (LineValues{0.0, 10.0, 15.0, 40.0}));
  EXPECT_NEAR(told.values[0], -5.0 * 4.84813681109536, 1e-12);
  EXPECT_EQ(told.value_unit, "-arcsec");
}

TEST(ProfileTextReader, AMinusTurnsTheSignAndAgreesWithTheHeader) {
  const ProfileText profile = read_line(line_rows("x[mm] slope[urad]"), "x,slope", "mm,-urad");
  EXPECT_EQ(profile.values, (LineValues{-5.0, -6.5, 7.0, -8.0}));
  line_refused(line_rows("x[mm] slope[urad]"), {"a.dat", "'urad'", "'mrad'", "must agree"}, "", "mm,mrad");
  line_refused(line_rows("x[um] slope[urad]"), {"'um'", "'mm'", "must agree"}, "", "mm,urad");
  line_refused(line_rows("# slope unit: mrad"), {"'mrad'", "must agree"}, "", "mm,urad");
  line_refused(line_rows(""), {"`unit`", "the place has no sign"}, "", "-mm,urad");
  line_refused(line_rows(""), {"`unit`", "two units"}, "", "urad");
  line_refused(line_rows(""), {"'s'", "no length"}, "", "s,urad");
  line_refused(line_rows(""), {"'grad'", "no unit of slope or height"}, "", "mm,grad");
  line_refused(line_rows(""), {"no unit of slope or height"}, "", "mm,--urad");
}

TEST(ProfileTextReader, ReadsTheFilesOfProfilers) {
  // Header lines of numbers and words as long-trace profilers write them.
  const ProfileText ltp = read_line(
      "M2- face down- 230 000\n11/05/2012 at 22:17\n817.099976\n-1.000000\n1201\n"
      "-2.000\t-1.5\n-1.000\t-1.25\n0.500\t1\n1.000\t3\n",
      "x,slope", "mm,urad");
  EXPECT_EQ(ltp.x, (LineValues{-2.0, -1.0, 0.5, 1.0}));
  // Sizes of other things are not the unit of the columns.
  const std::string nom =
      "#scan length [mm]: 430\r\n#dx [mm] :0.2\r\n#residual slope [urad]: 0.5\r\n#design: entrance "
      "arm: 7500mm; angle of incidence 0.6deg\r\n#x-position [mm]; y-slope [urad]\r\n0\t1\r\n"
      "0.2\t2\r\n0.4\t3\r\n0.6\t5\r\n";
  EXPECT_EQ(read_line(nom).values, (LineValues{1.0, 2.0, 3.0, 5.0}));
  const std::string lcls =
      "X(mm)\tMeasured heigth (nm)\tResidual Heigth (nm)\tSlope (micror-rad)\tResidual slope "
      "(microrad)\n-2\t5\t6\t7\t8\n-1\t1\t2\t3\t4\n0\t9\t8\t7\t6\n1\t1\t1\t2\t2\n";
  EXPECT_EQ(read_line(lcls, "x,measured").values[0], 5.0);
  EXPECT_EQ(read_line(lcls, "x,Residual Slope").values[0], 8.0);
  EXPECT_EQ(read_line(lcls, "1,3").quantity, ProfileQuantity::Height);
  EXPECT_EQ(read_line(lcls, "x,slope", "mm,urad").values[0], 7.0);
  line_refused(lcls, {"line 1", "'micror-rad'", "give `unit`"}, "x,slope");
  line_refused(lcls, {"2 columns are named 'residual'"}, "x,residual");
  line_refused(lcls, {"more than one column may be the slope or height", "4 'Slope (micror-rad)'"});
  line_refused(lcls, {"`columns`", "'6' is none of 1 to 5"}, "1,6");
  line_refused(lcls, {"one and the same"}, "1,x");
  line_refused(lcls, {"no column is named 'phase'"}, "x,phase");
  line_refused(lcls, {"are not two"}, "x");
  line_refused(lcls, {"named a slope", "'nm'"}, "x,slope", "mm,nm");
  line_refused(lcls, {"'nm'", "'urad'", "must agree"}, "x,measured", "mm,urad");
}

TEST(ProfileTextReader, TurnsPlacesThatDecrease) {
  const ProfileText profile = read_line("x_mm;slope_urad\n4;1\n3;2\n1;3\n0.5;5\n");
  EXPECT_TRUE(profile.turned);
  EXPECT_EQ(profile.x, (LineValues{0.5, 1.0, 3.0, 4.0}));
  EXPECT_EQ(profile.values, (LineValues{5.0, 3.0, 2.0, 1.0}));
}

TEST(ProfileTextReader, NamesTheLineOfWhatIsNoProfile) {
  const std::string header = "x_mm,slope_urad\n";
  line_refused(header + "0,1\n1,2\n1,3\n2,4\n", {"line 4", "1 mm on line 3", "stands twice"});
  line_refused(header + "0,1\n1,2\n2,3\n1.5,4\n", {"line 5", "runs back"});
  line_refused(header + "3,1\n2,2\n2.5,3\n1,4\n", {"line 4", "runs back"});
  line_refused(header + "0,1\n1,nan\n2,3\n3,4\n", {"line 3, column 2", "'nan'", "no data"});
  line_refused(header + "0,NaN\n1,2\n2,3\n3,4\n5,6\n", {"line 2, column 2", "no data"});
  line_refused(header + "0,1\n1,\n2,3\n3,4\n", {"line 3", "1 fields", "has 2"});
  line_refused(header + "0,1\n1,2,3\n2,3\n3,4\n", {"line 3", "3 fields"});
  line_refused(header + "0,1\n1,two\n2,3\n3,4\n", {"line 3, column 2", "'two'", "not a number"});
  line_refused(header + "0,1\n1,inf\n2,3\n3,4\n", {"line 3, column 2"});
  line_refused(header + "0,1\n1,2\n2,3\n", {"3 places", "at least 4"});
  line_refused(header + "0,1\n1,2\n2,3\nend of data\n", {"line 5"});
  line_refused(header, {"no line of two numbers"});
  line_refused("", {"no line of two numbers"});
  line_refused(header + "0,1\n1,2e6\n2,3\n3,4\n", {"line 3", "value is 2000000 urad"});
  line_refused(header + "0,1\n1e7,2\n2,3\n3,4\n", {"line 3", "place is 10000000 mm"});
  line_refused("\x89PNG\r\n\x1a\n", {"PNG"});
}

TEST(ProfileTextReader, RefusesDecimalCommas) {
  line_refused("x_mm;slope_urad\n0,0;5,5\n0,1;6,5\n0,2;7\n0,3;8\n", {"line 2", "decimal commas"});
  line_refused("0\t5,5\n0,1\t6,5\n0,2\t7\n1\t8\n", {"line 1", "decimal commas"}, "", "mm,urad");
  line_refused("x_mm slope_urad\n0 5\n0,1 6,5\n0,2 7\n1 8\n", {"line 3", "decimal commas"});
}

TEST(ProfileTextReader, AsksForWhatIsNotSaid) {
  line_refused(line_rows("some words"), {"no unit of the place", "give `unit`"});
  line_refused(line_rows("x slope[urad]"), {"no unit of the place"});
  line_refused(line_rows("x[mm] slope"), {"no unit of the values"});
  line_refused(line_rows("x[mm] slope[waves]"), {"line 1", "'waves'"});
  line_refused("1 2 3\n2 3 4\n3 4 5\n4 5 6\n", {"3 columns without names", "`columns`"}, "", "mm,urad");
  line_refused("1 2 3\n2 3 4\n3 4 5\n4 5 6\n", {"no column is named 'x'"}, "x,slope", "mm,urad");
  EXPECT_EQ(read_line("1 2 3\n2 3 4\n3 4 5\n4 5 6\n", "1,3", "mm,urad").values[0], 3.0);
  line_refused(line_rows("x[mm] x[mm]"), {"line 1", "give `unit`"});
  line_refused(line_rows("x_mm slope_urad\nx_mm slope_urad"), {"line 2", "line 1", "once is required"});
}

TEST(ProfileTextReader, WhatMayBeAUnitIsAskedAboutUnlessTheUserSaysIt) {
  for (const char* remark : {"# slopes in mrad", "# values x 1e-3", "# scale factor 0.001", "# [mrad]",
                             "slope in arcsec", "# heights in um", "# slope unit: mils"}) {
    const std::string text = line_rows(std::string(remark) + "\nx[mm] slope[urad]");
    line_refused(text, {"line 1", "give `unit`"});
    EXPECT_EQ(read_line(text, "", "mm,urad").values[0], 5.0) << remark;
  }
  line_refused(line_rows("x[mm] slope*1e3[urad]"), {"line 1", "factor"});
  line_refused(line_rows("# missing points set to -9999\nx[mm] slope[urad]"), {"line 1", "no data"}, "", "mm,urad");
}

TEST(ProfileTextReader, ReadsBackWhatIsWritten) {
  for (const ProfileQuantity quantity : {ProfileQuantity::Slope, ProfileQuantity::Height}) {
    const LineProfile profile =
        line_profile(quantity, {-1.0, 0.1, 0.30000000000000004, 7.25, 8.0}, {1.0 / 3.0, -2e-7, 5.0, 1e5 / 7.0, 0.0});
    const std::string text = profile_csv(profile, "dwell 0 profile, without ellipse:p=7500,q=2500,angle=0.6");
    const ProfileText again = read_line(text);
    EXPECT_EQ(again.quantity, quantity);
    EXPECT_EQ(again.x, profile.x);
    EXPECT_EQ(again.values, profile.values());
    const bool slope = quantity == ProfileQuantity::Slope;
    EXPECT_EQ(read_line(text, slope ? "x,height" : "x,slope").values, slope ? profile.height : profile.slope);
  }
}

}  // namespace
}  // namespace dwell
