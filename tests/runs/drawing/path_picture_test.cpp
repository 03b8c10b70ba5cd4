#include "runs/drawing/path_picture.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/base/expect_error.h"
#include "tests/runs/drawing/decoded_png.h"

namespace dwell {
namespace {

using testing::decode_png;
using testing::DecodedPng;

constexpr Colour kTrack{24, 24, 24}, kJumpRed{220, 30, 30}, kGreen{20, 150, 60};

struct Found {
  int count = 0;
  double x = 0.0, y = 0.0;  // mean position [pixels], y down
};

Found find(const DecodedPng& png, Colour colour) {
  Found found;
  for (int y = 0; y < png.height; ++y) {
    for (int x = 0; x < png.width; ++x) {
      if (!(png.at(x, y) == colour)) continue;
      ++found.count;
      found.x += x;
      found.y += y;
    }
  }
  if (found.count > 0) found.x /= found.count, found.y /= found.count;
  return found;
}

HeightMap flat(double height) {
  HeightMap map(Grid{40, 60, 0.5, 0.5, {-3.0, 2.0}});
  for (double& v : map.values) v = height;
  return map;
}

TEST(PathPicture, DrawsTheTracksWhereTheyAre) {
  // A line across the lower part of the map: dark pixels low in the picture, the start at the left.
  const ToolPath path{"file", {{0.0, 5.0}, {10.0, 5.0}, {20.0, 5.0}}, {1, 0, 0}};
  const DecodedPng png = decode_png(path_picture(flat(1.0), path, "title"));
  const Found track = find(png, kTrack), start = find(png, kGreen), end = find(png, kJumpRed);
  EXPECT_GT(track.count, 300);
  EXPECT_GT(track.y, 0.55 * png.height);
  EXPECT_GT(start.count, 50);
  EXPECT_GT(end.count, 50);
  EXPECT_LT(start.x, end.x);
  EXPECT_NEAR(start.y, end.y, 1.0);
}

TEST(PathPicture, DrawsLiftedMovesInRed) {
  const HeightMap map = flat(1.0);
  const ToolPath joined{"file", {{0.0, 5.0}, {5.0, 5.0}, {5.0, 15.0}, {10.0, 15.0}}, {1, 0, 0, 0}};
  ToolPath lifted = joined;
  lifted.lifted[2] = 1;
  EXPECT_GT(find(decode_png(path_picture(map, lifted, "t")), kJumpRed).count,
            find(decode_png(path_picture(map, joined, "t")), kJumpRed).count + 100);
}

TEST(PathPicture, ShowsTheOrderOfADensePathAndItsDetail) {
  const HeightMap map = flat(1.0);
  ToolPath path{"file", {}, {}};
  for (int line = 0; line < 200; ++line) {
    for (int k = 0; k < 300; ++k) path.points.push_back({-3.0 + 0.1 * (line % 2 ? 299 - k : k), 2.0 + 0.1 * line});
  }
  path.lifted.assign(path.size(), 0);
  EXPECT_EQ(find(decode_png(path_picture(map, path, "t")), kTrack).count, 0);
  const DecodedPng detail = decode_png(path_detail_picture(map, path, "t"));
  EXPECT_GT(find(detail, kTrack).count, 10000);
  EXPECT_LT(find(detail, kTrack).count, detail.width * detail.height / 4);
  EXPECT_LE(detail.width, 1600);
}

TEST(PathPicture, ALongPathCanBeInterrupted) {
  ToolPath path{"file", {}, {}};
  for (int k = 0; k < 300000; ++k) path.points.push_back({1e-4 * k - 3.0, 2.0 + 15.0 * (k % 2)});
  path.lifted.assign(path.size(), 0);
  int looks = 0;
  Progress stop_later;
  stop_later.stop = [&] { return ++looks > 3; };
  EXPECT_THROW(path_picture(flat(1.0), path, "t", FigureFormat::Png, stop_later), Interrupted);
  looks = 0;
  EXPECT_THROW(path_detail_picture(flat(1.0), path, "t", FigureFormat::Png, stop_later), Interrupted);
}

TEST(PathPicture, TakesOnePointAndRefusesNone) {
  EXPECT_GT(find(decode_png(path_picture(flat(0.0), {"file", {{1.0, 3.0}}, {1}}, "t")), kJumpRed).count, 10);
  EXPECT_GT(path_detail_picture(flat(0.0), {"file", {{1.0, 3.0}}, {1}}, "t").size(), 100u);
  test::expect_input_error([] { path_picture(flat(0.0), {}, "t"); }, {"no dwell points"});
}

}  // namespace
}  // namespace dwell
