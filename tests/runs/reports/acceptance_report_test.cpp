#include "runs/reports/acceptance_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dwell {
namespace {

/// A surface on pixels that are not square, and the figures that its exact check found, which are others.
ExactResidual left() {
  ExactResidual left;
  left.surface = HeightMap(Grid{12, 20, 0.5, 0.25, {-1.0, 2.0}});
  for (Index i = 0; i < left.surface.grid.size(); ++i)
    left.surface.values[static_cast<std::size_t>(i)] = 2.0 * std::sin(0.7 * static_cast<double>(i));
  left.statistics.mean = 3.0;
  left.statistics.rms = 4.0;
  left.statistics.pv = 17.0;
  return left;
}

TEST(AcceptanceReport, JudgesByTheFiguresThatThePlanShows) {
  const auto verdicts = judge_residual(left(), parse_surface_limits("rms<=5, pv<=16, slope<=1e9", {8.0, 2.0}), 1, {});
  ASSERT_EQ(verdicts.size(), 3U);
  EXPECT_DOUBLE_EQ(*verdicts[0].value, 5.0);  // about zero
  EXPECT_TRUE(verdicts[0].passes());
  EXPECT_DOUBLE_EQ(*verdicts[1].value, 17.0);
  EXPECT_FALSE(verdicts[1].passes());
  EXPECT_TRUE(verdicts[2].passes());
  const auto unmet = unmet_limits(verdicts);
  ASSERT_EQ(unmet.size(), 1U);
  EXPECT_EQ(unmet[0], "accepted is pv<=16 nm, the surface has 17 nm");
  const auto block = acceptance_block(verdicts);
  EXPECT_EQ(block["passes"], false);
  EXPECT_EQ(block["limits"][1]["margin"], -1.0);
  EXPECT_EQ(block["limits"][2]["unit"], "urad");
  EXPECT_TRUE(judge_residual(left(), {}, 1, {}).empty());
}

TEST(AcceptanceReport, LetsNothingPassThatIsNoNumber) {
  ExactResidual none = left();
  none.statistics.rms = std::numeric_limits<double>::quiet_NaN();
  const auto verdicts = judge_residual(none, parse_surface_limits("rms<=5, band(200..300mm)<=1", {8.0, 2.0}), 1, {});
  EXPECT_FALSE(verdicts[0].passes());
  EXPECT_FALSE(verdicts[1].passes());
  EXPECT_EQ(unmet_limits(verdicts).size(), 2U);
  EXPECT_TRUE(acceptance_block(verdicts)["limits"][0]["value"].is_null());
}

}  // namespace
}  // namespace dwell
