#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/errors.h"
#include "core/removal/simulate.h"
#include "core/tif/removal_function.h"
#include "paths/feed/execution.h"
#include "paths/feed/exported_motion.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/trapezoid_program.h"
#include "tests/paths/feed/blend_oracle.h"

namespace dwell {
namespace {

using test::BlendOracle;
using test::BlendOracleMachine;

/// Moves that end at these places, each at its feed.
std::vector<ProgramStep> moves_through(const std::vector<Point>& places, const std::vector<double>& feeds) {
  std::vector<ProgramStep> steps;
  for (std::size_t i = 1; i < places.size(); ++i)
    steps.push_back({places[i - 1], places[i], distance(places[i - 1], places[i]) / feeds[i - 1], true});
  return steps;
}

/// A place after another, by heading [degrees] and length.
Point onwards(Point from, double heading, double way) {
  const double angle = heading * std::numbers::pi / 180.0;
  return from + way * Point{std::cos(angle), std::sin(angle)};
}

struct Chain {
  const char* name;
  std::vector<double> headings, lengths, feeds;

  std::vector<ProgramStep> steps() const {
    std::vector<Point> places{{-1.3, 0.7}};
    for (std::size_t i = 0; i < headings.size(); ++i) places.push_back(onwards(places.back(), headings[i], lengths[i]));
    return moves_through(places, feeds);
  }
};

const std::vector<Chain>& chains() {
  static const std::vector<Chain> kChains{
      {"right", {20.0, 110.0}, {2.1, 1.4}, {6.0, 6.0}},
      {"obtuse, to the right", {20.0, -17.0}, {1.2, 2.3}, {9.0, 9.0}},
      {"acute", {-50.0, 95.0}, {1.7, 1.1}, {7.0, 7.0}},
      {"slower after", {10.0, 95.0}, {1.5, 1.6}, {9.0, 3.0}},
      {"faster after", {10.0, 95.0}, {1.5, 1.6}, {3.0, 9.0}},
      {"short lines", {0.0, 80.0, 30.0, -70.0}, {0.9, 0.07, 0.05, 0.8}, {6.0, 5.0, 7.0, 6.0}},
      {"three in a row", {0.0, 90.0, -20.0, -120.0}, {0.8, 0.5, 0.6, 0.9}, {5.0, 8.0, 6.0, 9.0}},
  };
  return kChains;
}

struct Setting {
  BlendSize size;
  double tolerance, across, along;
};

class Blended : public testing::TestWithParam<Setting> {
 protected:
  static constexpr double kAcceleration = 120.0;

  Machine machine() const {
    Machine m;
    m.path_acceleration = kAcceleration;
    m.max_feed = 40.0;
    m.corner = CornerRule::Blend;
    m.blend_size = GetParam().size;
    m.blend_tolerance = GetParam().tolerance;
    m.across_share = GetParam().across;
    m.along_share = GetParam().along;
    return m;
  }
  BlendOracle oracle(const std::vector<ProgramStep>& steps) const {
    const Setting& s = GetParam();
    return {steps, {s.tolerance, kAcceleration, s.across, s.along, s.size == BlendSize::AsNeeded}};
  }
};

/// Where a motion is after a time.
Point place_of(const std::vector<MotionNode>& nodes, double seconds, std::size_t& at) {
  while (at + 2 < nodes.size() && nodes[at + 1].seconds < seconds) ++at;
  const MotionNode &a = nodes[at], &b = nodes[at + 1];
  const double t = seconds - a.seconds, whole = b.seconds - a.seconds, way = distance(a.place, b.place);
  if (!(whole > 0.0) || !(way > 0.0)) return b.place;
  const double travelled = a.speed * t + 0.5 * (b.speed - a.speed) * t * t / whole;
  return a.place + std::min(1.0, travelled / way) * (b.place - a.place);
}

TEST_P(Blended, ChainsTakeThePlacesAndTimesOfSmallSteps) {
  for (const Chain& chain : chains()) {
    const Program program{"", chain.steps()};
    const BlendOracle slow = oracle(program.steps);
    const Execution run = execute(program, machine());
    EXPECT_NEAR(run.motion.total_seconds(), slow.total(), 6e-4) << chain.name;
    double passed = 0.0;
    for (std::size_t i = 0; i < program.steps.size(); ++i) {
      passed += run.seconds[i];
      EXPECT_NEAR(passed, slow.passes(i), 6e-4) << chain.name << ", end of step " << i;
    }
    const std::vector<MotionNode> nodes = motion_nodes(program, machine());
    double off = 0.0, cut = 0.0;
    std::size_t at = 0;
    for (std::size_t k = 0; k < slow.track().size(); ++k) {
      const double seconds = BlendOracle::kStep * static_cast<double>(k);
      if (seconds >= nodes.back().seconds) break;
      const Point place = place_of(nodes, seconds, at);
      off = std::max(off, distance(place, slow.track()[k]));
      double beside = 1e9;
      for (const ProgramStep& step : program.steps) {
        const Point along = step.finish - step.start;
        const double share = std::clamp(dot(place - step.start, along) / dot(along, along), 0.0, 1.0);
        beside = std::min(beside, distance(place, step.start + share * along));
      }
      cut = std::max(cut, beside);
    }
    EXPECT_LE(off, 4e-3) << chain.name;  // 0.1 ms at up to 9 mm/s are 1e-3 mm
    EXPECT_LE(cut, GetParam().tolerance * (1.0 + 1e-6)) << chain.name;
    EXPECT_GT(cut, 0.02 * GetParam().tolerance) << chain.name;  // or nothing would be blended
  }
}

// To the places themselves, whenever it is there: those of the oracle lie on lines and arcs to rounding.
TEST_P(Blended, MotionIsOnTheWayWithinATenthOfAMicrometre) {
  for (const Chain& chain : chains()) {
    const Program program{"", chain.steps()};
    const BlendOracle slow = oracle(program.steps);
    const Execution run = execute(program, machine());
    EXPECT_EQ(run.motion.steps.front().start, program.steps.front().start);
    EXPECT_NEAR(distance(run.motion.steps.back().finish, program.steps.back().finish), 0.0, 1e-9);
    double seconds = 0.0;
    for (std::size_t k = 0; k < run.motion.steps.size(); ++k) {
      const ProgramStep& step = run.motion.steps[k];
      if (k > 0) {
        EXPECT_EQ(step.start, run.motion.steps[k - 1].finish);
      }
      seconds += step.seconds;
      double beside = 1e9;
      for (std::size_t j = 1; j < slow.track().size(); ++j) {
        const Point a = slow.track()[j - 1], along = slow.track()[j] - a;
        const double whole = dot(along, along);
        const double share = whole > 0.0 ? std::clamp(dot(step.finish - a, along) / whole, 0.0, 1.0) : 0.0;
        beside = std::min(beside, distance(step.finish, a + share * along));
      }
      EXPECT_LE(beside, 1e-4) << chain.name << " after " << seconds << " s";
    }
  }
}

TEST_P(Blended, RemovesWhatSmallStepsRemove) {
  const Program program{"", chains()[6].steps()};
  const BlendOracle slow = oracle(program.steps);
  const Execution run = execute(program, machine());
  const RemovalFunction tool = gaussian_removal(1.0, 0.5, 1.3);
  HeightMap map(Grid{26, 22, 0.15, 0.12, {-2.2, -0.6}});
  for (double& z : map.values) z = 0.0;
  const RemovalKernel kernel = removal_kernel(tool, map.grid.pitch_x, map.grid.pitch_y);
  const HeightMap removal = simulate(run.motion, map, kernel, 1);
  Program sharp = program;
  sharp.path_modes = {{0, {PathMode::Kind::ExactPath, {}, {}}}};
  const HeightMap stopped = simulate(execute(sharp, machine()).motion, map, kernel, 1);
  double most = 0.0, off = 0.0, naive = 0.0;
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const Point centre = map.grid.centre(static_cast<Index>(i));
    double expected = 0.0;
    for (std::size_t k = 1; k < slow.track().size(); ++k) {
      const Point d = midpoint(slow.track()[k - 1], slow.track()[k]) - centre;
      if (dot(d, d) < tool.radius * tool.radius)
        expected += BlendOracle::kStep * std::exp(-0.5 * dot(d, d) / (tool.sigma * tool.sigma));
    }
    most = std::max(most, expected);
    off = std::max(off, std::abs(removal.values[i] - expected));
    naive = std::max(naive, std::abs(stopped.values[i] - expected));
  }
  EXPECT_LE(off, 3e-3 * most);
  EXPECT_GE(naive, 0.03 * most);  // with stops at the corners it would be far off
}

INSTANTIATE_TEST_SUITE_P(Machines, Blended,
                         testing::Values(Setting{BlendSize::Largest, 0.01, 1.0, 1.0},
                                         Setting{BlendSize::Largest, 0.05, 0.7, 0.6},
                                         Setting{BlendSize::AsNeeded, 0.01, 0.866, 0.5},
                                         Setting{BlendSize::AsNeeded, 0.2, 0.866, 0.5}));

Machine blending_machine() {
  Machine machine;
  machine.path_acceleration = 80.0;
  machine.max_feed = 50.0;
  machine.corner = CornerRule::Blend;
  machine.blend_tolerance = 0.03;
  return machine;
}

// Arcs as paths have them, chords that turn by up to 24 degrees, are taken at the speed that the arc through the
// middles of the chords allows: at v = sqrt(a R), not chord by chord.
TEST(BlendedPath, TakesChordsOfAnArcAtTheSpeedOfTheArc) {
  Machine machine = blending_machine();
  machine.blend_tolerance = 0.5;
  const double radius = 1.5, turn = 15.0 * std::numbers::pi / 180.0;
  std::vector<Point> places;
  for (int k = 0; k <= 24; ++k)
    places.push_back(
        {radius / std::cos(0.5 * turn) * std::cos(k * turn), radius / std::cos(0.5 * turn) * std::sin(k * turn)});
  const std::vector<double> feeds(24, 30.0);
  const Program program{"", moves_through(places, feeds)};
  const Execution run = execute(program, machine);
  const double speed = std::sqrt(80.0 * radius);
  EXPECT_NEAR(run.max_speed, speed, 1e-6 * speed);
  for (std::size_t i = 4; i + 4 < program.steps.size(); ++i)
    EXPECT_NEAR(run.seconds[i], radius * turn / speed, 1e-9) << i;
  for (const ProgramStep& step : run.motion.steps) {
    if (distance(step.finish, places.front()) > 1.0 && distance(step.finish, places.back()) > 1.0) {
      EXPECT_NEAR(length(step.finish), radius, 1e-4);
    }
  }
}

TEST(BlendedPath, StopsWhereThePathTurnsBack) {
  Machine machine = blending_machine();
  machine.corner_delay = 0.02;
  const Program back{"", moves_through({{0, 0}, {3, 0}, {1, 0}}, {5.0, 5.0})};
  const KinematicPath path = kinematic_path(back, machine);
  EXPECT_EQ(path.corner[1], 0.0);
  EXPECT_NE(path.stops[1], 0);
  machine.corner = CornerRule::ExactStop;
  const double stopped = execute(back, machine).motion.total_seconds();
  machine.corner = CornerRule::Blend;
  EXPECT_NEAR(execute(back, machine).motion.total_seconds(), stopped, 1e-12);
  const Program nearly{"", moves_through({{0, 0}, {3, 0}, {1, 0.3}}, {5.0, 5.0})};
  EXPECT_GT(kinematic_path(nearly, machine).corner[1], 0.0);
}

TEST(BlendedPath, WithoutALimitOfAccelerationNeedsNoArc) {
  Machine machine = blending_machine();
  machine.path_acceleration = INFINITY;
  machine.blend_size = BlendSize::AsNeeded;
  const Program program{"", chains()[6].steps()};
  EXPECT_NEAR(execute(program, machine).motion.total_seconds(), program.total_seconds(), 1e-12);
  machine.blend_size = BlendSize::Largest;  // shorter, at the same feeds
  const Execution run = execute(program, machine);
  EXPECT_LT(run.motion.total_seconds(), program.total_seconds() - 1e-3);
  EXPECT_LT(run.motion.removing_length(), program.removing_length() - 0.01);
}

std::string refusal(const Program& program, const Machine& machine) {
  try {
    kinematic_path(program, machine);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(BlendedPath, TakesTheToleranceOfTheProgramBeforeTheMachines) {
  Machine machine = blending_machine();
  Program program{"p.nc", chains()[6].steps()};
  const double own = execute(program, machine).motion.removing_length();
  program.path_modes = {{0, {PathMode::Kind::Blended, 0.1, {}}}};
  const double said = execute(program, machine).motion.removing_length();
  EXPECT_LT(said, own - 0.01);
  machine.corner = CornerRule::ExactStop;  // the program blends all the same
  EXPECT_NEAR(execute(program, machine).motion.removing_length(), said, 1e-12);
  program.path_modes = {{0, {PathMode::Kind::Blended, 0.1, 0.0}}};  // Q0: no moves are merged
  EXPECT_NEAR(execute(program, machine).motion.removing_length(), said, 1e-12);
  program.path_modes = {{0, {PathMode::Kind::Blended, 0.1, 0.02}}};
  EXPECT_NE(refusal(program, machine)
                .find("p.nc: from step 1 on the controller may put one move in the place of several "
                      "that lie within 0.02 mm of it (G64 Q)"),
            std::string::npos);
  for (const std::optional<double> none : {std::optional<double>{}, std::optional<double>{0.0}}) {
    program.path_modes = {{2, {PathMode::Kind::Blended, none, {}}}};
    machine.corner = CornerRule::Free;
    EXPECT_NE(refusal(program, machine)
                  .find("p.nc: from step 3 on the controller rounds corners as far as it likes "
                        "(G64 without P)"),
              std::string::npos);
    machine.corner = CornerRule::Blend;
    EXPECT_EQ(refusal(program, machine), "");
  }
  program.path_modes = {{0, {PathMode::Kind::ExactPath, {}, {}}}};
  EXPECT_TRUE(kinematic_path(program, machine).arcs.empty());
}

TEST(BlendedPath, IsNoTableOfPositionsVelocitiesAndTimes) {
  const Machine machine = blending_machine();
  EXPECT_THROW(check_exported_motion(machine), InputError);
  EXPECT_THROW(check_exported_motion(machine, ScheduleKind::Pvt), InputError);
  EXPECT_THROW(trapezoid_program(Program{"", chains()[0].steps()}, machine), InputError);
}

}  // namespace
}  // namespace dwell
