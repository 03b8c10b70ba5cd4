#include "core/map/aperture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

/// 4 x 6 pixels of 0.1 mm, (0, 0) at (1, 2); every value its linear index.
HeightMap numbered() {
  HeightMap map(Grid{4, 6, 0.1, 0.1, {1.0, 2.0}});
  for (std::size_t i = 0; i < map.values.size(); ++i) map.values[i] = static_cast<double>(i);
  return map;
}

TEST(Aperture, ParsesAndPrintsEveryForm) {
  for (const std::string text :
       {"map", "rect:-1,0.5,2,3.25", "circle:0.1,-2,30", "ellipse:1,2,3,0.5,-30", "annulus:-1,2,0,5.5",
        "polygon:0,0,4,0.5,3,2", "polygon:0,0,4,0,4,4,0,4/1,1,2,1,2,2"}) {
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
  refused("square:1,2,3", "unknown form");
  refused("circle", "unknown form");
  refused("ellipse:1,2,3", "3 numbers given, 4 or 5 required");
  refused("ellipse:1,2,0,1", "half axis is not positive");
  refused("annulus:1,2,3,3", "ring is empty");
  refused("annulus:1,2,-1,3", "ring is empty");
  refused("polygon:1,2,3,4", "ring of 4 numbers");
  refused("polygon:1,2,3,4,5,6,7", "ring of 7 numbers");
  refused("polygon:1,2,3,4,5,6/", "'' is not a finite number");
  refused("polygon:1,2,3,4,5,inf", "'inf' is not");
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

/// Every pixel of a 41 x 57 map with unequal pitches against a rule of x and y.
template <class Rule>
void expect_area(const std::string& text, const Rule& inside) {
  HeightMap map(Grid{41, 57, 0.21, 0.17, {-5.3, -2.9}});
  for (double& v : map.values) v = 1.0;
  const HeightMap kept = within(map, parse_aperture(text)), rest = outside(map, parse_aperture(text));
  Index count = 0;
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    EXPECT_EQ(std::isfinite(kept.values[static_cast<std::size_t>(i)]), inside(p.x, p.y))
        << text << " " << p.x << " " << p.y;
    EXPECT_NE(std::isfinite(kept.values[static_cast<std::size_t>(i)]),
              std::isfinite(rest.values[static_cast<std::size_t>(i)]));
    count += inside(p.x, p.y) ? 1 : 0;
  }
  EXPECT_GT(count, 100);
  EXPECT_LT(count, map.grid.size() - 100);
}

TEST(Aperture, AreasAreThoseOfTheirEquations) {
  expect_area("ellipse:0.3,0.5,4,1.5",
              [](double x, double y) { return (x - 0.3) * (x - 0.3) / 16.0 + (y - 0.5) * (y - 0.5) / 2.25 <= 1.0; });
  // The long axis along (3, 4) / 5, 53.13 degrees counter-clockwise of +x.
  expect_area("ellipse:0.3,0.5,4,1.5,53.13010235415598", [](double x, double y) {
    const double u = 0.6 * (x - 0.3) + 0.8 * (y - 0.5), v = 0.6 * (y - 0.5) - 0.8 * (x - 0.3);
    return u * u / 16.0 + v * v / 2.25 <= 1.0;
  });
  expect_area("annulus:0.3,0.5,1.1,2.9", [](double x, double y) {
    const double r = std::hypot(x - 0.3, y - 0.5);
    return r >= 1.1 && r <= 2.9;
  });
  // An L with a square hole and a triangular island in the hole.
  expect_area(
      "polygon:-4,-2.5,5,-2.5,5,0.57,0.1,0.57,0.1,3.3,-4,3.3/-3,-1.5,-1,-1.5,-1,1.5,-3,1.5/"
      "-2.8,-1.3,-1.2,-1.3,-2.8,1.3",
      [](double x, double y) {
        const bool foot = x >= -4 && x <= 5 && y >= -2.5 && y <= 0.57;
        const bool leg = x >= -4 && x <= 0.1 && y >= -2.5 && y <= 3.3;
        const bool hole = x > -3 && x < -1 && y > -1.5 && y < 1.5;
        const bool island = x >= -2.8 && y >= -1.3 && (x + 1.2) * 2.6 + (y + 1.3) * 1.6 <= 0.0;
        return ((foot || leg) && !hole) || island;
      });
}

TEST(Aperture, BoundariesOfAPolygonBelongToIt) {
  // Corners and sides on pixel centres (0.1 mm apart, rounded): a triangle with a corner below, its mirror image and
  // sides that slope.
  const HeightMap kept = within(numbered(), parse_aperture("polygon:1.1,2.1,1.3,2.1,1.2,2.3"));
  EXPECT_EQ(kept.valid_pixels(), 5);  // 3 on the base, (1.2, 2.2) and the corner (1.2, 2.3)
  EXPECT_TRUE(std::isfinite(kept.at(3, 2)));
  EXPECT_EQ(within(numbered(), parse_aperture("polygon:1.1,2.3,1.3,2.3,1.2,2.1")).valid_pixels(), 5);
  EXPECT_EQ(within(numbered(), parse_aperture("polygon:1.1,2.0,1.4,2.3,1.1,2.3")).valid_pixels(), 10);
}

TEST(Aperture, OutsideRefusesToLeaveNothing) {
  test::expect_input_error([] { outside(numbered(), parse_aperture("rect:0,0,9,9")); }, {"rect:0,0,9,9", "outside it"});
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
