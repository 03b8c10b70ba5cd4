#include "paths/feed/step_times.h"

#include <gtest/gtest.h>

#include "paths/feed/execution.h"
#include "tests/paths/feed/motion_oracle.h"

namespace dwell {
namespace {

TEST(StepTimes, AreThoseOfTheExecution) {
  for (const CornerRule rule :
       {CornerRule::ExactStop, CornerRule::JunctionDeviation, CornerRule::Free, CornerRule::Blend}) {
    Program program{"", test::crooked_chain(3, 60, 0.5, 12.0)};
    const Point at = program.steps[20].finish;
    program.steps.insert(program.steps.begin() + 21, {at, at, 0.125, true});
    program.steps[40].removes = program.steps[50].removes = false;
    program.steps[50].seconds = 0.0;
    program.fastest_feed = 7.0;
    Machine machine;
    machine.x.max_acceleration = 20.0;
    machine.path_acceleration = 70.0;
    machine.corner = rule;
    machine.corner_delay = 0.01;
    const std::vector<double> expected = execute(program, machine).seconds, found = step_times(program, machine);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12 + 1e-9 * expected[i]) << i;
    program.steps[3].speeds = EndSpeeds{};
    EXPECT_EQ(step_times(program, machine), execute(program, machine).seconds);
  }
}

}  // namespace
}  // namespace dwell
