// Feeds that are linear over the path, against integrals of the speed over the path and steps of time.

#include "paths/feed/path_linear.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/errors.h"
#include "core/motion/cubic_move.h"
#include "paths/feed/cubic_check.h"
#include "paths/feed/exported_motion.h"

namespace dwell {
namespace {

/// The time of a length by the midpoint rule.
double quadrature_seconds(double length, double in, double out) {
  constexpr int kParts = 20000;
  double seconds = 0.0;
  for (int k = 0; k < kParts; ++k) {
    const double s = length * (k + 0.5) / kParts;
    seconds += length / kParts / (in + (out - in) * s / length);
  }
  return seconds;
}

/// The same of an even block with one end at rest, at the speed that the acceleration allows, by lengths from that end
/// on whose roots are equally far apart.
double stepped_seconds(const EndFeedBlock& block, double acceleration) {
  constexpr int kParts = 400000;
  const double feed = std::max(block.speed_in, block.speed_out), length = block.length();
  double seconds = 0.0;
  for (int k = 0; k < kParts; ++k) {
    const double x = (k + 0.5) / kParts, s = length * x * x;
    seconds += 2.0 * length * x / kParts / std::min(feed, std::sqrt(2.0 * acceleration * s));
  }
  return seconds;
}

EndFeedBlock block_of(Point start, Point finish, double in, double out) {
  EndFeedBlock block{start, finish};
  block.speed_in = in;
  block.speed_out = out;
  return block;
}

Machine quick_machine(double acceleration = 500.0) {
  Machine machine;
  machine.x.max_acceleration = 0.8 * acceleration;
  machine.y.max_acceleration = acceleration;
  machine.path_acceleration = 1.1 * acceleration;
  return machine;
}

TEST(PathLinear, TakesTheIntegralOfOneOverTheSpeed) {
  for (const auto& [in, out] : {std::pair(1.0, 3.0), {7.0, 0.5}, {2.0, 2.0}, {2.0, 2.0001}, {2.0, 2.001}})
    EXPECT_NEAR(path_linear_seconds(1.3, in, out), quadrature_seconds(1.3, in, out), 2e-8) << in << out;
}

/// Steps of time along ds/dt = v(s), by Runge and Kutta's rule.
TEST(PathLinear, StepsLieOnTheExponential) {
  const Point start{-1.0, 2.0}, finish{1.1, 0.5};
  for (const auto& [in, out] : {std::pair(2.0, 31.0), {12.0, 4.0}, {5.0, 5.2}, {0.05, 9.0}}) {
    const EndFeedBlock block = block_of(start, finish, in, out);
    const double length = block.length(), gain = (out - in) / length;
    const Point along = (1.0 / length) * (finish - start);
    const std::vector<ProgramStep> steps = steps_over_path(block, 0.0);
    EXPECT_LT(steps.size(), 120U);
    double s = 0.0, most = 0.0;
    for (const ProgramStep& step : steps) {
      const CubicMove move{step.start, step.finish, step.speeds->in, step.speeds->out, step.seconds};
      constexpr int kParts = 40;
      const double h = step.seconds / kParts;
      for (int k = 0; k < kParts; ++k) {
        const auto v = [&](double at) { return in + gain * at; };
        const double a = v(s), b = v(s + 0.5 * h * a), c = v(s + 0.5 * h * b), d = v(s + h * c);
        s += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
        most = std::max(most, distance(move.place((k + 1) * h), start + s * along));
        EXPECT_NEAR(dwell::length(move.speed((k + 1) * h)), v(s), 2e-3 * v(s));
      }
    }
    EXPECT_LE(most, 1e-6) << in << " " << out;
    EXPECT_NEAR(s, length, 1e-7);
    EXPECT_EQ(steps.back().finish, finish);
    for (std::size_t k = 1; k < steps.size(); ++k) {
      EXPECT_EQ(steps[k].start, steps[k - 1].finish);
      EXPECT_EQ(steps[k].speeds->in, steps[k - 1].speeds->out);
    }
  }
}

TEST(PathLinear, KeepsTheTimeOfEveryBlockWithinTheAcceleration) {
  const Machine machine = quick_machine();
  struct RampCase {
    double in, out, share;  // of the acceleration that the block of constant acceleration has
  };
  for (const RampCase& c :
       {RampCase{4.0, 9.0, 0.6}, RampCase{9.0, 4.0, 0.6}, RampCase{20.0, 20.1, 0.01}, RampCase{1.0, 25.0, 0.6},
        RampCase{0.0, 15.0, 0.74}, RampCase{22.0, 0.0, 0.74}, RampCase{0.0, 3.0, 0.1}, RampCase{5.0, 0.0, 0.5}}) {
    const Point along{0.6, -0.8};
    const double a = acceleration_limit(machine, along);
    const double length = std::abs(c.out * c.out - c.in * c.in) / (2.0 * c.share * a);
    const EndFeedBlock block = block_of({3.0, -1.0}, Point{3.0, -1.0} + length * along, c.in, c.out);
    const std::vector<EndFeedBlock> made = blocks_over_path({block}, machine, 1e-4);
    double seconds = 0.0, travelled = 0.0;
    for (const EndFeedBlock& one : made) {
      if (one.even) {
        EXPECT_TRUE(has_room(one, a));
        seconds += stepped_seconds(one, a);
        EXPECT_TRUE(one.speed_in == 0.0 || one.speed_out == 0.0);
      } else {
        seconds += quadrature_seconds(one.length(), one.speed_in, one.speed_out);
        EXPECT_LE(std::max(one.speed_in, one.speed_out) * std::abs(one.speed_out - one.speed_in) / one.length(), a);
      }
      travelled += one.length();
    }
    const double expected = 2.0 * length / (c.in + c.out);
    EXPECT_NEAR(seconds, expected, 4e-5 * expected + 1e-8) << c.in << " " << c.out;
    EXPECT_NEAR(travelled, length, 1e-9);
    EXPECT_EQ(made.front().speed_in, c.in);
    EXPECT_EQ(made.back().speed_out, c.out);
    EXPECT_EQ(made.back().finish, block.finish);
    const Program motion = motion_over_path(made, machine);
    EXPECT_NEAR(motion.total_seconds(), seconds, 1e-5 * seconds);
    Machine tight = machine;  // the first and last speeds are no jumps here
    for (const std::string& fault : cubics_beyond_machine(motion, tight))
      EXPECT_NE(fault.find("a jump"), std::string::npos) << fault;
  }
}

TEST(PathLinear, RunsBothEndsOfRestAtTheMachinesAcceleration) {
  EndFeedBlock block = block_of({0.0, 0.0}, {0.0, 2.0}, 0.0, 10.0);
  block.even = true;
  std::vector<ProgramStep> steps = steps_over_path(block, 200.0);
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_NEAR(steps[0].length(), 0.25, 1e-12);
  EXPECT_NEAR(steps[0].seconds + steps[1].seconds, 2.0 / 10.0 + 10.0 / (2.0 * 200.0), 1e-12);
  EXPECT_NEAR(steps[0].seconds + steps[1].seconds, stepped_seconds(block, 200.0), 1e-4);
  std::swap(block.speed_in, block.speed_out);
  steps = steps_over_path(block, 200.0);
  EXPECT_NEAR(steps[1].length(), 0.25, 1e-12);
  EXPECT_EQ(steps[1].speeds->out, (Point{}));
  EXPECT_FALSE(has_room(block, 24.9));
}

TEST(EndFeedBlocks, TakeASpeedNearRestAsRest) {
  // From 0.34 mm/s to 0.96 um/s: what is dropped is 3e-6 of the speeds together.
  const double out = 9.6e-7, seconds = 2.0 * 0.5 / (0.34 + out);
  const Program motion{"",
                       {{{0.0, 0.0}, {0.5, 0.0}, 2.0 * 0.5 / 0.34, true, EndSpeeds{{}, {0.34, 0.0}}},
                        {{0.5, 0.0}, {1.0, 0.0}, seconds, true, EndSpeeds{{0.34, 0.0}, {out, 0.0}}},
                        {{1.0, 0.0}, {1.0, 0.0}, 0.1, true}}};
  const std::vector<EndFeedBlock> blocks = blocks_of_motion(motion);
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[1].speed_in, 0.34);
  EXPECT_EQ(blocks[1].speed_out, 0.0);
}

TEST(EndFeedBlocks, RefuseWhatNoFeedAtTheEndSays) {
  const auto refusal = [](const ProgramStep& step) -> std::string {
    try {
      blocks_of_motion(Program{"", {step}});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto expect_says = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  EXPECT_EQ(refusal({{1.0, 1.0}, {1.0, 1.0}, 0.5, true}), "");
  expect_says(refusal({{0.0, 0.0}, {1.0, 0.0}, 1.0, true}), "step 1 of the motion says no speeds");
  expect_says(refusal({{0.0, 0.0}, {1.0, 0.0}, 1.0, true, EndSpeeds{{0.0, 0.0}, {2.0, 0.1}}}), "is bent");
  expect_says(refusal({{0.0, 0.0}, {1.0, 0.0}, 1.0, true, EndSpeeds{{0.0, 0.0}, {1.5, 0.0}}}),
              "no constant acceleration");
  expect_says(refusal({{0.0, 0.0}, {1.0, 0.0}, 1.0, true, EndSpeeds{{0.0, 0.0}, {2.0, 0.0}}}), "ends at a speed");
}

}  // namespace
}  // namespace dwell
