#include "runs/machine/machine_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/errors.h"

namespace dwell {
namespace {

/// A machine none of whose fields has its default, no two the same value.
NamedMachine unusual() {
  NamedMachine named{"a \"shop\" with ä", {}};
  Machine& m = named.machine;
  double next = 1.0;
  for (const MachineField& field : machine_fields()) field.value(m) = (next += 1.75) * field.scale;
  m.min_feed = 0.01;
  m.controller = {50.0, 0.015, 0.25};
  m.letters = {'V', 'B'};
  m.corner = CornerRule::JunctionDeviation;
  m.blend_size = BlendSize::AsNeeded;
  return named;
}

TEST(MachineFile, ReadsBackWhatItWrites) {
  for (const NamedMachine& machine : {unusual(), example_machine(), NamedMachine{}}) {
    const NamedMachine read = parse_machine(machine_text(machine), "m.toml");
    EXPECT_EQ(read.name, machine.name);
    EXPECT_EQ(read.machine.corner, machine.machine.corner);
    EXPECT_EQ(read.machine.letters, machine.machine.letters);
    EXPECT_EQ(read.machine.blend_size, machine.machine.blend_size);
    Machine a = read.machine, b = machine.machine;
    for (const MachineField& field : machine_fields()) {
      EXPECT_DOUBLE_EQ(field.value(a), field.value(b)) << field.section << '.' << field.key;
    }
  }
}

TEST(MachineFile, ConvertsFeedsFromMinutes) {
  const NamedMachine read = parse_machine(
      "schema = 1\nmax_feed_mm_per_min = 3000\n[x]\nmax_speed_mm_per_s = 40\n[corner]\nrule = \"free\"\ndelay_s = "
      "0.25\n",
      "m.toml");
  EXPECT_DOUBLE_EQ(read.machine.max_feed, 50.0);
  EXPECT_EQ(read.machine.x.max_speed, 40.0);
  EXPECT_TRUE(std::isinf(read.machine.y.max_speed));
  EXPECT_EQ(read.machine.corner, CornerRule::Free);
  EXPECT_EQ(read.machine.corner_delay, 0.25);
}

TEST(MachineFile, TakesAMachineThatBlends) {
  const NamedMachine read = parse_machine(
      "[corner]\nrule = \"blend\"\narcs = \"as-needed\"\ntolerance_mm = 0.03\nacross_share = 0.8\nalong_share = 0.5\n",
      "m.toml");
  EXPECT_EQ(read.machine.corner, CornerRule::Blend);
  EXPECT_EQ(read.machine.blend_size, BlendSize::AsNeeded);
  EXPECT_EQ(read.machine.blend_tolerance, 0.03);
  EXPECT_EQ(read.machine.across_share, 0.8);
  EXPECT_EQ(read.machine.along_share, 0.5);
}

std::string refusal(const std::string& text) {
  try {
    parse_machine(text, "m.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MachineFile, RefusesByFileLineFieldAndValue) {
  EXPECT_EQ(refusal("max_feed = 3000\n").substr(0, 60), "m.toml: line 1: max_feed: unknown field; accepted: name, sch");
  EXPECT_EQ(refusal("[x]\n\nmax_jerk = 3\n").substr(0, 60),
            "m.toml: line 3: x.max_jerk: unknown field; accepted in [x]: ");
  EXPECT_EQ(refusal("[spindle]\nspeed = 3\n"),
            "m.toml: unknown section [spindle]; accepted: corner, lift, controller, x, y");
  EXPECT_EQ(refusal("path_acceleration_mm_per_s2 = \"500\"\n"),
            "m.toml: line 1: path_acceleration_mm_per_s2 = '500'; required a finite number > 0 (without quotes)");
  EXPECT_EQ(refusal("max_feed_mm_per_min = -2\n"),
            "m.toml: line 1: max_feed_mm_per_min = -2; required a finite number > 0 (without quotes)");
  EXPECT_EQ(refusal("[corner]\ndelay_s = nan\n"),
            "m.toml: line 2: corner.delay_s = nan; required a finite number >= 0 (without quotes)");
  EXPECT_EQ(
      refusal("[corner]\nrule = \"round\"\n"),
      "m.toml: line 2: corner.rule = 'round'; accepted: \"exact-stop\", \"junction-deviation\", \"free\", \"blend\"");
  EXPECT_EQ(refusal("[corner]\narcs = 3\n"), "m.toml: line 2: corner.arcs = 3; accepted: \"largest\", \"as-needed\"");
  EXPECT_EQ(refusal("[corner]\nacross_share = 0\n"),
            "m.toml: line 2: corner.across_share = 0; required a finite number > 0 (without quotes)");
  EXPECT_EQ(refusal("schema = 2\n").substr(0, 41), "m.toml: line 1: schema = 2; accepted: 1 (");
  EXPECT_EQ(refusal("name = 3\n"), "m.toml: line 1: name = 3; required a string (in quotes)");
  EXPECT_EQ(refusal("[x]\nlowest_mm = 4\nhighest_mm = 2\n"),
            "m.toml: machine: x.travel: lowest 4 mm and highest 2 mm; required lowest < highest");
  EXPECT_EQ(refusal("[lift]\nsettle_s = -1\n"),
            "m.toml: line 2: lift.settle_s = -1; required a finite number >= 0 (without quotes)");
  EXPECT_EQ(refusal("[y]\nletter = \"Z\"\n"), "m.toml: line 2: y.letter = 'Z'; accepted: one of XYUVWABC (in quotes)");
  EXPECT_EQ(refusal("[y]\nletter = \"X\"\n"), "m.toml: machine: x.letter = X and y.letter = X; required two letters");
  EXPECT_EQ(
      refusal("[controller]\nmax_blocks_per_s = 100\ntime_resolution_s = 0.02\n"),
      "m.toml: machine: controller.time_resolution = 0.02 s and controller.max_blocks_per_s = 100 1/s; required at "
      "least one step of its clock a block, time_resolution <= 0.01 s");
  EXPECT_EQ(
      refusal("[controller]\nposition_resolution_mm = 3\n[x]\nlowest_mm = -1\nhighest_mm = 1\n"),
      "m.toml: machine: controller.position_resolution = 3 mm and x.travel from -1 to 1 mm; required less than the "
      "travel");
  EXPECT_EQ(refusal("x = 3\n").substr(0, 34), "m.toml: line 1: x: unknown field; ");
  EXPECT_NE(refusal("max_feed_mm_per_min = \n"), "");
}

}  // namespace
}  // namespace dwell
