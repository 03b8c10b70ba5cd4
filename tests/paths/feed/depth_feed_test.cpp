#include "paths/feed/depth_feed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

/// A plane sampled without symmetry, with a hole.
HeightMap plane() {
  HeightMap map(Grid{9, 14, 0.5, 0.7, {-1.0, 2.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    map.values[static_cast<std::size_t>(i)] = 50.0 + 8.0 * p.x + 3.0 * p.y;
  }
  return map;
}

ToolPath zigzag() {
  return {"file", {{0.0, 3.0}, {0.3, 3.1}, {0.6, 3.0}, {2.0, 5.0}, {2.4, 5.3}, {9.0, 9.0}}, {1, 0, 0, 1, 0, 1}};
}

TEST(DepthFeed, IsEquation12) {
  const ToolPath path = zigzag();
  const std::vector<double> pitch{0.8, 0.8, 0.8, 0.4, 0.4, 0.4};
  const DepthFeed feed = depth_feed(plane(), path, pitch, {200.0, 20.0, 100.0});
  const std::vector<Stroke> strokes = moving_strokes(path);
  double total = 0.0;
  for (std::size_t j = 0; j < 5; ++j) {
    const Point p = path.points[j];
    const double depth = 50.0 + 8.0 * p.x + 3.0 * p.y - 20.0;
    EXPECT_NEAR(feed.speed[j], 200.0 / (pitch[j] * depth), 1e-9) << j;
    EXPECT_NEAR(feed.dwell[static_cast<Index>(j)], strokes[j].length() / feed.speed[j], 1e-12) << j;
    total += feed.dwell[static_cast<Index>(j)];
  }
  EXPECT_EQ(feed.speed[5], 0.0) << "a point alone is a halt";
  EXPECT_EQ(feed.dwell[5], 0.0);
  EXPECT_NEAR(feed.total_seconds, total, 1e-12);
  EXPECT_EQ(feed.limited, 0u);
}

TEST(DepthFeed, TheMachinesFeedIsItsLimit) {
  const ToolPath path = zigzag();
  const std::vector<double> pitch(6, 0.5);
  const DepthFeed feed = depth_feed(plane(), path, pitch, {200.0, 68.0, 25.0});
  std::size_t limited = 0;
  for (std::size_t j = 0; j < 5; ++j) {
    const Point p = path.points[j];
    const double depth = std::max(0.0, 50.0 + 8.0 * p.x + 3.0 * p.y - 68.0);
    const double wanted = depth > 0.0 ? 200.0 / (0.5 * depth) : test::kInf;
    limited += wanted > 25.0 ? 1 : 0;
    EXPECT_NEAR(feed.speed[j], std::min(25.0, wanted), 1e-9) << j;
  }
  EXPECT_EQ(feed.limited, limited);
  EXPECT_GT(limited, 0u);
  EXPECT_LT(limited, 5u);
  const DepthFeed free = depth_feed(plane(), path, pitch, {200.0, 1000.0, test::kInf});
  EXPECT_EQ(free.total_seconds, 0.0) << "nothing to remove and no limit: no time";
  EXPECT_EQ(free.speed[0], test::kInf);
}

TEST(DepthFeed, AMoveToTheNextLineAsksForNoRemoval) {
  const ToolPath path = zigzag();
  const std::vector<double> pitch(6, 0.5);
  DepthFeedJob job{200.0, 20.0, test::kInf, 0.3};
  const DepthFeed feed = depth_feed(plane(), path, pitch, job);
  const std::vector<Stroke> strokes = moving_strokes(path);
  for (std::size_t j = 0; j < 5; ++j) {
    const Point p = path.points[j];
    const double depth = 50.0 + 8.0 * p.x + 3.0 * p.y - 20.0;
    EXPECT_NEAR(feed.dwell[static_cast<Index>(j)], depth * 0.5 * 0.3 / 200.0, 1e-12) << j;
    EXPECT_NEAR(feed.speed[j], strokes[j].length() / feed.dwell[static_cast<Index>(j)], 1e-9) << j;
  }
  EXPECT_GT(feed.dwell[5], 0.0) << "a halt stands for a step as well";
  EXPECT_EQ(feed.speed[5], 0.0);
  job.max_feed = 1.0;
  const DepthFeed slow = depth_feed(plane(), path, pitch, job);
  for (std::size_t j = 0; j < 5; ++j) {
    EXPECT_NEAR(slow.dwell[static_cast<Index>(j)], std::max(feed.dwell[static_cast<Index>(j)], strokes[j].length()),
                1e-12);
  }
}

TEST(DepthFeed, BeyondThePartTheNearestPixelCounts) {
  HeightMap map = test::map_from_picture({"9..", "...", "123"});
  const ToolPath path{"file", {{-5.0, -5.0}, {-4.0, -5.0}, {7.0, 0.0}, {8.0, 0.0}}, {1, 0, 1, 0}};
  const DepthFeed feed = depth_feed(map, path, {1.0, 1.0, 1.0, 1.0}, {6.0, 0.0, test::kInf});
  EXPECT_DOUBLE_EQ(feed.speed[0], 6.0);
  EXPECT_DOUBLE_EQ(feed.speed[3], 2.0);
}

TEST(DepthFeed, RefusesWhatIsOutOfRange) {
  const ToolPath path = zigzag();
  const std::vector<double> pitch(6, 0.5);
  const auto message = [&](const std::vector<double>& pitches, const DepthFeedJob& job) {
    return test::message_of([&] { depth_feed(plane(), path, pitches, job); });
  };
  EXPECT_EQ(message({1.0}, {1.0, 0.0, 1.0}), "depth feed: 1 pitches for 6 dwell points; required one each");
  EXPECT_EQ(message({1, 1, 0, 1, 1, 1}, {1.0, 0.0, 1.0}),
            "depth feed: pitch of point 3 = 0 mm; required finite and > 0");
  EXPECT_EQ(message(pitch, {-1.0, 0.0, 1.0}), "depth feed: volume = -1 nm mm^2/s; required finite and > 0");
  EXPECT_EQ(message(pitch, {1.0, test::kNaN, 1.0}), "depth feed: lowest = nan nm; required finite");
  EXPECT_EQ(message(pitch, {1.0, 0.0, 1.0, 0.0}), "depth feed: step = 0 mm; required > 0");
  EXPECT_EQ(message(pitch, {1.0, 0.0, test::kNaN}), "depth feed: max_feed = nan mm/s; required > 0");
}

}  // namespace
}  // namespace dwell
