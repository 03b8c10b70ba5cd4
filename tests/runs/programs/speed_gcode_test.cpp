// Programs with G293 and FLIN: written, read back, and refused where they would be misread.

#include "runs/programs/speed_gcode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/errors.h"
#include "paths/feed/machine_check.h"
#include "paths/feed/path_linear.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/speed_gcode_reader.h"
#include "tests/runs/programs/program_cases.h"
#include "tests/runs/programs/pvt_cases.h"

namespace dwell {
namespace {

using program_cases::expect_contains;
using program_cases::input_error;
using program_cases::replaced;
using pvt_cases::lifted_path;
using pvt_cases::made_by;
using pvt_cases::slow_machine;

constexpr SpeedDialect kBoth[] = {SpeedDialect::G293, SpeedDialect::Flin};

/// Within shares of the accelerations that leave room for FLIN.
Program gentle_motion(const Machine& machine, double share) {
  const FeedTable table = made_by();
  const Eigen::VectorXd seconds =
      Eigen::Map<const Eigen::VectorXd>(table.dwell_s.data(), static_cast<Eigen::Index>(table.dwell_s.size()));
  return exported_motion(table.path, Motion::Moving, machine, 20.0, seconds, {}, margins_of(share));
}

std::string written(SpeedDialect dialect, const Program& motion, const Machine& machine, const ProgramFrame& frame = {},
                    int block_numbers = 0) {
  ProgramWriting writing;
  writing.machine = machine;
  writing.header = {"input: map mirror [2].csv"};
  writing.gcode.block_numbers = block_numbers;
  ProgramToWrite program{made_by(), motion, true};
  program.table.frame = frame;
  const auto files = written_programs(program, writing, {std::string(to_string(dialect))});
  EXPECT_EQ(files.size(), 1U);
  return files.front().bytes;
}

double seconds_at_work(const Program& program) {
  double seconds = 0.0;
  for (const ProgramStep& step : program.steps) seconds += step.removes ? step.seconds : 0.0;
  return seconds;
}

/// Where a motion of cubics is at a time at work.
Point place_at_work(const Program& program, double time) {
  Point at;
  for (const ProgramStep& step : program.steps) {
    if (!step.removes) continue;
    at = step.finish;
    if (time <= step.seconds) {
      if (!step.speeds) return step.finish;
      // Hermite's own basis.
      const double s = time / step.seconds, r = 1.0 - s, t = step.seconds;
      return (1 + 2 * s) * r * r * step.start + (s * r * r * t) * step.speeds->in + s * s * (3 - 2 * s) * step.finish -
             (s * s * r * t) * step.speeds->out;
    }
    time -= step.seconds;
  }
  return at;
}

TEST(SpeedGcode, ReadsBackTheMotionWithinTheLimits) {
  const Machine machine = slow_machine();
  const Program motion = gentle_motion(machine, 0.6);
  for (const SpeedDialect dialect : kBoth) {
    const std::string text = written(dialect, motion, machine);
    const Program read = read_speed_gcode(text, "f", dialect, {});
    // Lifted ways are rapids, and coming down is a move of the program.
    EXPECT_NEAR(seconds_at_work(read), seconds_at_work(motion), 2e-5) << to_string(dialect);
    const auto faults = beyond_machine(read, machine);
    EXPECT_TRUE(faults.empty()) << to_string(dialect) << ": " << (faults.empty() ? "" : faults[0]);
    // FLIN is beside constant acceleration within a block only.
    const double within = dialect == SpeedDialect::G293 ? 2e-5 : 0.02;
    double most = 0.0;
    for (double t = 0.01; t < seconds_at_work(motion); t += 0.037)
      most = std::max(most, distance(place_at_work(read, t), place_at_work(motion, t)));
    EXPECT_LE(most, within) << to_string(dialect);
    std::size_t halts = 0, lifted = 0;
    for (const ProgramStep& step : read.steps) {
      halts += static_cast<std::size_t>(step.removes && !(step.length() > 0.0));
      lifted += static_cast<std::size_t>(!step.removes && step.length() > 0.0);
    }
    EXPECT_EQ(halts, 1U);
    EXPECT_EQ(lifted, 2U);
    EXPECT_GT(read.rapid_length, 0.0);
  }
}

TEST(SpeedGcode, LiesInTheProgramsFrameWithItsLettersAndNumbers) {
  const ProgramFrame frame({12.5, -3.25}, 37.0, true);
  Machine machine = slow_machine();
  machine.letters = {'U', 'B'};
  machine.frame = frame;
  machine.y.max_acceleration = 7.0;  // of the program's axis
  const Program motion = gentle_motion(machine, 0.6);
  GcodeReading reading;
  reading.letters = machine.letters;
  for (const SpeedDialect dialect : kBoth) {
    const std::string text = written(dialect, motion, machine, frame, 10);
    expect_contains(text, "dwell: zero=12.500000/-3.250000 rotate=37 swap=yes");
    expect_contains(text, "N20 ");
    expect_contains(text, " U");
    const Program read = read_speed_gcode(text, "f", dialect, reading);
    EXPECT_EQ(read.frame, frame);
    EXPECT_NEAR(seconds_at_work(read), seconds_at_work(motion), 2e-5);
    EXPECT_NEAR(distance(read.steps.back().finish, motion.steps.back().finish), 0.0, 2e-6);
    EXPECT_TRUE(beyond_machine(read, machine).empty()) << beyond_machine(read, machine)[0];
    Machine other = machine;
    other.x.max_acceleration = 7.0;
    EXPECT_FALSE(beyond_machine(read, other).empty());
    EXPECT_THROW(read_speed_gcode(text, "f", dialect, {}), InputError);
  }
}

EndFeedBlock moving(Point start, Point finish, double in, double out) {
  EndFeedBlock block{start, finish};
  block.speed_in = in;
  block.speed_out = out;
  return block;
}

std::vector<EndFeedBlock> few_blocks() {
  std::vector<EndFeedBlock> blocks{moving({1.0, -2.0}, {2.0, -2.0}, 0.0, 4.0),
                                   moving({2.0, -2.0}, {2.5, -2.0}, 4.0, 2.0),
                                   moving({2.5, -2.0}, {3.0, -2.0}, 2.0, 0.0)};
  blocks.push_back({{3.0, -2.0}, {3.0, -2.0}, 0.25});
  blocks.push_back({{3.0, -2.0}, {0.0, 5.0}, 0.0, false});
  blocks.push_back({{0.0, 5.0}, {0.0, 5.0}, 1.5});
  return blocks;
}

GcodeOptions few_options() {
  GcodeOptions options;
  options.max_feed_mm_per_min = 600.0;
  options.header = {"dwell 0.0"};
  options.machine = Machine{};
  options.machine->x.max_acceleration = 50.0;
  options.machine->path_acceleration = 60.0;
  return options;
}

const char* const kG293 =
    "(dwell 0.0)\n(dwell: gcode=g293)\n(dwell: tool at work when Z=0, lifted when Z>0)\n"
    "(units: X Y Z mm, F mm/min, halts seconds)\n(dwell: F0.06 at the end of a block stands for rest, the least feed)\n"
    "#SLOPE [TYPE=STEP]\nG17 G71 G90 G94\nG0 Z10.000000\nG0 X1.000000 Y-2.000000\nG1 G60 Z0 F600.000000\n"
    "G1 G293 X2.000000 Y-2.000000 F240.000000\nG1 G293 X2.500000 Y-2.000000 F120.000000\n"
    "G1 G293 X3.000000 Y-2.000000 F0.06\n#TIME 0.250000000\nG0 Z10.000000\nG0 X0.000000 Y5.000000\n"
    "G1 G60 Z0 F600.000000\n#TIME 1.50000000\nG0 Z10.000000\nM30\n";

TEST(SpeedGcode, WritesG293AsTheDocumentsSay) {
  EXPECT_EQ(speed_gcode_text(SpeedDialect::G293, few_blocks(), {}, few_options()), kG293);
  const Program read = read_speed_gcode(kG293, "f", SpeedDialect::G293, {});
  ASSERT_EQ(read.steps.size(), 8U);
  EXPECT_FALSE(read.steps[0].removes);
  EXPECT_NEAR(read.steps[1].seconds, 2.0 * 1.0 / 4.0, 1e-12);
  EXPECT_EQ(read.steps[1].speeds->in, (Point{}));
  EXPECT_NEAR(read.steps[2].seconds, 2.0 * 0.5 / 6.0, 1e-12);
  EXPECT_EQ(read.steps[3].speeds->out, (Point{}));
  EXPECT_NEAR(read.steps[3].seconds, 0.5, 1e-12);
  EXPECT_EQ(read.steps[4].seconds, 0.25);
  EXPECT_EQ(read.steps[7].seconds, 1.5);
  // The same halt in other words.
  const std::string other =
      replaced(replaced(kG293, "#TIME 0.250000000", "g04 x.25"), "#SLOPE [TYPE=STEP]", "N7 #slope[type = step]");
  EXPECT_EQ(read_speed_gcode(other, "f", SpeedDialect::G293, {}).steps[4].seconds, 0.25);
}

const char* const kFlin =
    "; dwell 0.0\n; dwell: gcode=flin\n; dwell: tool at work when Z=0, lifted when Z>0\n"
    "; units: X Y Z mm, F mm/min, halts seconds\n"
    "; dwell: from rest at x 50.0000000, path 60.0000000 mm/s^2\n"
    "G17 G90 G94 G710\nG64\nCOMPOF\nFNORM\nG0 Z10.000000\nG0 X1.000000 Y-2.000000\nG1 G9 Z0 F600.000000\n"
    "G1 X2.000000 Y-2.000000 F240.000000\nFLIN\nG1 X2.500000 Y-2.000000 F120.000000\nFNORM\n"
    "G1 G9 X3.000000 Y-2.000000 F120.000000\nG4 F0.250000000\nG0 Z10.000000\nG0 X0.000000 Y5.000000\n"
    "G1 G9 Z0 F600.000000\nG4 F1.50000000\nG0 Z10.000000\nM30\n";

TEST(SpeedGcode, WritesFlinAsTheDocumentsSay) {
  std::vector<EndFeedBlock> blocks = few_blocks();
  blocks[0].even = blocks[2].even = true;
  EXPECT_EQ(speed_gcode_text(SpeedDialect::Flin, blocks, {}, few_options()), kFlin);
  const Program read = read_speed_gcode(kFlin, "f", SpeedDialect::Flin, {});
  double first = 0.0, second = 0.0, third = 0.0;
  for (const ProgramStep& step : read.steps) {
    if (!step.speeds) continue;
    (step.finish.x <= 2.0 ? first : step.finish.x <= 2.5 ? second : third) += step.seconds;
  }
  EXPECT_NEAR(first, 1.0 / 4.0 + 4.0 / 100.0, 1e-12);
  EXPECT_NEAR(second, 0.5 * std::log(2.0) / 2.0, 1e-12);
  EXPECT_NEAR(third, 0.5 / 2.0 + 2.0 / 100.0, 1e-12);
  // From rest to rest in one block.
  const std::string stops = replaced(replaced(kFlin, "G1 X2.0", "G1 G9 X2.0"), "FLIN\nG1 X2.5", "G1 G9 X2.5");
  double whole = 0.0;
  for (const ProgramStep& step : read_speed_gcode(stops, "f", SpeedDialect::Flin, {}).steps)
    whole += step.speeds && step.finish.x <= 2.0 ? step.seconds : 0.0;
  EXPECT_NEAR(whole, 1.0 / 4.0 + 2.0 * 4.0 / 100.0, 1e-12);
}

TEST(SpeedGcode, IsKnownByItsCommentAndItsWords) {
  const auto word_of = [](const std::string& text) { return program_format_of(text)->word; };
  EXPECT_EQ(word_of(kG293), "g293");
  EXPECT_EQ(word_of(kFlin), "flin");
  EXPECT_EQ(word_of("(dwell: gcode=g293)\nG1 X1\n"), "g293");
  EXPECT_EQ(word_of("G0 Z1\ng1 g 293 X1 F5\n"), "g293");
  EXPECT_EQ(word_of("#SLOPE [TYPE=STEP]\nG0 Z1\n"), "g293");
  EXPECT_EQ(word_of("G0 Z1\nflin G1 X1 F5\n"), "flin");
  EXPECT_EQ(word_of("G0 Z1 (G293 FLIN #SLOPE)\nG1 X1.293 F5\n"), "");
  EXPECT_EQ(word_of("; dwell 0.2\n(no FLIN)\nG1 X1 F5\n"), "");
  // The reader of plain G-code takes none of them.
  expect_contains(input_error([] { read_gcode(kG293, "f", {}); }), "gcode = \"g293\"");
  expect_contains(input_error([] { read_gcode("G0 Z1\nG0 X0 Y0\nG1 Z0 F5\nG293 X1 F5\nM2\n", "f", {}); }),
                  "f, line 4: word \"G293\" is not known");
  expect_contains(input_error([] { read_gcode("G0 Z1\nG0 X0 Y0\nG1 Z0 F5\nFLIN X1 F5\nM2\n", "f", {}); }), "\"FLIN\"");
}

void refused(SpeedDialect dialect, const std::string& from, const std::string& to, const std::string& says) {
  const std::string text = replaced(dialect == SpeedDialect::G293 ? kG293 : kFlin, from, to);
  expect_contains(input_error([&] { read_speed_gcode(text, "f.nc", dialect, {}); }), says);
}

TEST(SpeedGcode, RefusesG293ThatItWouldMisread) {
  const auto refuse = [](const std::string& from, const std::string& to, const std::string& says) {
    refused(SpeedDialect::G293, from, to, says);
  };
  refuse("#SLOPE [TYPE=STEP]\n", "", "f.nc, line 10: G293 before #SLOPE [TYPE=STEP]");
  refuse("TYPE=STEP", "TYPE=HSC", "f.nc, line 6: \"#SLOPE [TYPE=HSC]\"; accepted: #SLOPE [TYPE=STEP]");
  refuse("G71", "G70", "\"G70\": inches");
  refuse("G71", "G21", "\"G21\": switches mirroring");
  refuse("G71", "G71 G61", "polynomials");
  refuse("G90 G94", "G90 G93", "G93 in a program read as g94");
  refuse("gcode=g293", "gcode=g94", "the program says gcode=g94, and has words of g293");
  refuse("G1 G293 X2.500000", "G1 G193 X2.500000", "f.nc, line 12: \"G193\": the feed linear over the path");
  refuse("G1 G293 X2.500000", "G1 G9 G293 X2.500000", "\"G9\": changes where");
  refuse("G1 G293 X2.500000", "G1 X2.500000",
         "f.nc, line 12: a move at F120 without G293 where the block before ends at F240");
  refuse("F0.06\n#TIME", "F60\n#TIME", "f.nc, line 14: a halt after a block that ends at F60; required rest");
}

TEST(SpeedGcode, RefusesRestsOfG293ThatItWouldMisread) {
  const auto refuse = [](const std::string& from, const std::string& to, const std::string& says) {
    refused(SpeedDialect::G293, from, to, says);
  };
  refuse("F240.000000\n", "F0.05\n", "line 11: G293 from rest to F0.06");
  refuse("F240.000000\n", "F0\n", "F = 0");
  refuse("F240.000000\n", "F99999999\n", "line 11: F of 1.66667e+06 mm/s; required");
  refuse("F0.06\n#TIME 0.250000000\n", "F6\n", "f.nc, line 15: the tool lifted after a block that ends at F6");
  refuse("G1 G293 X2.500000", "G1 G60 G293 X2.500000", "line 12: G60 stops the move");
  refuse("G1 G60 Z0", "G1 G293 Z0", "line 10: G293 where the tool is lifted or lowered");
  refuse("X2.500000 Y-2.000000 F120", "X2.000000 Y-2.000000 F120", "line 12: G293 without a move that has a length");
  refuse("#TIME 0.25", "G4 P0.25", "P is a parameter");
  refuse("#TIME 0.25", "#HSC ON\n#TIME 0.25", "line 14: \"#HSC ON\" is an expression");
  refuse("M30\n", "", "without M2 or M30");
}

TEST(SpeedGcode, RefusesFlinThatItWouldMisread) {
  const auto refuse = [](const std::string& from, const std::string& to, const std::string& says) {
    refused(SpeedDialect::Flin, from, to, says);
  };
  refuse("COMPOF\n", "", "f.nc, line 13: FLIN: a group of blocks that is compressed");
  refuse("G64\n", "", "line 13: FLIN: with exact stops at the end of blocks");
  refuse("G64\n", "G60\n", "line 7: \"G60\": stops at the end of every block");
  refuse("G64\n", "G64 G642\n", "line 7: word \"G642\" is not known");
  refuse("FNORM\nG1 G9 X3", "G1 G9 X3", "line 16: FLIN to rest, which linearly over the path takes forever");
  refuse("FNORM\nG1 G9 X3", "G1 X3", "FLIN to rest");
  refuse("F240.000000\nFLIN\n", "F240.000000\nG4 F1\nFLIN\n", "line 16: FLIN from rest");
  refuse("; dwell: from rest at x 50.0000000, path 60.0000000 mm/s^2\n", "",
         "line 12: FNORM from or to rest: how fast the machine accelerates there is not said; required the comment");
  refuse("60.0000000 mm/s^2", "60 m/s^2", "line 5: \"x 50.0000000, path 60 m/s^2\" in the comment");
  refuse("x 50.0000000", "z 50", "accepted: x, y or path");
  refuse("x 50.0000000", "x 1e-9", "accepted: x, y or path");
  refuse("x 50.0000000", "x 5", "too short to reach its F240");
  refuse("FLIN\n", "", "line 14: FNORM at F120 where the block before ends at F240");
  refuse("G4 F0.25", "G4 P0.25", "P is a parameter");
  refuse("G4 F0.25", "(halt)\nG4 F0.25", "line 18: \"(halt)\": comments stand behind ;");
  refuse("G710", "G21", "\"G21\": is no word of this controller");
  refuse("G710", "G700", "G700");
  refuse("X2.500000", "X99999999", "line 15: a place of 1e+08 mm; required");
  refuse("FNORM\nG1 G9 X3", "FNORM\nFCUB\nG1 G9 X3", "\"FCUB\"");
}

TEST(SpeedGcode, HasNoSpeedThatStandsForRest) {
  const std::vector<EndFeedBlock> few{
      moving({0.0, 0.0}, {1.0, 0.0}, 0.0, 3.0), moving({1.0, 0.0}, {2.0, 0.0}, 3.0, 5e-4),
      moving({2.0, 0.0}, {3.0, 0.0}, 5e-4, 3.0), moving({3.0, 0.0}, {4.0, 0.0}, 3.0, 0.0)};
  const std::string raised = speed_gcode_text(SpeedDialect::G293, few, {}, few_options());
  expect_contains(raised, "X2.000000 Y0.000000 F0.06005");
  EXPECT_NEAR(seconds_at_work(read_speed_gcode(raised, "f", SpeedDialect::G293, {})), 4.0 * 2.0 / 3.0, 1e-3);
  const std::string as_it_is = speed_gcode_text(SpeedDialect::Flin, few, {}, few_options());
  expect_contains(as_it_is, "X2.000000 Y0.000000 F0.0300000000");

  const std::vector<EndFeedBlock> blocks{moving({0.0, 0.0}, {1.0, 0.0}, 0.0, 5e-4),
                                         moving({1.0, 0.0}, {2.0, 0.0}, 5e-4, 0.0)};
  expect_contains(input_error([&] { speed_gcode_text(SpeedDialect::G293, blocks, {}, few_options()); }),
                  "a speed of 0.03 mm/min in the motion is not more than that which stands for rest, 0.06 mm/min");
}

}  // namespace
}  // namespace dwell
