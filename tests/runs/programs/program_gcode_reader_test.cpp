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

Program read(const std::string& text, std::optional<GcodeDialect> dialect = std::nullopt) {
  return read_gcode(text, "part.nc", dialect);
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
      "n10 g21g90g17 (millimetres) s1000 m3\r\n"
      "N20 G00 Z 5.\r\n"
      "N30 x1y+1\r\n"
      "N40 G1 Z0 F300 ; down: 5 mm at 5 mm/s\r\n"
      "N50 g1x1.5y-2f300\r\n"
      "N60 G91 X4 M8\r\n"
      "\r\n"
      "N70 Y-3 F.6\r\n"
      "N80 G90 G4 P2\r\n"
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
  const std::string accepted = "accepted: G0 G1 G4 G17 G21 G90 G91 G93 G94, M2 M30 M3 M5 M7 M8 M9, and F N P S X Y Z";
  refused("G2 X1 Y1 I1", "word \"G2\"; " + accepted);
  refused("G1 X1 G38.2", "word \"G38.2\"; " + accepted);
  refused("G95", "word \"G95\"; " + accepted);
  refused("G92 X0", "word \"G92\"");
  refused("M6", "word \"M6\"; " + accepted);
  refused("T1", "word \"T1\"; " + accepted);
  refused("G1 X1 A5", "word \"A5\"; " + accepted);
  refused("g20", "\"g20\": inches are not accepted; required millimetres (G21)");
  refused("G1 X1 X2", "\"X2\" is the second word of its kind");
  refused("G0 G1 X1", "\"G1\" is the second word of its kind");
  refused("G1 X", "\"X\" has no readable number");
  refused("G1 X1..5", "\"X1..5\" has no readable number");
  refused("G1 Xnan", "\"X\" has no readable number");
  refused("G1 X1e3", "\"e3\"");
  refused("G1 X+-1", "\"X+-1\" has no readable number");
  refused("G1 X#5", "\"X\" has no readable number");
  refused("/G1 X1", "\"/G1 X1\" begins no word");
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
  refused("(dwell: gcode=g94, g4=milliseconds)", "g4=milliseconds; accepted: g4=seconds");
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
  expect_contains(message("G0 Z1\nG4 P1\nM2\n"), "line 2: G4 at an unknown position");
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
  const Program from_gcode = read_program(gcode.path(), GcodeDialect::G93Seconds);
  EXPECT_EQ(from_gcode.file, gcode.path().string());
  ASSERT_EQ(from_gcode.steps.size(), 5u);  // the tool comes down first
  expect_step(from_gcode.steps[4], {2, 2}, {2, 6}, 7.0, true);
  expect_contains(input_error([&] { read_program(feed.path(), GcodeDialect::G94); }),
                  "is a feed table, for which a G-code dialect (g94) has no meaning");
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
