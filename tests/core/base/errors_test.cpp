#include "core/base/errors.h"

#include <gtest/gtest.h>

namespace dwell {
namespace {

TEST(InputError, HoldsItsParts) {
  const InputError error("map pixel", "-1 mm", "> 0");
  EXPECT_STREQ(error.what(), "`map pixel` = -1 mm; required > 0");
  EXPECT_EQ(error.field(), "map pixel");
  EXPECT_EQ(error.value(), "-1 mm");
  EXPECT_EQ(error.accepted(), "> 0");
  EXPECT_EQ(InputError("whatever").field(), "");
}

TEST(InputError, TakesTheNameThatTheUserKnows) {
  const InputError error("map pixel", "-1 mm", "> 0", "a.csv: `map pixel` = -1 mm and `map unit` nm");
  const InputError renamed = error.renamed("map_pixel_mm");
  EXPECT_STREQ(renamed.what(), "a.csv: map_pixel_mm = -1 mm and `map unit` nm");
  EXPECT_EQ(renamed.field(), "map_pixel_mm");
  EXPECT_EQ(renamed.value(), "-1 mm");
  const auto in_capitals = [](const std::string& name) { return name == "map pixel" ? "PIXEL" : "UNIT"; };
  EXPECT_STREQ(error.renamed(in_capitals).what(), "a.csv: PIXEL = -1 mm and UNIT nm");
  EXPECT_EQ(error.renamed(in_capitals).field(), "PIXEL");
}

TEST(InputError, LeavesBackquotesThatNameNoOption) {
  const auto never = [](const std::string& name) { return "<" + name + ">"; };
  for (const char* text : {"a`b.csv", "`A B`.csv: empty", "``", "` x`", "`x `", "`"}) {
    EXPECT_EQ(with_option_names(text, never), text);
  }
  EXPECT_EQ(with_option_names("`B` `out`: '`'", never), "`B` <out>: '`'");
}

}  // namespace
}  // namespace dwell
