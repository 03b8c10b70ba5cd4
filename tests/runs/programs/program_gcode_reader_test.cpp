#include <gtest/gtest.h>

#include <cmath>

#include "paths/feed/plan_program.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/gcode.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/program_reader.h"
#include "tests/runs/programs/program_cases.h"

namespace dwell {
namespace {

using program_cases::expect_contains;
using program_cases::input_error;
using program_cases::TestFile;

Program read(const std::string& text, std::optional<GcodeDialect> dialect = std::nullopt,
             std::optional<HaltUnit> halts = std::nullopt) {
  return read_gcode(text, "part.nc", {dialect, halts});
}

void expect_step(const ProgramStep& step, Point start, Point finish, double seconds, bool removes) {
  EXPECT_LE(distance(step.start, start), 1e-14);
  EXPECT_LE(distance(step.finish, finish), 1e-14);
  EXPECT_LE(std::abs(step.seconds - seconds), 1e-14 * (1.0 + seconds));
  EXPECT_EQ(step.removes, removes);
}

// Line 1 to 3: at (0, 0), at work.
const std::string kAtWork = "G21 G90 G94 G0 Z5\nG0 X0 Y0\nG1 Z0 F600\n";

TEST(GcodeReader, InterpretsAHandWrittenProgramModally) {
  const Program program = read(
      "%\r\n"
      "n10 g21g90g17 (millimetres) s1000 m3 M8\r\n"
      "N20 G00 Z 5.\r\n"
      "N30 x1y+1\r\n"
      "N40 G1 Z0 F300 ; down: 5 mm at 5 mm/s\r\n"
      "N50 g1x1.5y-2f300\r\n"
      "N60 G91 X4\r\n"
      "\r\n"
      "N70 Y-3 F.6\r\n"
      "N80 G90 G4 P2.\r\n"
      "N90 G0 Z5 M9\r\n"
      "M30\r\n"
      "%\r\n"
      "X99 this is never read\r\n");
  ASSERT_EQ(program.steps.size(), 5u);
  expect_step(program.steps[0], {1, 1}, {1, 1}, 1.0, false);
  expect_step(program.steps[1], {1, 1}, {1.5, -2}, std::sqrt(9.25) / 5.0, true);
  expect_step(program.steps[2], {1.5, -2}, {5.5, -2}, 0.8, true);
  expect_step(program.steps[3], {5.5, -2}, {5.5, -5}, 300.0, true);
  expect_step(program.steps[4], {5.5, -5}, {5.5, -5}, 2.0, true);
}

TEST(GcodeReader, ConvertsEveryDialectOfFeed) {
  const std::string start = "G0 Z1\nG0 X0 Y0\nG0 Z0\n";
  expect_step(read(start + "G94 G1 X3 Y4 F600\nM2\n").steps.at(0), {0, 0}, {3, 4}, 0.5, true);
  expect_step(read(start + "G93 G1 X3 Y4 F600\nM2\n", GcodeDialect::G93PerMinute).steps.at(0), {0, 0}, {3, 4}, 0.1,
              true);
  expect_step(read(start + "G93 G1 X3 Y4 F600\nM2\n", GcodeDialect::G93Seconds).steps.at(0), {0, 0}, {3, 4}, 600.0,
              true);
  const std::string stated =
      "( dwell: gcode=g93-seconds , g4=seconds)\n" + start + "G93\nG1 X3 Y4 F2\nG94\nX0 F60\nM2\n";
  const Program program = read(stated);
  ASSERT_EQ(program.steps.size(), 2u);
  expect_step(program.steps[0], {0, 0}, {3, 4}, 2.0, true);
  expect_step(program.steps[1], {3, 4}, {0, 4}, 3.0, true);
}

TEST(GcodeReader, RemovesOnlyAtWorkThroughoutAMove) {
  const Program program = read(kAtWork + "G4 P0.25\nG1 X3 Z4\nX9\nG4 P1.5\nX6 Z0\nX6\nG0 Z2\nX0\nG4 P0\nM2\n");
  ASSERT_EQ(program.steps.size(), 7u);
  expect_step(program.steps[0], {0, 0}, {0, 0}, 0.5, false);  // down 5 mm at 10 mm/s
  expect_step(program.steps[1], {0, 0}, {0, 0}, 0.25, true);
  expect_step(program.steps[2], {0, 0}, {3, 0}, 0.5, false);  // 5 mm obliquely up
  expect_step(program.steps[3], {3, 0}, {9, 0}, 0.6, false);
  expect_step(program.steps[4], {9, 0}, {9, 0}, 1.5, false);  // waits lifted
  expect_step(program.steps[5], {9, 0}, {6, 0}, 0.5, false);
  expect_step(program.steps[6], {6, 0}, {0, 0}, 0.0, false);  // a rapid
}

TEST(GcodeReader, NamesLineAndWordOfWhatItCannotAccept) {
  const auto refused = [](const std::string& line, const std::string& what,
                          std::optional<GcodeDialect> dialect = std::nullopt) {
    const std::string text = kAtWork + line + "\nM2\n";
    const std::string message = input_error([&] { read(text, dialect); });
    expect_contains(message, "part.nc, line 4: ");
    expect_contains(message, what);
  };
  const std::string accepted = "accepted: G0 G1 G4 G9 G15 G17 G20 G21 G40 G49 G50 G50.1 G54 ";
  refused("G38.7", "word \"G38.7\" is not known; " + accepted);
  refused("G187 P1", "word \"G187\" is not known");
  refused("M62", "word \"M62\" is not known; " + accepted);
  refused("G1 X1 X2", "\"X2\": is the second word of its kind");
  refused("G0 G1 X1", "\"G1\": is the second word of its kind");
  refused("G1 X", "\"X\" has no readable number");
  refused("G1 X1..5", "\"X1..5\" has no readable number");
  refused("G1 Xnan", "\"Xnan\" has no readable number");
  refused("G1 X1e3", "\"e3\"");
  refused("G1 X+-1", "\"X+-1\" has no readable number");
  refused("G1 X#5", "\"X\" has no readable number");
  refused("/G1 X1", "\"/G1 X1\" is a line that the operator may have skipped");
  refused("G1 X[#5+1]", "\"X\" has no readable number");
  refused("#5=3", "\"#5=3\" is an expression");
  refused("TRANS X5", "\"TRANS\" has no readable number");
  refused("G1 X1, R3", "\", R3\" begins no word");
  refused("G1 X1 (half", "comment \"(half\" is not closed");
  refused("G1 X1 F0", "F = 0; required > 0");
  refused("G1 X1 F-3", "F = -3; required > 0");
  refused("G1 X1 F.000" + std::string(320, '0') + "1", "no readable number");
  refused("G0 X1", "G0 over the part while the tool is not known to be lifted");
  refused("G0 X1 Z5", "G0 over the part while the tool is not known to be lifted");
  refused("G1 X1 Z-0.1", "Z = -0.1 mm is below the working height");
  refused("G0 Z-1", "Z = -1 mm is below the working height");
  refused("G4", "G4 needs P");
  refused("G4 P-1", "G4 needs P");
  refused("G4 P1 X1", "G4 together with a move");
  refused("G1 X1 P1", "P without G4");
  refused("G93 G1 X1 F1", "controllers disagree");
  refused("G93", "required the dialect g93-per-minute or g93-seconds");
  refused("G93 G1 X1 F1", "G93 in a program read as g94", GcodeDialect::G94);
  refused("G93 G1 X1", "G1 without F; after G93 each move needs its own", GcodeDialect::G93Seconds);
  refused("(dwell: gcode=g93-seconds)", "the program says gcode=g93-seconds, but it is to be read as g93-per-minute",
          GcodeDialect::G93PerMinute);
  refused("(dwell: gcode=g96)", "gcode = \"g96\"; accepted: g94");
  refused("(dwell: gcode=g94, g4=minutes)", "g4=minutes; accepted: g4=seconds, g4=milliseconds");
  refused("(dwell: units=inch)", "\"units=inch\" in the comment");
  refused("(dwell: tool at work when Z=5)", "accepted: gcode=..., g4=..., tool at work when Z=0");
}

TEST(GcodeReader, RefusesByNameWhatWouldChangeTheMeaning) {
  const auto refused = [](const std::string& line, const std::string& what) {
    const std::string message = input_error([&] { read(kAtWork + line + "\nM2\n"); });
    expect_contains(message, "part.nc, line 4: \"" + what);
  };
  refused("G2 X1 Y1 I1", "G2\": an arc");
  refused("g700", "g700\": inches, whose feeds are in inches on some controllers only");
  refused("G70", "G70\": inches");
  refused("G10 L2 P1 X5", "G10\": sets offsets");
  refused("G18", "G18\": another plane");
  refused("G28 X0", "G28\": goes by way of a reference point");
  refused("G38.2 Z-5", "G38.2\": a probing move");
  refused("G41 D1", "G41\": offset by the tool's radius");
  refused("G43 H1 Z5", "G43\": offset by the tool's length");
  refused("G1 Z5 H1", "H1\": the number of a tool's length");
  refused("G51 P2", "G51\": scales");
  refused("G51.1 X0", "G51.1\": mirrors");
  refused("G52 X5", "G52\": moves the origin");
  refused("G53 G0 Z0", "G53\": machine coordinates");
  refused("G54.1 P3", "G54.1\": further offsets");
  refused("G65 P9000", "G65\": a macro");
  refused("G68 X0 Y0 R30", "G68\": turns the coordinates");
  refused("G81 X1 Z0 R1", "G81\": a canned cycle");
  refused("G92 X0", "G92\": moves the origin");
  refused("G95", "G95\": feed per revolution");
  refused("G1 X1 A5", "A5\": a rotary axis");
  refused("G1 U5", "U5\": a further axis");
  refused("G80 X1", "G80\": beside X, Y or Z controllers disagree");
  refused("O100 P5", "O100\": a program's number stands alone");
  refused("M98 P100", "M98\": a macro or subprogram");
  refused("G1 X1 F9 Q2", "Q2\": Q is accepted only as a tolerance of G64");
}

// As LinuxCNC and the posts of CAM systems write them.
TEST(GcodeReader, ReadsAFrameAndWordsThatMoveNothing) {
  const Program program = read(
      "%\nO1000\nG90 G94 G17 G91.1\nG21\nG54\nG40 G49 G80 G69 G15\nG64 P0.01 Q0.01\nT1 M6\nS5000 M3 M8\nG0 Z10\n"
      "G0 X-5 Y0\nG1 Z0 F3000\nG1 X5 Y0 F60\nG0 Z10\nM5 M9\n%\nG1 this is never read\n");
  ASSERT_EQ(program.steps.size(), 2u);
  expect_step(program.steps[1], {-5, 0}, {5, 0}, 10.0, true);
  EXPECT_EQ(
      program.notes,
      (std::vector<std::string>{
          "G54: the offset of its origin, which the program does not say, is taken as zero: X and Y are the map's",
          "T, M6: the tool's offset is taken as zero, and the removal function as this tool's",
          "G61, G61.1, G64: kept; without a machine (--machine) moves are taken as written, their corners neither "
          "rounded nor slowed down"}));
  EXPECT_EQ(read("G0 X0 Y0 Z0\nG1 X1 F60\nM2\n").notes,
            std::vector<std::string>{"the program names no unit (G21): read as millimetres"});
  const auto message = [](const std::string& text) { return input_error([&] { read(text); }); };
  expect_contains(message("%\n" + kAtWork + "G1 X1 F60\n"), "without M2 or M30, or the % after it");
  expect_contains(message(kAtWork + "G1 X1 F60\n%\n"), "line 5: % after a program that does not begin with one");
  expect_contains(message("%_N_PART_MPF\n" + kAtWork + "M2\n"), "names behind % are not accepted");
  expect_contains(message(kAtWork + "O2000\nM2\n"), "line 4: O: another program begins");
}

TEST(GcodeReader, KeepsThePathModes) {
  using Kind = PathMode::Kind;
  const Program program = read("G21\nG64\nG61\nG0 Z10\nG0 X0 Y0\nG1 Z0 F600\nG1 X5 F60\nG61.1\nG1 Y2\n" +
                               std::string("G64 P0.05 Q0.02\nG1 X0\nG64 P0\nM2\n"));
  ASSERT_EQ(program.steps.size(), 4u);  // coming down to work is the first
  EXPECT_EQ(program.path_modes, (std::vector<PathModeChange>{{0, {Kind::ExactPath, {}, {}}},
                                                             {2, {Kind::ExactStop, {}, {}}},
                                                             {3, {Kind::Blended, 0.05, 0.02}},
                                                             {4, {Kind::Blended, 0.0, {}}}}));
  EXPECT_TRUE(read("G0 X0 Y0 Z0\nG1 X1 F60\nM2\n").path_modes.empty());
  const auto message = [](const std::string& text) { return input_error([&] { read(text); }); };
  expect_contains(message(kAtWork + "G64 P-1\nM2\n"), "\"P-1\": a tolerance of G64; required >= 0");
  expect_contains(message(kAtWork + "G61 P0.1\nM2\n"), "P without G4");
  expect_contains(message(kAtWork + "G61 G64\nM2\n"), "G64\": is the second word of its kind");
}

TEST(GcodeReader, SaysThatTheOffsetOfAnOriginIsTakenAsZero) {
  for (const char* offset : {"G54", "G55", "G56", "G57", "G58", "G59", "G59.1"}) {
    const Program program = read("G21\n" + std::string(offset) + "\n" + kAtWork + "G1 X1 F60\nM2\n");
    ASSERT_FALSE(program.notes.empty()) << offset;
    expect_contains(program.notes.front(), std::string(offset) + ": the offset of its origin");
  }
  expect_contains(read("G21\nT2 M6\n" + kAtWork + "G1 X1 F60\nM2\n").notes.front(), "T, M6: the tool's offset");
}

TEST(GcodeReader, AsksForTheUnitOfAWholeNumberOfP) {
  const auto seconds = [](const std::string& halt, std::optional<HaltUnit> unit) {
    return read(kAtWork + halt + "\nM2\n", std::nullopt, unit).steps.back().seconds;
  };
  EXPECT_EQ(seconds("G4 P500", HaltUnit::Milliseconds), 0.5);
  EXPECT_EQ(seconds("G4 P500", HaltUnit::Seconds), 500.0);
  EXPECT_EQ(seconds("G4 P0.5", HaltUnit::Seconds), 0.5);
  EXPECT_EQ(seconds("G4 P0.5", std::nullopt), 0.5);
  EXPECT_EQ(seconds("(dwell: g4=milliseconds)\nG4 P500", std::nullopt), 0.5);
  EXPECT_EQ(seconds("(dwell: g4=seconds)\nG4 P500", std::nullopt), 500.0);
  EXPECT_EQ(read(kAtWork + "G4 P0\nM2\n").steps.size(), 1u);  // no time in either unit
  const auto message = [](const std::string& halt, std::optional<HaltUnit> unit) {
    return input_error([&] { read(kAtWork + halt + "\nM2\n", std::nullopt, unit); });
  };
  expect_contains(message("G4 P500", std::nullopt), "line 4: G4 P500: a whole number is seconds on some controllers");
  expect_contains(message("G4 P500", std::nullopt), "required --g4 s or --g4 ms, or a decimal point");
  expect_contains(message("G4 P0.5", HaltUnit::Milliseconds), "required a whole number");
  expect_contains(message("(dwell: g4=seconds)", HaltUnit::Milliseconds), "P of G4 is to be read as ms");
  expect_contains(message("G4 P1e300", std::nullopt), "\"e300\"");
  expect_contains(message("G4 P200000000.", std::nullopt), "a halt of 2e+08 s; required at most");
  expect_contains(message("G4 X1.5", std::nullopt), "its time as P");
  expect_contains(message("G4 F1.5", std::nullopt), "G4 with F or S");
  EXPECT_EQ(parse_halt_unit("ms"), HaltUnit::Milliseconds);
  expect_contains(input_error([] { parse_halt_unit("min"); }), "g4 = \"min\"; accepted: s, ms");
}

TEST(GcodeReader, RefusesAnInverseTimeMoveThatGoesNowhere) {
  const std::string start = "G0 Z1\nG0 X0 Y0\nG0 Z0\n";
  expect_contains(input_error([&] { read(start + "G93 G1 X0 F6\nM2\n", GcodeDialect::G93PerMinute); }),
                  "line 4: a move of no length with F6 after G93: a halt on some controllers and nothing on others");
  EXPECT_EQ(read(start + "G94 G1 X0 F6\nX1\nM2\n").steps.size(), 1u);
}

TEST(GcodeReader, RefusesACommentInAComment) {
  const std::string nested = "(Max length needed (X): 70.0 in / 1778.0 mm)";
  expect_contains(input_error([&] { read(nested + "\n" + kAtWork + "M2\n"); }),
                  "line 1: comment \"" + nested + "\" holds another: controllers disagree on where it ends");
}

TEST(GcodeReader, RefusesACommentThatNamesAnotherUnit) {
  for (const std::string comment : {"(all dimensions in inches)", "(F in mm/s)", "(units: inch)", "; x in um",
                                    "(units: X Y Z mm, F mm/s, P seconds)", "(P in ms)", "(IN)"}) {
    const std::string message = input_error([&] { read(kAtWork + comment + "\nG1 X1\nM2\n"); });
    expect_contains(message, "part.nc, line 4: \"");
    expect_contains(message, "looks like another unit; accepted: X, Y, Z in mm and F in mm/min");
  }
  for (const std::string comment :
       {"(units: X Y Z mm, F mm/min, P seconds)", "(all dimensions in mm)", "(begins in the middle)",
        "(tool of 0.25 in)", "(input: map x in um.csv sha256=00)", "; F in mm/min"}) {
    EXPECT_EQ(read(kAtWork + comment + "\nG1 X1\nM2\n").steps.size(), 2u) << comment;
  }
  EXPECT_EQ(read(kAtWork + "(P in ms)\nG1 X1\nM2\n", std::nullopt, HaltUnit::Milliseconds).steps.size(), 2u);
}

TEST(GcodeReader, KnowsOneStateOfTheToolAtWork) {
  const std::string start = "T1 M6\nS1000 M3\nM8\n" + kAtWork + "G1 X1 F60\n";  // to line 7
  const auto refused = [&](const std::string& lines, const std::string& what) {
    expect_contains(input_error([&] { read(start + lines + "\nX2\nM2\n"); }), what);
  };
  refused("S2000", "line 9: the spindle's speed is S2000, before S1000 than where the tool was first at work");
  refused("M5", "the spindle is M5, before M3");
  refused("M4", "the spindle is M4, before M3");
  refused("M9", "the coolant is off, before M8");
  refused("M7", "the coolant is M7 and M8, before M8");
  refused("T2", "the tool is T2, before T1");
  refused("M6", "line 8: M6 while the tool may be at work");
  refused("M0", "line 8: M0 or M1 while the tool may be at work");
  refused("G55", "line 8: G55 after moves with G54");
  const std::string again = "G0 Z5\nM5 M9\nT2\nM1\nT1 S1000 M3 M8\nG1 Z0 F600\nF60\nX2\nM2\n";
  EXPECT_EQ(read(start + again).steps.back().finish, (Point{2, 0}));
  refused("G0 Z5\nT1 M6\nG1 Z0 F600", "the tool was changed (M6)");
  EXPECT_EQ(read("G55\n" + kAtWork + "G1 X1 F60\nG55 X2\nM2\n").steps.size(), 3u);
}

TEST(GcodeReader, AsksForAnFOfItsOwn) {
  const std::string start = "G0 Z1\nG0 X0 Y0\nG0 Z0\n";
  const auto message = [&start](const std::string& rest) {
    return input_error([&] { read(start + rest, GcodeDialect::G93Seconds); });
  };
  EXPECT_EQ(message("G1 X1\nM2\n"), "part.nc, line 4: G1 without F; required F > 0 on this line or one before it");
  expect_contains(message("G93 G1 X1 F1\nX2\nM2\n"), "line 5: G1 without F; after G93 each move needs its own");
  expect_contains(message("G93\nF1\nG1 X2\nM2\n"), "line 6: G1 without F; after G93 each move needs its own");
  expect_contains(message("G93 G1 X1 F1\nG94 X2\nM2\n"), "line 5: G1 without F; required F > 0");  // F meant seconds
}

TEST(GcodeReader, AsksForAKnownPosition) {
  const auto message = [](const std::string& text) { return input_error([&] { read(text); }); };
  expect_contains(message("G1 X1 Y1 Z0 F9\nM2\n"), "line 1: G1 from an unknown position");
  expect_contains(message("G0 X1 Y1\nG1 Z0 F9\nM2\n"), "line 2: G1 from an unknown position");
  expect_contains(message("G0 X1 Y1\nG0 X2\nM2\n"),
                  "line 2: G0 over the part while the tool is not known to be lifted");
  expect_contains(message("G0 Z0\nG0 X1 Y1\nM2\n"),
                  "line 2: G0 over the part while the tool is not known to be lifted");
  expect_contains(message("G0 Z1\nG4 P1.\nM2\n"), "line 2: G4 at an unknown position");
  expect_contains(message("G0 Z1\nG91 X1\nM2\n"), "line 2: X1 after G91 from an unknown position");
  expect_contains(message("X1 Y1\nM2\n"), "line 1: X, Y or Z before any G0 or G1");
  // The first rapid arrives from where the machine stood.
  const Program program = read("G0 X1 Y1 Z0\nG1 X2 F60\nM2\n");
  ASSERT_EQ(program.steps.size(), 1u);
  expect_step(program.steps[0], {1, 1}, {2, 1}, 1.0, true);
}

TEST(GcodeReader, RefusesAProgramWithoutEndOrSteps) {
  expect_contains(input_error([] { read(kAtWork + "G1 X1\n"); }), "part.nc: ends at line 4 without M2 or M30");
  expect_contains(input_error([] { read(""); }), "part.nc: ends at line 0 without M2 or M30");
  expect_contains(input_error([] { read("G21\nM2\n"); }), "part.nc: holds no move and no halt");
  expect_contains(input_error([] { read(kAtWork + "G1 X100 F." + std::string(306, '0') + "1\nM2\n"); }),
                  "line 4: a move of 100 mm");
  expect_contains(input_error([] { read(kAtWork + "G1 X100 F0.00001\nM2\n"); }), "takes 6e+08 s; required at most");
}

TEST(ProgramReader, TellsAFeedTableFromGcodeByContent) {
  const ToolPath path{"file", {{0, 0}, {2, 0}, {2, 4}}, {1, 0, 0}};
  const FeedTable table = feed_table_of(path, {1.0, 3.0, 7.0}, Motion::Moving, 3000.0);
  const Program planned = program_of(table);
  const TestFile feed("some.txt", feed_table_text(table));
  GcodeOptions options;
  options.dialect = GcodeDialect::G93Seconds;
  options.max_feed_mm_per_min = 3000.0;
  const TestFile gcode("other.txt", "\n" + gcode_text(planned, options));
  const Program from_feed = read_program(feed.path());
  EXPECT_EQ(from_feed.file, feed.path().string());
  ASSERT_EQ(from_feed.steps.size(), 4u);
  expect_step(from_feed.steps[3], {2, 2}, {2, 6}, 7.0, true);
  const Program from_gcode = read_program(gcode.path(), {GcodeDialect::G93Seconds, {}});
  EXPECT_EQ(from_gcode.file, gcode.path().string());
  ASSERT_EQ(from_gcode.steps.size(), 5u);  // the tool comes down first
  expect_step(from_gcode.steps[4], {2, 2}, {2, 6}, 7.0, true);
  expect_contains(input_error([&] {
                    read_program(feed.path(), {GcodeDialect::G94, {}});
                  }),
                  "is a feed table, for which a G-code dialect (g94) has no meaning");
  expect_contains(input_error([&] {
                    read_program(feed.path(), {{}, HaltUnit::Seconds});
                  }),
                  "is a feed table, for which a unit of P in G4 (s) has no meaning");
}

TEST(ProgramReader, SkipsAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF", gcode = "G21 G90 G94\nG0 Z5\nG0 X0 Y0\nG0 Z0\nG1 X2 F60\nM2\n";
  const ToolPath path{"file", {{0, 0}, {2, 0}}, {1, 0}};
  const std::string feed = feed_table_text(feed_table_of(path, {1.0, 3.0}, Motion::Moving, 3000.0));
  for (const std::string& text : {gcode, feed}) {
    const TestFile plain("plain", text), marked("marked", mark + text);
    const Program expected = read_program(plain.path()), found = read_program(marked.path());
    ASSERT_EQ(found.steps.size(), expected.steps.size());
    EXPECT_EQ(found.total_seconds(), expected.total_seconds());
  }
}

TEST(ProgramReader, RefusesOtherFiles) {
  const TestFile empty("empty", " \n\n");
  expect_contains(input_error([&] { read_program(empty.path()); }), "is empty; accepted: a feed table");
  const TestFile map("map.csv", "1.0,2.0\n3.0,4.0\n");
  expect_contains(input_error([&] { read_program(map.path()); }),
                  "begins like no machine program; accepted: a feed table");
  const TestFile headless("feed.csv", "sequence,x_mm,y_mm,dwell_s,feed_mm_per_min,lift\n1,0,0,1,0,1\n");
  expect_contains(input_error([&] { read_program(headless.path()); }),
                  "line 1: header line \"# motion: moving|stop\" is missing");
  expect_contains(input_error([&] { read_program(headless.path().parent_path() / "no such program"); }),
                  "no such program");
}

}  // namespace
}  // namespace dwell
