#include "runs/figure/learnt_frame.h"

#include <gtest/gtest.h>

#include "core/numerics/plane_transform.h"
#include "runs/job/program_style.h"

namespace dwell {
namespace {

TEST(LearntFrame, TellsTheMachineWhatMakesItRemoveWhereItIsMeant) {
  JobOptions options;
  options.zero_mm = {12.5, -3.25}, options.rotate_deg = 90.0, options.swap_axes = true;
  options.tif_rate = 1.1, options.tif_width = 0.98;
  ToolLesson lesson;
  lesson.rate = 1.2, lesson.width = 1.05, lesson.shift = {0.31, -0.17}, lesson.degrees = 0.4;
  const Point about{7.0, 2.0};
  const JobOptions learnt = with_learnt(options, lesson, about);
  const PlaneTransform removes_at = similarity(about, lesson.shift, lesson.degrees, 1.0);
  for (const Point p : {Point{0.0, 0.0}, Point{31.0, -4.0}, Point{-8.0, 17.5}}) {
    // Told what it was told for p before, the machine removed at removes_at(p).
    const Point before = program_frame(options).to_program(p), now = program_frame(learnt).to_program(removes_at(p));
    EXPECT_NEAR(now.x, before.x, 2e-6);  // zero is written to 1e-6 mm
    EXPECT_NEAR(now.y, before.y, 2e-6);
  }
  EXPECT_DOUBLE_EQ(learnt.tif_rate, 1.32);
  EXPECT_DOUBLE_EQ(learnt.tif_width, 0.98 * 1.05);
  EXPECT_TRUE(learnt.swap_axes);
}

TEST(LearntFrame, CannotChangeProgramsThatSayPlacesOfThePart) {
  JobOptions options;
  EXPECT_EQ(why_frame_is_fixed(options), "");
  options.exports = {"pvt-csv"};
  EXPECT_NE(why_frame_is_fixed(options).find("pvt-csv"), std::string::npos);
}

}  // namespace
}  // namespace dwell
