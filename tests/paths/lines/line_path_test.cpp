#include "paths/lines/line_path.h"

#include <gtest/gtest.h>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

using test::full_map;
using test::map_from_picture;
using test::message_of;

std::vector<double> places(const ToolPath& path) {
  std::vector<double> x;
  for (const Point p : path.points) x.push_back(p.x);
  return x;
}

TEST(LinePath, RunsAlongTheLineAndBeyondBothEnds) {
  // Pixels from x = 10 to 14 mm; 6 mm with the overrun hold 5 points of step 1.5, symmetric about 12.
  const ToolPath path = line_path(full_map(1, 9, 0.5, 2.0, {10.0, -0.75}), {1.5, 0.0, 1.0});
  EXPECT_EQ(path.kind, "line");
  EXPECT_EQ(places(path), (std::vector<double>{9.0, 10.5, 12.0, 13.5, 15.0}));
  for (const Point p : path.points) EXPECT_EQ(p.y, 0.0);
  EXPECT_EQ(path.lifted, (std::vector<char>{1, 0, 0, 0, 0}));
}

TEST(LinePath, CountsTheRowsThatItTouchesAndCrossesHoles) {
  const HeightMap map = map_from_picture({"111111111", "..11..11.", ".11...1..", "111111111"});
  EXPECT_EQ(places(line_path(map, {1.0, 1.0, {}})), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  // Between the two rows in the middle: both of them.
  EXPECT_EQ(places(line_path(map, {1.0, 1.5, {}})), (std::vector<double>{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(line_path(map, {100.0, 0.0, {}}).size(), 1u);
}

TEST(LinePath, RefusesByOptionAndValue) {
  const HeightMap map = map_from_picture({"1111", "....", "1.11"}, 0.5, {3.0, -7.0});
  EXPECT_EQ(message_of([&] {
              line_path(map, {1.0, 0.0, {}});
            }),
            "line: y = 0 mm: the line meets no pixel with data; the part has y from -7 to -6 mm");
  EXPECT_NE(message_of([&] { line_path(map, {1.0, -6.5, {}}); }).find("meets no pixel"), std::string::npos);
  EXPECT_EQ(message_of([&] { line_path(map, {0.0, -7.0, {}}); }), "line: step = 0 mm; required > 0");
  EXPECT_EQ(message_of([&] { line_path(map, {test::kNaN, -7.0, {}}); }), "line: step = nan mm; required > 0");
  EXPECT_EQ(message_of([&] { line_path(map, {1.0, -7.0, -1.0}); }), "line: overrun = -1 mm; required >= 0");
  EXPECT_EQ(message_of([&] { line_path(map, {1.0, test::kNaN, {}}); }), "line: y = nan mm; required finite");
  EXPECT_NE(message_of([&] { line_path(map, {1e-9, -7.0, {}}); }).find("line: "), std::string::npos);
}

}  // namespace
}  // namespace dwell
