#include "runs/tools/tool_choice.h"

#include <gtest/gtest.h>

#include "tests/runs/tools/two_tools.h"

namespace dwell {
namespace {

using test::two_tools;

ToolChoice choose(std::vector<JointTool> tools) {
  JointProblem problem(std::move(tools));
  return choose_tools(problem, 1e-3, {}, 100.0);
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
  EXPECT_EQ(choice.price, 1e-3);
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
  const ToolChoice choice = choose_tools(problem, {}, {}, 100.0);
  ASSERT_TRUE(choice.worth);
  EXPECT_GT(choice.price, 0.0);
}

}  // namespace
}  // namespace dwell
