#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "paths/feed/plan_program.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/frame_text.h"
#include "runs/programs/gcode.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/path_mode_option.h"
#include "runs/programs/program_comments.h"
#include "tests/runs/programs/program_cases.h"

namespace dwell {
namespace {

using program_cases::expect_contains;
using program_cases::input_error;
using program_cases::kMaxFeedPerMin;
using program_cases::replaced;
using program_cases::winding_dwells;
using program_cases::winding_path;

constexpr GcodeDialect kEveryDialect[] = {GcodeDialect::G94, GcodeDialect::G93PerMinute, GcodeDialect::G93Seconds};

/// The frames and units in which the same program is written.
struct Layout {
  ProgramFrame frame;
  bool inches;
};

const Layout kLayouts[] = {{{}, false},
                           {{}, true},
                           {{{12.5, -3.25}, 0, false}, false},
                           {{{0, 0}, 90, false}, false},
                           {{{1.5, -2}, 180, false}, true},
                           {{{-1.5, 20}, 270, true}, false},
                           {{{0, 0}, 0, true}, false},
                           {{{0.123456, 7}, 37.123456789, false}, true},
                           {{{5, 6}, -211.5, true}, false}};

GcodeOptions options_with(const GcodeStyle& style, GcodeDialect dialect = GcodeDialect::G94) {
  GcodeOptions options;
  options.dialect = dialect;
  options.max_feed_mm_per_min = kMaxFeedPerMin;
  options.style = style;
  return options;
}

Program winding_steps(Motion motion = Motion::Moving) {
  return program_of(winding_path(), winding_dwells(motion), motion, 50.0);
}

std::string laid_text(const Layout& layout, GcodeDialect dialect, Program program) {
  program.frame = layout.frame;
  GcodeStyle style;
  style.inches = layout.inches;
  return gcode_text(program, options_with(style, dialect));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0, end = 0; (end = text.find('\n', from)) != std::string::npos; from = end + 1)
    lines.push_back(text.substr(from, end - from));
  return lines;
}

TEST(GcodeStyle, ReadsBackAsThePlannedProgramInEveryFrameAndUnit) {
  for (const Layout& layout : kLayouts) {
    for (const GcodeDialect dialect : kEveryDialect) {
      for (const Motion motion : {Motion::Moving, Motion::Stop}) {
        SCOPED_TRACE(frame_text(layout.frame) + (layout.inches ? " inch " : " mm ") + to_string(dialect));
        const Program planned = winding_steps(motion);
        Program read = read_gcode(laid_text(layout, dialect, planned), "p.nc", {});
        EXPECT_EQ(read.frame, layout.frame);
        EXPECT_TRUE(same_removing_steps(read, planned, 50.0));
        double fastest = 0.0;
        std::erase_if(read.steps, [](const ProgramStep& s) { return !s.removes && s.start == s.finish; });
        ASSERT_EQ(read.steps.size(), planned.steps.size());
        for (std::size_t i = 0; i < read.steps.size(); ++i) {
          EXPECT_LE(distance(read.steps[i].finish, planned.steps[i].finish), 0.72e-6) << i;
          EXPECT_LE(std::abs(read.steps[i].seconds - planned.steps[i].seconds), 1e-6 * planned.steps[i].seconds) << i;
          if (read.steps[i].removes && read.steps[i].length() > 0.0)
            fastest = std::max(fastest, read.steps[i].length() / read.steps[i].seconds);
        }
        EXPECT_LE(fastest, 50.0 * (1.0 + 1e-13));
        EXPECT_GE(fastest, 50.0 * (1.0 - 1e-6));
      }
    }
  }
}

// By hand: (3, 4) of the part, from (1, 2), turned by a quarter, is (-2, 2); exchanged (2, -2).
TEST(GcodeStyle, WritesThePlacesOfTheMachine) {
  Program program;
  program.steps = {{{1, 2}, {3, 4}, 4.0, true}};
  const std::string turned = laid_text({{{1, 2}, 90, false}, false}, GcodeDialect::G94, program);
  expect_contains(turned, "(dwell: zero=1.000000/2.000000 rotate=90 swap=no)\n(units: X Y Z mm, F");
  expect_contains(turned, "G0 X0.000000 Y0.000000\n");
  expect_contains(turned, "G1 X-2.000000 Y2.000000 F42.4264068\n");
  expect_contains(laid_text({{{1, 2}, 90, true}, false}, GcodeDialect::G94, program),
                  "swap=yes)\n(units: X Y Z mm, F mm/min, P seconds)\nG21\nG90\nG17\nG94\nG0 Z10.000000\nG0 X0.000000 "
                  "Y0.000000\nG1 Z0 F3000.00000\n"
                  "G1 X2.000000 Y-2.000000 F42.4264068\n");
  const std::string inches = laid_text({{}, true}, GcodeDialect::G94, program);
  expect_contains(inches, "G20\n(units: X Y Z inch, F inch/min, P seconds)\n");
  expect_contains(inches,
                  "P seconds)\nG90\nG17\nG94\nG0 Z0.39370079\nG0 X0.03937008 Y0.07874016\nG1 Z0 F118.110236\n"
                  "G1 X0.11811024 Y0.15748031 F1.67033");
}

TEST(GcodeStyle, HasLinesThatControllersTakeWhateverTheNumbers) {
  Program program;
  program.steps = {{{-999999.123456, 999999.5}, {-999998.1, 999998.25}, 9e7, true},
                   {{-999998.1, 999998.25}, {-999998.1 + 2e-6, 999998.25}, 1e7, true}};
  for (const GcodeDialect dialect : kEveryDialect) {
    for (const Layout& layout :
         {Layout{{}, false}, Layout{{}, true},
          Layout{rounded_frame({-999999.1234567, 999999.7654321}, -359.12345678901, true), true},
          Layout{rounded_frame({999999.1234567, -999999.7654321}, -359.12345678901, true), false}}) {
      GcodeStyle style;
      style.inches = layout.inches;
      style.block_numbers = 1000;
      style.path_mode = PathMode{PathMode::Kind::Blended, 0.0123456, {}};
      program.frame = layout.frame;
      for (const std::string& line : lines_of(gcode_text(program, options_with(style, dialect)))) {
        EXPECT_LE(line.size(), kLongestLine) << line;
        EXPECT_TRUE(is_printable_ascii(line)) << line;
      }
    }
  }
}

TEST(GcodeStyle, SaysHowCornersAreToBeTaken) {
  const auto preamble = [](const std::string& mode, bool inches) {
    GcodeStyle style;
    style.inches = inches;
    const PathModeOption option = parse_path_mode(mode);
    if (option.choice == PathModeOption::Choice::Given) style.path_mode = option.mode;
    const std::string text = gcode_text(winding_steps(), options_with(style));
    const Program read = read_gcode(text, "p.nc", {});
    EXPECT_EQ(read.path_modes.size(), style.path_mode ? 1u : 0u);
    if (style.path_mode) {
      EXPECT_EQ(read.path_modes[0].first_step, 0u);
      EXPECT_EQ(read.path_modes[0].mode.kind, option.mode.kind);
      EXPECT_NEAR(read.path_modes[0].mode.tolerance_mm.value_or(-1), option.mode.tolerance_mm.value_or(-1), 1e-6);
    }
    const std::size_t from = text.find("G94\n") + 4;
    return text.substr(from, text.find("G0 Z") - from);
  };
  EXPECT_EQ(preamble("none", false), "");
  EXPECT_EQ(preamble("auto", false), "");
  EXPECT_EQ(preamble("exact-path", false), "G61\n");
  EXPECT_EQ(preamble("exact-stop", false), "G61.1\n");
  EXPECT_EQ(preamble("blend", false), "G64\n");
  EXPECT_EQ(preamble("blend:0.05", false), "G64 P0.050000\n");
  EXPECT_EQ(preamble("blend:0.05", true), "G64 P0.00196850\n");
  for (const char* mode : {"auto", "none", "exact-path", "exact-stop", "blend", "blend:0.05"})
    EXPECT_EQ(to_string(parse_path_mode(mode)), mode);
  for (const char* mode : {"", "exact", "blend:", "blend:0", "blend:-1", "blend:nan", "blend:0.05mm"})
    expect_contains(input_error([&] { parse_path_mode(mode); }), "accepted: auto, none, exact-stop, exact-path, blend");
}

TEST(GcodeStyle, NumbersItsLines) {
  GcodeStyle style;
  style.block_numbers = 10;
  style.before = {"M8"};
  style.after = {"M9"};
  const Program planned = winding_steps();
  const std::string text = gcode_text(planned, options_with(style));
  expect_contains(
      text, ")\nM8\n(units: X Y Z mm, F mm/min, P seconds)\nN10 G21\nN20 G90\nN30 G17\nN40 G94\nN50 G0 Z10.000000\n");
  expect_contains(text, "G0 Z10.000000\nM9\nN");
  EXPECT_TRUE(text.ends_with(" M2\n"));
  EXPECT_TRUE(same_removing_steps(read_gcode(text, "p.nc", {}), planned, 50.0));
  // They begin anew where controllers have no more.
  Program many;
  for (int i = 0; i < 300; ++i) many.steps.push_back({{0.1 * i, 0}, {0.1 * (i + 1), 0}, 1.0, true});
  style.block_numbers = 1000;
  const std::vector<std::string> lines = lines_of(gcode_text(many, options_with(style)));
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const auto& line) { return line.starts_with("N99000 "); }));
  EXPECT_TRUE(std::none_of(lines.begin(), lines.end(), [](const auto& line) { return line.starts_with("N100000 "); }));
}

// Whatever the lines before left: the first move goes up, the first over the part is lifted, the last goes up.
TEST(GcodeStyle, BeginsAndEndsLifted) {
  for (const Layout& layout : kLayouts) {
    for (const GcodeDialect dialect : kEveryDialect) {
      for (const Motion motion : {Motion::Moving, Motion::Stop}) {
        std::vector<std::string> moves;
        for (const std::string& line : lines_of(laid_text(layout, dialect, winding_steps(motion))))
          if (line.find_first_of("XYZ") != std::string::npos && line.front() != '(') moves.push_back(line);
        ASSERT_GT(moves.size(), 4u);
        EXPECT_TRUE(moves[0].starts_with("G0 Z") && moves[0].find_first_of("XY") == std::string::npos) << moves[0];
        EXPECT_TRUE(moves[1].starts_with("G0 X")) << moves[1];
        EXPECT_TRUE(moves[2].starts_with("G1 Z0 F")) << moves[2];
        EXPECT_EQ(moves.back(), moves.front());
      }
    }
  }
}

TEST(GcodeStyle, RefusesAFrameThatItCannotRead) {
  const std::string text = laid_text({{{1, 2}, 90, true}, false}, GcodeDialect::G94, winding_steps());
  const std::string frame = "(dwell: zero=1.000000/2.000000 rotate=90 swap=yes)";
  for (const char* damaged :
       {"(dwell: zero=1.000000/2.000000 rotate=90)", "(dwell: zero=1.000000,2.000000 rotate=90 swap=yes)",
        "(dwell: zero=1.000000/2.000000 rotate=9o swap=yes)", "(dwell: zero=1.000000/2.000000 rotate=90 swap=y)",
        "(dwell: zero=1.000000/nan rotate=90 swap=yes)", "(dwell: zero=1.000000/2.000000 rotate=9000 swap=yes)",
        "(dwell: zero=1.000000/2.000000 swap=yes rotate=90)", "(dwell: rotate=90 swap=yes)",
        "(dwell: zero=1.000000/2.000000 rotate=90 swap=yes scale=2)"}) {
    const std::string message = input_error([&] { read_gcode(replaced(text, frame, damaged), "p.nc", {}); });
    expect_contains(message, "p.nc, line 3: ");
    expect_contains(message, "zero=X/Y rotate=DEG swap=yes");
  }
  expect_contains(input_error([&] { read_gcode(replaced(text, frame, frame + "\n" + frame), "p.nc", {}); }),
                  "p.nc, line 4: \"zero=1.000000/2.000000 rotate=90 swap=yes\" is a second frame");
  expect_contains(input_error([&] {
                    read_gcode(replaced(replaced(text, frame + "\n", ""), "G0 X", frame + "\nG0 X"), "p.nc", {});
                  }),
                  "is a frame after coordinates; required one, before the first X, Y or Z");
  EXPECT_EQ(parse_frame("zero=1.5/-2 rotate=-90 swap=no"), ProgramFrame({1.5, -2}, -90, false));
}

TEST(GcodeStyle, IsOfTheFeedTableToo) {
  FeedTable table = feed_table_of(winding_path(), winding_dwells(Motion::Moving), Motion::Moving, kMaxFeedPerMin);
  EXPECT_EQ(feed_table_text(table).find("machine_frame"), std::string::npos);
  table.frame = rounded_frame({1.25, -7}, 37, true);
  const std::string text = feed_table_text(table);
  expect_contains(text, "# machine_frame: zero=1.250000/-7.000000 rotate=37 swap=yes\n");
  const FeedTable read = parse_feed_table(text, "feed.csv");
  EXPECT_EQ(read.frame, table.frame);
  EXPECT_EQ(read.path.points, table.path.points);  // those of the part
  EXPECT_EQ(program_of(read).frame, table.frame);
  expect_contains(input_error([&] { parse_feed_table(replaced(text, "rotate=37", "rotate=x"), "feed.csv"); }),
                  "feed.csv, line ");
}

TEST(GcodeStyle, ReadsInches) {
  const auto read = [](const std::string& text) { return read_gcode(text, "p.nc", {GcodeDialect::G93Seconds, {}}); };
  const Program program = read(
      "(all dimensions in inches, F in inches/min)\nG20 G90 G94\nG64 P0.01 Q0.002\nG0 Z1\nG0 X1 Y-2\nG1 Z0 F60\n"
      "G1 X2 F6\nG91 Y0.5\nG93 X-1 F3\nG90 G94 G21 X0 F254\nM2\n");
  ASSERT_EQ(program.steps.size(), 5u);
  EXPECT_NEAR(program.steps[0].seconds, 1.0, 1e-12);  // an inch at 60 inches a minute
  EXPECT_EQ(program.steps[1].start, (Point{25.4, -50.8}));
  EXPECT_EQ(program.steps[1].finish, (Point{50.8, -50.8}));
  EXPECT_NEAR(program.steps[1].seconds, 10.0, 1e-12);
  EXPECT_NEAR(program.steps[2].finish.y, -38.1, 1e-12);
  EXPECT_EQ(program.steps[3].seconds, 3.0);
  EXPECT_NEAR(program.steps[4].seconds, 6.0, 1e-12);  // from 25.4 mm to 0
  EXPECT_NEAR(program.path_modes.at(0).mode.tolerance_mm.value(), 0.254, 1e-12);
  EXPECT_NEAR(program.path_modes.at(0).mode.merging_mm.value(), 0.0508, 1e-12);
  EXPECT_TRUE(std::none_of(program.notes.begin(), program.notes.end(),
                           [](const std::string& note) { return note.find("no unit") != std::string::npos; }));
  // What is said of inches must be so; other units are refused in them too; F is said anew.
  expect_contains(
      input_error([&] { read("(UNITS: INCHES)\nG21 G0 Z1\nM2\n"); }),
      "p.nc, line 1: \"INCHES\" in the comment \"UNITS: INCHES\" looks like another unit; accepted: X, Y, Z "
      "in mm and F in mm/min, or the comment without a unit, or G20");
  expect_contains(input_error([&] { read("G20\n(X in inches, F in mm/s)\nG0 Z1\nM2\n"); }), "line 2: \"mm/s\"");
  expect_contains(input_error([&] { read("G21 G0 Z1\nG0 X0 Y0\nG1 Z0 F60\nG20\nX1\nM2\n"); }), "line 5: G1 without F");
  expect_contains(input_error([&] { read("G20 G21\nM2\n"); }), "\"G21\": is a second unit on this line");
}

}  // namespace
}  // namespace dwell
