#include "core/aperture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/expect_error.h"

namespace dwell {
namespace {

/// 4 x 6 pixels of 0.1 mm, (0, 0) at (1, 2); every value its linear index.
HeightMap numbered() {
  HeightMap map(Grid{4, 6, 0.1, 0.1, {1.0, 2.0}});
  for (std::size_t i = 0; i < map.values.size(); ++i) map.values[i] = static_cast<double>(i);
  return map;
}

TEST(Aperture, ParsesAndPrintsTheThreeForms) {
  for (const std::string text : {"map", "rect:-1,0.5,2,3.25", "circle:0.1,-2,30"}) {
    EXPECT_EQ(to_string(parse_aperture(text)), text);
  }
  const Aperture rectangle = parse_aperture("rect: 1, 2 ,3,4e0");
  EXPECT_EQ(rectangle.kind, Aperture::Kind::Rectangle);
  EXPECT_EQ(rectangle.x0, 1.0);
  EXPECT_EQ(rectangle.y0, 2.0);
  EXPECT_EQ(rectangle.x1, 3.0);
  EXPECT_EQ(rectangle.y1, 4.0);
}

TEST(Aperture, NamesWhatItRefuses) {
  const auto refused = [](const std::string& text, const std::string& reason) {
    test::expect_input_error([&] { parse_aperture(text); }, {"'" + text + "'", reason, "rect:x0,y0,x1,y1"});
  };
  refused("ellipse:1,2,3", "unknown form");
  refused("", "unknown form");
  refused("rect:1,2,3", "3 numbers given, 4 required");
  refused("circle:1,2,3,4", "4 numbers given, 3 required");
  refused("circle:1,2,x", "'x' is not a finite number");
  refused("circle:1,2,nan", "'nan' is not");
  refused("circle:1,2,inf", "'inf' is not");
  refused("circle:1,2,0", "radius is not positive");
  refused("rect:1,0,1,2", "rectangle is empty");
  refused("rect:0,3,1,2", "rectangle is empty");
}

TEST(Aperture, RectangleKeepsPixelsOnItsBoundary) {
  // Columns 1..3 (x 1.1 .. 1.3, where 1 + 3 * 0.1 exceeds 1.3 in rounding) and rows 0..1 (y 2.0 .. 2.1).
  const HeightMap kept = within(numbered(), parse_aperture("rect:1.1,1.5,1.3,2.1"));
  for (Index row = 0; row < 4; ++row) {
    for (Index col = 0; col < 6; ++col) {
      const bool inside = row <= 1 && col >= 1 && col <= 3;
      EXPECT_EQ(std::isfinite(kept.at(row, col)), inside) << row << " " << col;
      if (inside) {
        EXPECT_EQ(kept.at(row, col), numbered().at(row, col));
      }
    }
  }
}

TEST(Aperture, CircleKeepsPixelsOnItsBoundary) {
  const HeightMap kept = within(numbered(), parse_aperture("circle:1.2,2.1,0.1"));
  EXPECT_EQ(kept.valid_pixels(), 5);
  EXPECT_TRUE(std::isfinite(kept.at(1, 3)));
  EXPECT_TRUE(std::isfinite(kept.at(2, 2)));
  EXPECT_FALSE(std::isfinite(kept.at(2, 3)));
}

TEST(Aperture, MapKeepsAllAndNoDataStaysNoData) {
  HeightMap map = numbered();
  map.at(1, 2) = NAN;
  EXPECT_EQ(within(map, {}).valid_pixels(), 23);
  EXPECT_EQ(within(map, parse_aperture("circle:1.2,2.1,0.1")).valid_pixels(), 4);
}

TEST(Aperture, SaysWhereTheMapLiesIfNothingIsLeft) {
  test::expect_input_error([] { within(numbered(), parse_aperture("circle:50,0,3")); },
                           {"circle:50,0,3", "x = 1 to 1.5 mm", "y = 2 to 2.3 mm"});
}

}  // namespace
}  // namespace dwell
