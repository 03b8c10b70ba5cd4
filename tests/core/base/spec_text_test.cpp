#include "core/base/spec_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/errors.h"

namespace dwell {
namespace {

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string parse_message(const std::string& text) {
  return message_of([&] { parse_spec_text(text, "tif"); });
}

TEST(SpecText, SplitsKindKeysAndValuesInOrder) {
  const SpecText spec = parse_spec_text("gaussian:peak=1, fwhm = 2.8,radius=5,centre=a=b", "tif");
  EXPECT_EQ(spec.kind, "gaussian");
  ASSERT_EQ(spec.entries.size(), 4u);
  EXPECT_EQ(spec.entries[0].first, "peak");
  EXPECT_EQ(spec.entries[1], (std::pair<std::string, std::string>("fwhm", "2.8")));
  EXPECT_EQ(spec.word("centre"), "a=b");
  EXPECT_EQ(spec.number("radius"), 5.0);
  EXPECT_EQ(spec.number("fwhm", 9.0), 2.8);
  EXPECT_EQ(spec.number("sigma", 9.0), 9.0);
  EXPECT_FALSE(spec.optional_number("sigma").has_value());
  EXPECT_TRUE(spec.has("peak"));
  EXPECT_FALSE(spec.has("Peak"));
  EXPECT_NO_THROW(spec.accept_only({"peak", "fwhm", "radius", "centre"}));
}

TEST(SpecText, AKindMayStandAlone) {
  EXPECT_EQ(parse_spec_text("raster", "path").kind, "raster");
  EXPECT_TRUE(parse_spec_text("raster:", "path").entries.empty());
}

TEST(SpecText, SplitKindLeavesTheRestAlone) {
  EXPECT_EQ(split_kind("file:a:b=1,c.csv"), (std::pair<std::string, std::string>("file", "a:b=1,c.csv")));
  EXPECT_EQ(split_kind("spot.csv"), (std::pair<std::string, std::string>("spot.csv", "")));
}

TEST(SpecText, RefusesMalformedText) {
  EXPECT_EQ(parse_message(":a=1"), "tif \":a=1\": required: kind:key=value,...");
  EXPECT_EQ(parse_message(""), "tif \"\": required: kind:key=value,...");
  EXPECT_EQ(parse_message("g:peak"), "tif \"g:peak\": \"peak\" is not of the form key=value");
  EXPECT_EQ(parse_message("g:a=1,"), "tif \"g:a=1,\": \"\" is not of the form key=value");
  EXPECT_EQ(parse_message("g:=1"), "tif \"g:=1\": \"=1\" is not of the form key=value");
  EXPECT_EQ(parse_message("g:a="), "tif \"g:a=\": a has no value");
  EXPECT_EQ(parse_message("g:a=1,a=2"), "tif \"g:a=1,a=2\": a is given twice");
}

TEST(SpecText, NamesUnknownMissingAndBadValues) {
  const SpecText spec = parse_spec_text("g:paek=1,r=x,s=nan,t=inf", "tif");
  EXPECT_EQ(message_of([&] {
              spec.accept_only({"peak", "r", "s", "t"});
            }),
            "tif \"g:paek=1,r=x,s=nan,t=inf\": unknown key \"paek\"; accepted for g: peak, r, s, t");
  EXPECT_EQ(message_of([&] { spec.number("peak"); }),
            "tif \"g:paek=1,r=x,s=nan,t=inf\": peak is missing; g:peak=NUMBER is required");
  EXPECT_EQ(message_of([&] { spec.number("r"); }), "tif \"g:paek=1,r=x,s=nan,t=inf\": r = \"x\"; a number is required");
  EXPECT_EQ(message_of([&] { spec.number("s", 1.0); }),
            "tif \"g:paek=1,r=x,s=nan,t=inf\": s = \"nan\"; a number is required");
  EXPECT_EQ(spec.number("t"), HUGE_VAL);
  const SpecText huge = parse_spec_text("g:peak=1e300,r=2", "tif");
  EXPECT_EQ(message_of([&] { huge.number("peak", ranges::kRate); }),
            "tif \"g:peak=1e300,r=2\": peak = \"1e300\"; required a number from 1e-09 to 1e+09 (nm/s)");
  EXPECT_EQ(message_of([&] { huge.number("peak"); }),
            "tif \"g:peak=1e300,r=2\": peak = \"1e300\"; required a number from -1e+16 to 1e+16 at the most, "
            "within the range of the key");
  EXPECT_EQ(huge.number("r", ranges::kRate), 2.0);
}

}  // namespace
}  // namespace dwell
