#include "runs/figure/campaign.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dwell {
namespace {

/// An elliptic part in waves that the tool reaches, on pixels that are not square; without symmetry.
CampaignStart small_start() {
  HeightMap map(Grid{34, 50, 1.0, 1.1, {-25.0, -18.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    const bool outside = p.x * p.x / 560.0 + p.y * p.y / 280.0 > 1.0;
    map.values[static_cast<std::size_t>(i)] =
        outside ? std::nan("")
                : 90.0 * std::cos(p.x / 5.0 + 0.3) + 70.0 * std::sin(p.y / 4.0 + p.x / 9.0) + 0.2 * p.x * p.y;
  }
  CampaignStart start;
  start.surface = map;
  start.tif = gaussian_removal(15.0, 7.0, 10.0);
  start.form = {true, true};
  start.path = parse_path_spec("raster:pitch=1.5,overrun=6");
  return start;
}

const CampaignTruth kWrong{1.25, 0.93, {0.3, -0.35}, 0.25, 0.01, 0.2};

TEST(Campaign, LearnsTheToolAndTheMachineFromItsFirstRun) {
  const Campaign campaign = simulate_campaign(small_start(), kWrong, {}, 2, 5);
  ASSERT_EQ(campaign.runs.size(), 2U);
  EXPECT_EQ(campaign.fault, "");
  const ToolLesson& lesson = *campaign.runs[0].lesson;
  EXPECT_NEAR(lesson.rate, 1.25, 0.04);  // drift 1 %
  EXPECT_NEAR(lesson.width, 0.93, 0.01);
  EXPECT_NEAR(lesson.shift.x, 0.3, 0.02);
  EXPECT_NEAR(lesson.shift.y, -0.35, 0.02);
  EXPECT_NEAR(lesson.degrees, 0.25, 0.05);
  EXPECT_GT(campaign.runs[0].after, 15.0);
  EXPECT_LT(campaign.runs[1].after, 3.0);
  EXPECT_EQ(campaign.runs[1].lesson->shift, Point{});  // made up for
}

TEST(Campaign, IsWorseWithoutLearning) {
  CampaignLearning none;
  none.learns = false;
  const Campaign blind = simulate_campaign(small_start(), kWrong, none, 2, 5);
  const Campaign learnt = simulate_campaign(small_start(), kWrong, {}, 2, 5);
  EXPECT_EQ(blind.runs[0].after, learnt.runs[0].after);  // the same seed
  EXPECT_GT(blind.runs[1].after, 2.0 * learnt.runs[1].after);
}

TEST(Campaign, EndsAtAnErrorOfOrientation) {
  CampaignTruth off = kWrong;
  off.shift = {2.4, 0.0};
  const Campaign campaign = simulate_campaign(small_start(), off, {}, 3, 5);
  EXPECT_EQ(campaign.runs.size(), 1U);
  EXPECT_NE(campaign.fault.find("orientation"), std::string::npos) << campaign.fault;
}

}  // namespace
}  // namespace dwell
