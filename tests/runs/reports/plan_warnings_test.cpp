#include "runs/reports/plan_warnings.h"

#include <gtest/gtest.h>

namespace dwell {
namespace {

TEST(RunWarnings, QuestionALongRunAndASlowFeed) {
  EXPECT_TRUE(run_warnings({86400.0, 86000.0, 3000.0}).empty());
  const auto both = run_warnings({48 * 86400.0 + 60.0, 4147200.0, 3800.0});  // 0.055 mm/min
  ASSERT_EQ(both.size(), 2u);
  EXPECT_TRUE(both[0].starts_with("the run takes 48 d 0:01:00, over 24 h: a removal function of a higher rate"));
  EXPECT_TRUE(both[1].starts_with("the mean feed is 0.055 mm/min, below 1 mm/min")) << both[1];
  EXPECT_NE(both[1].find("`time price`"), std::string::npos);
  EXPECT_TRUE(run_warnings({700.0, 600.0, 0.0}).empty());  // halts alone have no feed
  EXPECT_TRUE(run_warnings({0.0, 0.0, 0.0}).empty());
}

}  // namespace
}  // namespace dwell
