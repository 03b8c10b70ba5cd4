#include "runs/tools/tool_choice.h"

#include <gtest/gtest.h>

#include "tests/core/base/expect_error.h"
#include "tests/runs/tools/two_tools.h"

namespace dwell {
namespace {

using test::two_tools;

ToolChoice choose(std::vector<JointTool> tools) {
  JointProblem problem(std::move(tools));
  return choose_tools(problem, {1e-3}, {}, 100.0);
}

TEST(ToolChoice, KeepsToolsOfWhichEachPays) {
  const ToolChoice choice = choose(two_tools(SolverKind::Auto));
  ASSERT_EQ(choice.tried.size(), 3u);
  EXPECT_EQ(choice.set().tools, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(choice.dwell.tools, choice.set().tools);
  for (const std::size_t alone : {1u, 2u}) {
    EXPECT_GT(choice.tried[alone].cost, choice.set().cost);
    EXPECT_EQ(choice.tried[alone].tools.size(), 1u);
  }
  EXPECT_FALSE(choice.worth);
  EXPECT_EQ(choice.set().price, 1e-3);
}

TEST(ToolChoice, GoesWithoutAToolWhoseChangeOverIsDearerThanItsWork) {
  std::vector<JointTool> tools = two_tools(SolverKind::Auto);
  tools[0].change_over = 20.0;
  tools[1].change_over = 1e6;
  const ToolChoice choice = choose(tools);
  EXPECT_EQ(choice.set().tools, (std::vector<std::size_t>{0}));
  EXPECT_EQ(choice.set().change_over, 20.0);
  EXPECT_EQ(choice.tried[0].change_over, 20.0 + 1e6);
  ASSERT_EQ(choice.dwell.seconds.size(), 1u);
  EXPECT_NEAR(choice.set().seconds, choice.dwell.seconds[0].sum(), 1e-9);
}

TEST(ToolChoice, TakesOneOfTwoEqualTools) {
  std::vector<JointTool> tools = two_tools(SolverKind::Auto);
  tools.push_back(tools[1]);
  tools[2].name = "small again";
  tools[2].change_over = 5.0;
  const ToolChoice choice = choose(tools);
  EXPECT_EQ(choice.set().tools, (std::vector<std::size_t>{0, 1}));
}

TEST(ToolChoice, FindsThePriceWhereNoneIsGiven) {
  JointProblem problem(two_tools(SolverKind::Auto));
  const ToolChoice choice = choose_tools(problem, {0.0, GoalKind::Auto}, {}, 100.0);
  ASSERT_TRUE(choice.worth);
  EXPECT_GT(choice.set().price, 0.0);
}

TEST(ToolChoice, KeepsATotalWithEachSet) {
  JointProblem problem(two_tools(SolverKind::Auto));
  const WeightGoal goal{60.0, GoalKind::TotalAtMost};
  const ToolChoice choice = choose_tools(problem, goal, {}, 100.0);
  ASSERT_EQ(choice.tried.size(), 3u);
  for (const TriedTools& tried : choice.tried) {
    EXPECT_LE(tried.seconds + tried.change_over, goal.value);
    EXPECT_GE(tried.seconds + tried.change_over, kUsedOfTotal * goal.value);
  }
  EXPECT_EQ(choice.set().tools.size(), 2u);
  EXPECT_LT(choice.set().residual_rms, choice.tried[1].residual_rms);
  EXPECT_LT(choice.set().residual_rms, choice.tried[2].residual_rms);
}

TEST(ToolChoice, LeavesOutWhatDoesNotFitIntoATotal) {
  std::vector<JointTool> tools = two_tools(SolverKind::Auto);
  tools[1].change_over = 100.0;
  JointProblem problem(tools);
  const ToolChoice choice = choose_tools(problem, {60.0, GoalKind::TotalAtMost}, {}, 100.0);
  EXPECT_EQ(choice.set().tools, (std::vector<std::size_t>{0}));
  EXPECT_EQ(choice.tried.size(), 1u);
  test::expect_input_error(
      [&] {
        choose_tools(problem, {0.01, GoalKind::TotalAtMost}, {}, 100.0);
      },
      {"total<=0.01 s", "no set of tools fits"});
}

}  // namespace
}  // namespace dwell
