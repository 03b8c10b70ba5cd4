#include "runs/programs/gcode_insert.h"

#include <gtest/gtest.h>

#include "runs/programs/gcode_reader.h"
#include "tests/runs/programs/program_cases.h"

namespace dwell {
namespace {

using program_cases::expect_contains;
using program_cases::input_error;
using program_cases::TestFile;

GcodeOptions usual_options() {
  GcodeOptions options;
  options.max_feed_mm_per_min = 3000.0;
  return options;
}

GcodeInsert insert_of(const std::string& text, const std::string& name = "start.nc") {
  const TestFile file(name, text);
  GcodeInsert insert = read_gcode_insert(file.path());
  insert.file = name;
  return insert;
}

/// What is said of lines before the program, or behind it.
std::string refusal(const std::string& text, bool after, bool keep_path_mode = false) {
  return input_error([&] {
    const GcodeInsert insert = insert_of(text);
    check_gcode_inserts(after ? GcodeInsert{} : insert, after ? insert : GcodeInsert{}, usual_options(),
                        keep_path_mode);
  });
}

TEST(GcodeInsert, TakesTheLinesOfMachineShops) {
  const GcodeInsert before = insert_of("(T1: PAD 6)\r\nG55\r\nT1 M6\r\nS1200 M3\r\n\r\nM8\r\nG0 Z50.\r\nG0 X0 Y0\r\n");
  EXPECT_EQ(before.lines.size(), 8u);
  EXPECT_EQ(before.lines[1], "G55");
  const GcodeInsert after = insert_of("G1 Z60 F600\nG0 X-80 Y-50\nM9\nM5", "end.nc");
  EXPECT_EQ(after.lines.size(), 4u);
  for (const GcodeDialect dialect : {GcodeDialect::G94, GcodeDialect::G93PerMinute, GcodeDialect::G93Seconds}) {
    for (const bool inches : {false, true}) {
      GcodeOptions options = usual_options();
      options.dialect = dialect;
      options.style.inches = inches;
      EXPECT_NO_THROW(check_gcode_inserts(before, after, options, true));
      Program program;
      program.steps = {{{1, 2}, {3, 5}, 2.0, true}};
      options.style.before = before.lines;
      options.style.after = after.lines;
      const std::string text = gcode_text(program, options);
      expect_contains(text, std::string("Z>0)\n(T1: PAD 6)\nG55\nT1 M6\nS1200 M3\n\nM8\nG0 Z50.\nG0 X0 Y0\n") +
                                std::string(inches ? "G20\n" : "") + "(units: X Y Z ");
      expect_contains(
          text, std::string(dialect == GcodeDialect::G94 ? "" : "G94\n") + "G1 Z60 F600\nG0 X-80 Y-50\nM9\nM5\nM2\n");
      EXPECT_TRUE(same_removing_steps(read_gcode(text, "p.nc", {}), program, 50.0));
    }
  }
  EXPECT_NO_THROW(check_gcode_inserts({}, {}, usual_options(), true));
}

TEST(GcodeInsert, RefusesLinesThatControllersDoNotTake) {
  const auto said = [](const std::string& text) { return input_error([&] { insert_of(text); }); };
  expect_contains(said("M8\n(" + std::string(79, 'x') + ")\n"), "start.nc, line 2: 81 characters, more than");
  expect_contains(said("M8\nM3\n(K\xC3\xBChlung)\n"), "line 3: \"[K\\xC3\\xBChlung]\" holds the byte C3h; required");
  expect_contains(said("M8\tM3\n"), "line 1: \"M8?M3\" holds the byte 09h");
  for (const char* end : {"M2", "m30", "G0 Z9 M30", "%"}) {
    expect_contains(said("M8\n" + std::string(end) + "\nM9\n"),
                    "line 2: \"" + std::string(end) + "\" ends the program, whose own end follows");
  }
  expect_contains(said("M8\nG1 X\n"), "line 2: \"X\" has no readable number");
  EXPECT_EQ(insert_of("(" + std::string(78, 'x') + ")").lines.size(), 1u);
}

TEST(GcodeInsert, RefusesWhatOurReaderRefusesByFileAndLine) {
  for (const bool after : {false, true}) {
    EXPECT_TRUE(refusal("M8\nG53 G0 Z0\n", after).starts_with("start.nc, line 2: \"G53\": machine coordinates"));
    EXPECT_TRUE(refusal("M8\nM9\nM98 P1\n", after).starts_with("start.nc, line 3: \"M98\""));
    EXPECT_TRUE(refusal("(all in inches)\n", after).starts_with("start.nc, line 1: \"inches\" in the comment"));
    EXPECT_TRUE(refusal("(Y AXIS DOWN)\n", after).starts_with("start.nc, line 1: the comment"));
  }
  expect_contains(refusal("G0 X5 Y5\nG1 X6 F60\n", false), "start.nc, line 2: G1 from an unknown position");
  EXPECT_EQ(input_error([] {
              check_gcode_inserts(insert_of("G55\n"), insert_of("M5\nG54\n", "end.nc"), usual_options(), false);
            }).substr(0, 28),
            "end.nc, line 2: G54 after mo");
}

TEST(GcodeInsert, RefusesWhatChangesTheWork) {
  const std::string otherwise = "start.nc: with its lines a program would remove otherwise than without";
  expect_contains(refusal("G0 Z1\nG0 X0 Y0\nG0 Z0\nG4 P3.\n", false), otherwise);
  expect_contains(refusal("(dwell: zero=1/0 rotate=0 swap=no)\n", false), otherwise);
  expect_contains(refusal("G0 Z0\nG1 X3 F60\nG0 Z5\n", true), otherwise);
  expect_contains(refusal("G0 Z0\n", true), "start.nc: leaves the tool at work (Z = 0); required lifted at the end");
}

TEST(GcodeInsert, RefusesAnotherPathModeWhereThePlanKnowsOne) {
  for (const char* mode : {"G64 P0.1\n", "G61.1\n"}) {
    const GcodeInsert insert = insert_of(mode);
    EXPECT_NO_THROW(check_gcode_inserts(insert, {}, usual_options(), false));
    EXPECT_NO_THROW(check_gcode_inserts({}, insert, usual_options(), true));  // after the work
    expect_contains(refusal(mode, false, true), "start.nc: sets how the machine takes corners");
    GcodeOptions ours = usual_options();
    ours.style.path_mode = PathMode{PathMode::Kind::ExactPath, {}, {}};
    EXPECT_NO_THROW(check_gcode_inserts(insert, {}, ours, true));  // which comes later and holds
  }
}

}  // namespace
}  // namespace dwell
