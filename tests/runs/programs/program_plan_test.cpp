#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "paths/feed/plan_program.h"
#include "tests/runs/programs/program_cases.h"

namespace dwell {
namespace {

using program_cases::expect_contains;
using program_cases::input_error;
using program_cases::winding_dwells;
using program_cases::winding_path;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void expect_planned_step(const ProgramStep& step, Point start, Point finish, double seconds, bool removes) {
  EXPECT_LE(distance(step.start, start), 1e-14);
  EXPECT_LE(distance(step.finish, finish), 1e-14);
  EXPECT_LE(std::abs(step.seconds - seconds), 1e-14);
  EXPECT_EQ(step.removes, removes);
}

TEST(ProgramOfMoving, SpreadsEachDwellOverItsStrokeAtOneSpeed) {
  const ToolPath path{"file", {{0, 0}, {2, 0}, {2, 4}}, {1, 0, 0}};
  const Program program = program_of(path, {1.0, 3.0, 5.0}, Motion::Moving, 10.0);
  ASSERT_EQ(program.steps.size(), 4u);
  expect_planned_step(program.steps[0], {-1, 0}, {1, 0}, 1.0, true);
  expect_planned_step(program.steps[1], {1, 0}, {2, 0}, 1.0, true);
  expect_planned_step(program.steps[2], {2, 0}, {2, 2}, 2.0, true);
  expect_planned_step(program.steps[3], {2, 2}, {2, 6}, 5.0, true);
  EXPECT_DOUBLE_EQ(program.total_seconds(), 9.0);
  EXPECT_DOUBLE_EQ(program.removing_length(), 9.0);
}

TEST(ProgramOfMoving, LiftsWhereThePathIsCutAndHaltsAtALonePoint) {
  const ToolPath path{"file", {{0, 0}, {2, 0}, {5, 5}, {9, 1}, {9, 3}}, {1, 0, 1, 1, 0}};
  const Program program = program_of(path, {1.0, 1.0, 4.0, 2.0, 3.0}, Motion::Moving, 10.0);
  ASSERT_EQ(program.steps.size(), 7u);
  expect_planned_step(program.steps[1], {1, 0}, {3, 0}, 1.0, true);
  expect_planned_step(program.steps[2], {3, 0}, {5, 5}, 0.0, false);
  expect_planned_step(program.steps[3], {5, 5}, {5, 5}, 4.0, true);
  expect_planned_step(program.steps[4], {5, 5}, {9, 0}, 0.0, false);
  expect_planned_step(program.steps[5], {9, 0}, {9, 2}, 2.0, true);
  EXPECT_DOUBLE_EQ(program.removing_length(), 8.0);
}

TEST(ProgramOfMoving, KeepsBothHalvesOfAReversal) {
  const ToolPath path{"file", {{0, 0}, {2, 0}, {0, 0}}, {1, 0, 0}};
  const Program program = program_of(path, {1.0, 4.0, 1.0}, Motion::Moving, 10.0);
  ASSERT_EQ(program.steps.size(), 4u);
  expect_planned_step(program.steps[1], {1, 0}, {2, 0}, 2.0, true);
  expect_planned_step(program.steps[2], {2, 0}, {1, 0}, 2.0, true);
}

TEST(ProgramOfMoving, MergesStraightStrokesWhoseCoordinatesAreRoundedAndNoCorner) {
  ToolPath path{"raster", {}, {}};
  const double step = 0.7;
  for (int j = 0; j < 500; ++j) {
    const auto rounded = [](double v) { return std::round(v * 1e6) / 1e6; };
    path.points.push_back({rounded(step * j * std::cos(0.5)), rounded(step * j * std::sin(0.5))});
    path.lifted.push_back(j == 0);
  }
  EXPECT_EQ(program_of(path, std::vector<double>(500, 1.0), Motion::Moving, 10.0).steps.size(), 500u);
  const ToolPath worst{"file", {{0, 0}, {1, 1.4e-6}, {2, 0}}, {1, 0, 0}};  // the most that rounding can bend a line
  EXPECT_EQ(program_of(worst, {1.0, 1.0, 1.0}, Motion::Moving, 10.0).steps.size(), 3u);
  path.points[250].y += 1e-5;  // a bend of 1e-5 mm there, of half that in its neighbours' strokes
  EXPECT_EQ(program_of(path, std::vector<double>(500, 1.0), Motion::Moving, 10.0).steps.size(), 503u);
}

TEST(ProgramOfStop, HaltsAtEachPointAndRunsBetweenAtMaximumFeedRemoving) {
  const ToolPath path{"file", {{0, 0}, {3, 4}, {3, 0}, {7, 0}}, {1, 0, 1, 0}};
  const Program program = program_of(path, {1.0, 0.0, 2.0, 3.0}, Motion::Stop, 10.0);
  ASSERT_EQ(program.steps.size(), 6u);  // no halt of 0 s at the second point
  expect_planned_step(program.steps[0], {0, 0}, {0, 0}, 1.0, true);
  expect_planned_step(program.steps[1], {0, 0}, {3, 4}, 0.5, true);
  expect_planned_step(program.steps[2], {3, 4}, {3, 0}, 0.0, false);
  expect_planned_step(program.steps[3], {3, 0}, {3, 0}, 2.0, true);
  expect_planned_step(program.steps[4], {3, 0}, {7, 0}, 0.4, true);
  expect_planned_step(program.steps[5], {7, 0}, {7, 0}, 3.0, true);
}

TEST(ProgramOf, ChainsItsStepsExactlyAndNeverExceedsMaximumFeed) {
  for (const Motion motion : {Motion::Moving, Motion::Stop}) {
    const Program program = program_of(winding_path(), winding_dwells(motion), motion, 50.0);
    for (std::size_t i = 0; i < program.steps.size(); ++i) {
      const ProgramStep& step = program.steps[i];
      EXPECT_EQ(i > 0 ? program.steps[i - 1].finish : step.start, step.start) << i;
      EXPECT_LE(step.removes ? step.length() : 0.0, 50.0 * step.seconds * (1.0 + 1e-14)) << i;
    }
  }
}

TEST(ProgramOf, RaisesADwellThatRoundingPutBelowTheLimit) {
  const ToolPath path{"file", {{0, 0}, {1, 0}}, {1, 0}};
  const Program program = program_of(path, {0.1 - 1e-7, 0.1}, Motion::Moving, 10.0);
  EXPECT_DOUBLE_EQ(program.steps[0].seconds, 0.1);
}

TEST(SameRemovingSteps, TakesNoMoreThanTheRoundingOfFiles) {
  const Program plan = program_of(winding_path(), winding_dwells(Motion::Moving), Motion::Moving, 50.0);
  EXPECT_TRUE(same_removing_steps(plan, plan, 50.0));
  ASSERT_TRUE(plan.steps[1].removes);
  const auto changed = [&](const std::function<void(ProgramStep&)>& change) {
    Program other = plan;
    change(other.steps[1]);
    return same_removing_steps(plan, other, 50.0) || same_removing_steps(other, plan, 50.0);
  };
  EXPECT_TRUE(changed([](ProgramStep& s) { s.start.x += 5e-7; }));
  EXPECT_TRUE(changed([](ProgramStep& s) { s.seconds *= 1.0 + 5e-7; }));
  EXPECT_FALSE(changed([](ProgramStep& s) { s.start.x += 2e-6; }));
  EXPECT_FALSE(changed([](ProgramStep& s) { s.finish.y -= 2e-6; }));
  EXPECT_FALSE(changed([](ProgramStep& s) { s.seconds += 2e-6 * s.seconds + 1e-7; }));
  EXPECT_FALSE(changed([](ProgramStep& s) { s.removes = false; }));
  EXPECT_FALSE(changed([](ProgramStep& s) { s.seconds = kNaN; }));
  EXPECT_FALSE(changed([](ProgramStep& s) { s.finish.x = kNaN; }));
  Program longer = plan;
  longer.steps.push_back(plan.steps[1]);
  EXPECT_FALSE(same_removing_steps(plan, longer, 50.0));
  longer.steps.back().removes = false;
  EXPECT_TRUE(same_removing_steps(plan, longer, 50.0));
}

TEST(ProgramOf, RefusesWhatCannotBeRun) {
  const ToolPath path{"file", {{0, 0}, {1, 0}}, {1, 0}};
  const auto message = [&path](std::vector<double> dwell, double max_feed) {
    return input_error([&] { program_of(path, dwell, Motion::Moving, max_feed); });
  };
  expect_contains(message({1.0, 0.05}, 10.0), "dwell of point 2 = 0.05 s; its stroke of 1 mm takes at least 0.1 s");
  expect_contains(message({1.0, 0.0}, 10.0), "dwell of point 2 = 0 s");
  expect_contains(message({kNaN, 1.0}, 10.0), "dwell of point 1 = nan s; required finite and >= 0");
  expect_contains(message({-1.0, 1.0}, 10.0), "dwell of point 1 = -1 s");
  expect_contains(message({1.0, std::numeric_limits<double>::infinity()}, 10.0), "dwell of point 2 = inf s");
  expect_contains(message({1.0}, 10.0), "2 points but 1 dwell");
  expect_contains(message({1.0, 1.0}, 0.0), "maximum feed = 0 mm/s; required finite and > 0");
  expect_contains(message({1.0, 1.0}, kNaN), "maximum feed = nan");
}

TEST(Motion, ParsesItsWords) {
  EXPECT_EQ(parse_motion("moving"), Motion::Moving);
  EXPECT_EQ(parse_motion("stop"), Motion::Stop);
  EXPECT_EQ(to_string(Motion::Moving), "moving");
  EXPECT_EQ(to_string(Motion::Stop), "stop");
  EXPECT_EQ(input_error([] { parse_motion("fast"); }), "motion = \"fast\"; accepted: moving, stop");
}

}  // namespace
}  // namespace dwell
