#include "paths/feed/machine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/errors.h"
#include "paths/feed/machine_check.h"

namespace dwell {
namespace {

TEST(Machine, HasNoLimitsUnlessTheyAreGiven) {
  EXPECT_NO_THROW(validate(Machine{}));
  EXPECT_TRUE(std::isinf(speed_limit(Machine{}, {1.0, 2.0})));
  EXPECT_TRUE(std::isinf(acceleration_limit(Machine{}, {0.0, -2.0})));
}

TEST(Machine, RefusesFieldsThatContradictEachOtherByBothNames) {
  const auto refusal = [](const auto& change) -> std::string {
    Machine machine;
    change(machine);
    try {
      validate(machine);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal([](Machine& m) { m.x.lowest = 5.0, m.x.highest = -5.0; }),
            "machine: x.travel: lowest 5 mm and highest -5 mm; required lowest < highest");
  EXPECT_EQ(refusal([](Machine& m) { m.min_feed = 9.0, m.y.max_speed = 4.0; }),
            "machine: min_feed = 9 mm/s and y.max_speed = 4 mm/s; required min_feed <= y.max_speed");
  EXPECT_EQ(refusal([](Machine& m) { m.path_acceleration = 0.0; }),
            "machine: path_acceleration = 0 mm/s^2; required > 0");
  EXPECT_EQ(refusal([](Machine& m) { m.corner_delay = NAN; }),
            "machine: corner_delay = nan s; required finite and >= 0");
  EXPECT_NE(refusal([](Machine& m) { m.y.max_acceleration = NAN; }), "");
}

TEST(Machine, SaysWhatAProgramAsksBeyondIt) {
  Machine machine;
  machine.x = {-10.0, 10.0, 5.0, 100.0};
  machine.y = {-2.0, 20.0, 4.0, 100.0};
  machine.min_feed = 0.1;
  Program program{"", {{{0, 0}, {3, 0}, 1.0, true}, {{3, 0}, {3, 8}, 2.0, true}}};
  EXPECT_TRUE(beyond_machine(program, machine).empty());
  program.steps.push_back({{3, 8}, {11, 8}, 1.0, true});     // 8 mm/s along x, and out
  program.steps.push_back({{11, 8}, {11, -3}, 0.0, false});  // out of both, lifted
  program.steps.push_back({{11, -3}, {11, -2.5}, 50.0, true});
  const std::vector<std::string> said = beyond_machine(program, machine);
  ASSERT_EQ(said.size(), 4U);
  EXPECT_EQ(said[0],
            "3 steps of the program leave the machine's travel of x from -10 to 10 mm: the first is step 3, at "
            "x = 11 mm");
  EXPECT_EQ(said[1],
            "2 steps of the program leave the machine's travel of y from -2 to 20 mm: the first is step 4, at "
            "y = -3 mm");
  EXPECT_EQ(said[2],
            "1 step of the program is faster than the machine: the first is step 3, at 480 mm/min where the "
            "limit is 300 mm/min");
  EXPECT_EQ(said[3],
            "1 step of the program is slower than the machine: the first is step 5, at 0.6 mm/min where the "
            "limit is 6 mm/min");
}

}  // namespace
}  // namespace dwell
