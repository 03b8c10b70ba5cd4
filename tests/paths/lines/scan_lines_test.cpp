#include "paths/lines/scan_lines.h"

#include <gtest/gtest.h>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

TEST(LinePositions, FindsTheNearestOfUnequallySpacedLines) {
  const LinePositions lines(std::vector<double>{-3.0, -2.5, 0.0, 4.0});
  for (double v = -6.0; v < 8.0; v += 0.0937) {
    Index nearest = 0;
    for (Index i = 1; i < lines.count(); ++i) {
      if (std::abs(v - lines.at(i)) < std::abs(v - lines.at(nearest))) nearest = i;
    }
    EXPECT_EQ(lines.nearest(v), nearest) << v;
  }
  EXPECT_EQ(lines.nearest(2.0), 3) << "the upper of two equally near ones";
  EXPECT_EQ(lines.nearest(-2.75), 1);
}

TEST(ScanFrame, HoldsThePixelsInTheTurnedFrame) {
  const HeightMap map = test::map_from_picture({"..1..", ".....", "....1"}, 2.0, {1.0, 3.0});
  const ScanFrame frame = scan_frame(map, 90.0, "raster");  // pixels at (9, 3) and (5, 7)
  EXPECT_EQ(frame.along, (Point{0.0, 1.0}));
  EXPECT_EQ(frame.u.low, 3.0);
  EXPECT_EQ(frame.u.high, 7.0);
  EXPECT_EQ(frame.v.low, -9.0);
  EXPECT_EQ(frame.v.high, -5.0);
  EXPECT_EQ(test::message_of([] {
              scan_frame(HeightMap(Grid{3, 2, 1.0, 1.0, {}}), 0.0, "raster");
            }),
            "raster: the map has no finite pixel; at least one is required");
}

}  // namespace
}  // namespace dwell
