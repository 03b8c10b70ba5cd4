/// What keeps a machine from being faster, in motions whose answer is known.

#include "paths/feed/binding_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/program.h"
#include "paths/feed/execution.h"

namespace dwell {
namespace {

Machine limited_machine() {
  Machine machine;
  machine.x.max_speed = 5.0;
  machine.y.max_speed = 2.0;
  machine.path_acceleration = 10.0;
  machine.corner_delay = 0.25;
  return machine;
}

double seconds_of(BindingLimit limit, const std::vector<MotionNode>& nodes, const std::vector<BindingLimit>& limits) {
  return time_at_limits(nodes, limits)[static_cast<std::size_t>(limit)];
}

TEST(BindingLimits, AreThoseOfATrapezoidByHand) {
  // Along x at 4 of 5 mm/s, a corner, along y as fast as y can, a halt, along x at a crawl.
  Program program;
  program.steps = {{{0.0, 0.0}, {8.0, 0.0}, 2.0, true},
                   {{8.0, 0.0}, {8.0, 6.0}, 1.0, true},
                   {{8.0, 6.0}, {8.0, 6.0}, 0.7, true},
                   {{8.0, 6.0}, {9.0, 6.0}, 4.0, true}};
  const Machine machine = limited_machine();
  const std::vector<MotionNode> nodes = motion_nodes(program, machine);
  const std::vector<BindingLimit> limits = binding_limits(nodes, machine, 50.0);
  ASSERT_EQ(limits.size() + 1, nodes.size());
  EXPECT_NEAR(seconds_of(BindingLimit::Acceleration, nodes, limits), 2.0 * (0.4 + 0.2 + 0.025), 1e-12);
  EXPECT_NEAR(seconds_of(BindingLimit::Speed, nodes, limits), (6.0 - 0.4) / 2.0, 1e-12);
  EXPECT_NEAR(seconds_of(BindingLimit::Rest, nodes, limits), 0.25, 1e-12);
  EXPECT_NEAR(seconds_of(BindingLimit::None, nodes, limits), (8.0 - 1.6) / 4.0 + 0.7 + (1.0 - 0.00625) / 0.25, 1e-12);
}

TEST(BindingLimits, CountTheFastestFeedOfTheProgramAndNoLiftedMove) {
  Program program;
  program.steps = {{{0.0, 0.0}, {8.0, 0.0}, 2.0, true},
                   {{8.0, 0.0}, {20.0, 0.0}, 0.0, false},
                   {{20.0, 0.0}, {21.0, 0.0}, 1.0, true}};
  program.fastest_feed = 4.0;
  const Machine machine = limited_machine();
  const std::vector<MotionNode> nodes = motion_nodes(program, machine);
  const std::vector<BindingLimit> limits = binding_limits(nodes, machine, 4.0);
  EXPECT_NEAR(seconds_of(BindingLimit::Speed, nodes, limits), (8.0 - 1.6) / 4.0, 1e-12);
  double work = 0.0;
  for (const double seconds : time_at_limits(nodes, limits)) work += seconds;
  EXPECT_NEAR(work, 2.0 + 0.4 + 1.0 + 0.1, 1e-12);
}

}  // namespace
}  // namespace dwell
