#include "paths/feed/feed.h"

#include <gtest/gtest.h>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

using test::kInf;
using test::kNaN;

/// Strokes of 2, 2 and 2 mm, then a halt.
std::vector<Stroke> strokes() {
  ToolPath path;
  path.points = {{0, 0}, {2, 0}, {4, 0}, {9, 9}};
  path.lifted = {1, 0, 0, 1};
  return moving_strokes(path);
}

Eigen::VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(), static_cast<Index>(values.size()));
}

TEST(Feed, MinimumDwellIsTheLargerOfBothLimits) {
  EXPECT_EQ(minimum_dwell(strokes(), {0.1, 10.0}), vector({0.2, 0.2, 0.2, 0.1}));
  EXPECT_EQ(minimum_dwell(strokes(), {0.5, 10.0}), vector({0.5, 0.5, 0.5, 0.5}));
  EXPECT_EQ(minimum_dwell(strokes(), {}), vector({0.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(minimum_dwell(halting_strokes({"", {{0, 0}, {2, 0}}, {1, 0}}), {0.0, 10.0}), vector({0.0, 0.0}));
}

TEST(Feed, SpeedIsLengthOverDwellAndZeroForAHalt) {
  const FeedSchedule schedule = feed_schedule(strokes(), vector({1.0, 0.5, 4.0, 7.0}), {0.0, 10.0});
  EXPECT_EQ(schedule.speed, (std::vector<double>{2.0, 4.0, 0.5, 0.0}));
  EXPECT_EQ(schedule.min_speed, 0.5);
  EXPECT_EQ(schedule.max_speed, 4.0);
  EXPECT_EQ(schedule.segments_limited, 0);
  EXPECT_EQ(schedule.segments_infeasible, 0);
}

TEST(Feed, CountsStrokesAtAndBelowTheirBound) {
  // Bounds 0.2, 0.2, 0.2 and 0.1 s: at it within 1e-9, above it, below it, at it.
  const FeedSchedule schedule = feed_schedule(strokes(), vector({0.2 * (1 - 5e-10), 0.2001, 0.1999, 0.1}), {0.1, 10.0});
  EXPECT_EQ(schedule.segments_limited, 2);
  EXPECT_EQ(schedule.segments_infeasible, 1);
  EXPECT_GT(schedule.max_speed, 10.0);
  const FeedSchedule bound = feed_schedule(strokes(), minimum_dwell(strokes(), {0.1, 7.0}), {0.1, 7.0});
  EXPECT_EQ(bound.segments_limited, 4);
  EXPECT_EQ(bound.segments_infeasible, 0);
  EXPECT_LE(bound.max_speed, 7.0 * (1 + 1e-14));
}

TEST(Feed, NoTimeOnALengthIsInfeasibleOnAHaltItIsNot) {
  const FeedSchedule schedule = feed_schedule(strokes(), vector({1.0, 0.0, 1.0, 0.0}), {});
  EXPECT_EQ(schedule.speed[1], kInf);
  EXPECT_EQ(schedule.max_speed, kInf);
  EXPECT_EQ(schedule.segments_infeasible, 1);
  EXPECT_EQ(schedule.segments_limited, 0);
}

TEST(Feed, HaltsAloneHaveNoSpeed) {
  const FeedSchedule schedule = feed_schedule({Stroke{}, Stroke{}}, vector({1.0, 2.0}), {0.0, 1.0});
  EXPECT_EQ(schedule.min_speed, 0.0);
  EXPECT_EQ(schedule.max_speed, 0.0);
}

TEST(Feed, RefusesBadLimitsAndDwell) {
  const auto limits = [](FeedLimits l) { return test::message_of([&] { minimum_dwell(strokes(), l); }); };
  EXPECT_EQ(limits({-0.1, 1.0}), "feed: min_dwell = -0.1 s; required finite and >= 0");
  EXPECT_EQ(limits({kNaN, 1.0}), "feed: min_dwell = nan s; required finite and >= 0");
  EXPECT_EQ(limits({kInf, 1.0}), "feed: min_dwell = inf s; required finite and >= 0");
  EXPECT_EQ(limits({0.0, 0.0}), "feed: max_feed = 0 mm/s; required > 0");
  EXPECT_EQ(limits({0.0, kNaN}), "feed: max_feed = nan mm/s; required > 0");
  const auto dwell = [](std::initializer_list<double> t) {
    return test::message_of([&] { feed_schedule(strokes(), vector(t), {0.0, 1.0}); });
  };
  EXPECT_EQ(dwell({1, 1, 1}), "feed: 3 dwell times for 4 strokes; one a stroke required");
  EXPECT_EQ(dwell({1, 1, kNaN, 1}), "feed: dwell of stroke 3 = nan s; required finite and >= 0");
  EXPECT_EQ(dwell({1, -2, 1, 1}), "feed: dwell of stroke 2 = -2 s; required finite and >= 0");
  EXPECT_EQ(dwell({kInf, 1, 1, 1}), "feed: dwell of stroke 1 = inf s; required finite and >= 0");
}

}  // namespace
}  // namespace dwell
