#include "runs/figure/tool_lesson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace dwell {
namespace {

RemovalRegistration found() {
  RemovalRegistration found;
  found.rate = {1.31, 0.004};
  found.width = {1.06, 0.01};
  found.x = {0.3, 0.02}, found.y = {-0.4, 0.03};
  found.degrees = {0.2, 0.01};
  return found;
}

TEST(ToolLesson, TakesOverWhatIsCertainAndMatters) {
  const ToolLesson lesson = learn_from(found(), 10.0);
  EXPECT_EQ(lesson.orientation_fault, "");
  EXPECT_EQ(lesson.rate, 1.31);
  EXPECT_EQ(lesson.width, 1.06);
  EXPECT_EQ(lesson.shift, (Point{0.3, -0.4}));
  EXPECT_EQ(lesson.degrees, 0.2);
  ASSERT_EQ(lesson.decisions.size(), 4U);
  EXPECT_NEAR(lesson.decisions[2].found.value, 0.5, 1e-15);
  EXPECT_NEAR(lesson.decisions[2].found.error, 0.0268, 1e-4);  // along the shift
  EXPECT_NEAR(lesson.decisions[2].threshold, 0.0805, 1e-4);
  EXPECT_EQ(lesson.decisions[0].sentence(), "rate 1.31 +- 0.004 of what was thought: taken");
  EXPECT_EQ(lesson.decisions[2].sentence(), "shift 0.5 +- 0.027 mm: taken, beyond 0.08");
}

TEST(ToolLesson, LeavesWhatIsNoise) {
  RemovalRegistration noise = found();
  noise.width = {1.02, 0.01};
  noise.x = {0.03, 0.001}, noise.y = {0.02, 0.001};  // certain, but 36 um
  noise.degrees = {0.05, 0.03};                      // 0.87 mrad, of 1.6 required
  const ToolLesson lesson = learn_from(noise, 10.0);
  EXPECT_EQ(lesson.width, 1.0);
  EXPECT_EQ(lesson.shift, Point{});
  EXPECT_EQ(lesson.degrees, 0.0);
  EXPECT_EQ(lesson.decisions[1].sentence(), "width 1.02 +- 0.01 of what was thought: left, within 0.03");
  EXPECT_EQ(lesson.decisions[3].sentence(), "rotation 0.8727 +- 0.52 mrad: left, within 1.6");
}

TEST(ToolLesson, ClipsAndFollowsTheUser) {
  RemovalRegistration wild = found();
  wild.rate = {3.0, 0.01}, wild.width = {0.5, 0.01};
  LessonPolicy policy;
  policy.left = {LessonSubject::Shift};
  policy.taken = {LessonSubject::Rotation};
  wild.degrees = {0.01, 0.02};
  const ToolLesson lesson = learn_from(wild, 10.0, policy);
  EXPECT_EQ(lesson.rate, 2.0);
  EXPECT_EQ(lesson.width, 0.8);
  EXPECT_EQ(lesson.shift, Point{});
  EXPECT_EQ(lesson.degrees, 0.01);
  EXPECT_NE(lesson.decisions[0].sentence().find("taken as 2, the most in one run"), std::string::npos);
  EXPECT_NE(lesson.decisions[2].sentence().find("left because it was asked for"), std::string::npos);
}

TEST(ToolLesson, DoesNotAbsorbAnErrorOfOrientation) {
  RemovalRegistration off = found();
  off.x = {-2.4, 0.02}, off.y = {1.0, 0.02};
  const ToolLesson lesson = learn_from(off, 10.0);
  EXPECT_NE(lesson.orientation_fault.find("2.6 +- 0.02 mm (-2.4 in x, 1 in y)"), std::string::npos)
      << lesson.orientation_fault;
  EXPECT_EQ(lesson.rate, 1.0);
  EXPECT_EQ(lesson.shift, Point{});
  EXPECT_EQ(learn_from(off, 11.0).orientation_fault, "");  // a quarter of 11 mm is more
  LessonPolicy policy;
  policy.taken = {LessonSubject::Shift};
  EXPECT_EQ(learn_from(off, 10.0, policy).shift, (Point{-2.4, 1.0}));
}

TEST(ToolLesson, NeverTakesWhatWasNotFitted) {
  RemovalRegistration bare;
  LessonPolicy policy;
  policy.taken = {LessonSubject::Width, LessonSubject::Rotation};
  const ToolLesson lesson = learn_from(bare, 10.0, policy);
  EXPECT_EQ(lesson.rate, 1.0);
  EXPECT_FALSE(lesson.decisions[1].applied);
  EXPECT_NE(lesson.decisions[1].sentence().find("was not fitted"), std::string::npos);
  bare.rate = {std::nan(""), 0.1};
  EXPECT_EQ(learn_from(bare, 10.0).rate, 1.0);
}

TEST(ToolLesson, WeighsARateWithWhatWasKnown) {
  LessonPolicy later;
  later.expected_rate_change = 0.05;
  RemovalRegistration vague = found();
  vague.rate = {1.3, 0.15};  // what little was removed does not say more
  const ToolLesson lesson = learn_from(vague, 10.0, later);
  EXPECT_NEAR(lesson.rate, 1.0 + 0.3 * 0.1, 1e-12);  // 0.05^2 of 0.05^2 + 0.15^2
  EXPECT_NE(lesson.decisions[0].sentence().find("weighed with what was known"), std::string::npos);
  EXPECT_NEAR(learn_from(found(), 10.0, later).rate, 1.308, 1e-3);  // an error of 0.4 % hardly matters
  LessonPolicy asked = later;
  asked.taken = {LessonSubject::Rate};
  EXPECT_NEAR(learn_from(vague, 10.0, asked).rate, 1.03, 1e-12);  // by the rule as well
}

TEST(ToolLesson, SaysWhyAFixedFrameLeavesTheShift) {
  LessonPolicy fixed;
  fixed.fixed = "tables say places of the part";
  const ToolLesson lesson = learn_from(found(), 10.0, fixed);
  EXPECT_EQ(lesson.shift, Point{});
  EXPECT_EQ(lesson.degrees, 0.0);
  EXPECT_EQ(lesson.rate, 1.31);
  EXPECT_NE(lesson.decisions[2].sentence().find("left: tables say places of the part"), std::string::npos)
      << lesson.decisions[2].sentence();
}

TEST(ToolLesson, TakesALargeTurnForAnErrorOfOrientation) {
  RemovalRegistration turned = found();
  turned.degrees = {8.0, 0.1};
  const ToolLesson lesson = learn_from(turned, 10.0);
  EXPECT_NE(lesson.orientation_fault.find("turned by 8"), std::string::npos) << lesson.orientation_fault;
  EXPECT_EQ(lesson.rate, 1.0);
  LessonPolicy known;
  known.left = {LessonSubject::Rotation};
  EXPECT_EQ(learn_from(turned, 10.0, known).orientation_fault, "");
}

}  // namespace
}  // namespace dwell
