#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "paths/feed/plan_program.h"
#include "runs/programs/feed_table.h"
#include "runs/programs/gcode.h"
#include "runs/programs/gcode_reader.h"
#include "tests/runs/programs/program_cases.h"

namespace dwell {
namespace {

using program_cases::expect_contains;
using program_cases::input_error;
using program_cases::kMaxFeedPerMin;
using program_cases::winding_dwells;
using program_cases::winding_path;

constexpr GcodeDialect kDialects[] = {GcodeDialect::G94, GcodeDialect::G93PerMinute, GcodeDialect::G93Seconds};

GcodeOptions options_for(GcodeDialect dialect, double max_feed = kMaxFeedPerMin) {
  GcodeOptions options;
  options.dialect = dialect;
  options.max_feed_mm_per_min = max_feed;
  return options;
}

// What the program reads back as, without the tool coming down: the only steps that stand still and do not remove.
Program without_plunges(Program program) {
  std::erase_if(program.steps, [](const ProgramStep& s) { return !s.removes && s.start == s.finish; });
  return program;
}

TEST(Gcode, WritesTheDocumentedText) {
  const ToolPath path{"file", {{0, 0}, {2, 0}, {2, 4}, {-5, 0}}, {1, 0, 0, 1}};
  const Program program = program_of(path, {1.0, 3.0, 7.0, 1.0 / 3.0}, Motion::Moving, 50.0);
  GcodeOptions options = options_for(GcodeDialect::G94);
  options.header = {"dwell 0.1.0", "map (old)\nmirror.csv"};
  const std::string text = gcode_text(program, options);
  EXPECT_EQ(text,
            "(dwell 0.1.0)\n"
            "(map [old]?mirror.csv)\n"
            "(dwell: gcode=g94, g4=seconds)\n"
            "(dwell: tool at work when Z=0, lifted when Z>0)\n"
            "(units: X Y Z mm, F mm/min, P seconds)\n"
            "G21\nG90\nG17\nG94\n"
            "G0 Z10.000000\n"
            "G0 X-1.000000 Y0.000000\n"
            "G1 Z0 F3000.00000\n"
            "G1 X1.000000 Y0.000000 F120.000000\n"
            "G1 X2.000000 Y0.000000 F60.0000000\n"
            "G1 X2.000000 Y2.000000 F60.0000000\n"
            "G1 X2.000000 Y6.000000 F34.2857142\n"
            "G0 Z10.000000\n"
            "G0 X-5.000000 Y0.000000\n"
            "G1 Z0 F3000.00000\n"
            "G4 P0.333333333\n"
            "G0 Z10.000000\n"
            "M2\n");
  const std::string per_minute = gcode_text(program, options_for(GcodeDialect::G93PerMinute));
  expect_contains(per_minute, "gcode=g93-per-minute, g4=seconds");
  expect_contains(per_minute, "G93\nG0 Z10.000000\n");
  expect_contains(per_minute, "G1 Z0 F300.000000\n");                   // 10 mm at 3000 mm/min: 0.2 s
  expect_contains(per_minute, "G1 X2.000000 Y6.000000 F8.57142857\n");  // 60 / 7, down
  const std::string seconds = gcode_text(program, options_for(GcodeDialect::G93Seconds));
  expect_contains(seconds, "gcode=g93-seconds, g4=seconds");
  expect_contains(seconds, "G1 Z0 F0.200000000\n");
  expect_contains(seconds, "G1 X2.000000 Y6.000000 F7.00000000\n");
}

TEST(Gcode, ReadsBackAsThePlannedProgramInEveryDialectAndMotion) {
  for (const Motion motion : {Motion::Moving, Motion::Stop}) {
    const Program planned = program_of(winding_path(), winding_dwells(motion), motion, 50.0);
    for (const GcodeDialect dialect : kDialects) {
      const Program whole = read_gcode(gcode_text(planned, options_for(dialect)), "program.nc", {});
      EXPECT_EQ(whole.file, "program.nc");
      const Program read = without_plunges(whole);
      ASSERT_EQ(read.steps.size(), planned.steps.size()) << to_string(dialect);
      for (std::size_t i = 0; i < read.steps.size(); ++i) {
        const ProgramStep& was = planned.steps[i];
        EXPECT_LE(distance(read.steps[i].start, was.start), 0.51e-6 * std::sqrt(2.0)) << i;
        EXPECT_LE(distance(read.steps[i].finish, was.finish), 0.51e-6 * std::sqrt(2.0)) << i;
        EXPECT_LE(std::abs(read.steps[i].seconds - was.seconds), 1e-6 * was.seconds) << i << to_string(dialect);
        EXPECT_EQ(read.steps[i].removes, was.removes) << i;
      }
      // The tool comes down three times, 10 mm at 50 mm/s.
      EXPECT_EQ(whole.steps.size() - read.steps.size(), 3u);
      EXPECT_LE(std::abs(whole.total_seconds() - planned.total_seconds() - 3 * 0.2), 1e-6 * planned.total_seconds());
    }
  }
}

TEST(Gcode, SaysTheSameAsTheFeedTable) {
  const FeedTable table = feed_table_of(winding_path(), winding_dwells(Motion::Moving), Motion::Moving, kMaxFeedPerMin);
  const Program planned = program_of(table);
  for (const GcodeDialect dialect : kDialects) {
    const Program read = without_plunges(read_gcode(gcode_text(planned, options_for(dialect)), "program.nc", {}));
    ASSERT_EQ(read.steps.size(), planned.steps.size());
    for (std::size_t i = 0; i < read.steps.size(); ++i) {
      EXPECT_LE(distance(read.steps[i].finish, planned.steps[i].finish), 0.51e-6 * std::sqrt(2.0)) << i;
      EXPECT_LE(std::abs(read.steps[i].seconds - planned.steps[i].seconds), 1e-6 * planned.steps[i].seconds) << i;
    }
  }
}

TEST(Gcode, NeverExceedsMaximumFeedWhenEveryStepIsAtTheLimit) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double max_feed = 1234.56789;
  for (const GcodeDialect dialect : kDialects) {
    for (const double scale : {100.0, 1.0, 1e-2, 1e-4}) {
      Program program;
      Point at{0.3, 0.7};
      for (int i = 0; i < 300; ++i) {
        const Point to{scale * uniform(random), scale * uniform(random)};
        program.steps.push_back({at, to, distance(at, to) / (max_feed / 60.0), true});
        at = to;
      }
      const Program read = read_gcode(gcode_text(program, options_for(dialect, max_feed)), "program.nc", {});
      double fastest = 0.0;
      for (const ProgramStep& step : read.steps) {
        fastest = std::max(fastest, step.length() > 0.0 ? step.length() / step.seconds * 60.0 : 0.0);
      }
      EXPECT_LE(fastest, max_feed * (1.0 + 1e-14)) << to_string(dialect) << scale;
      EXPECT_GE(fastest, max_feed * (1.0 - 1e-7)) << to_string(dialect) << scale;
    }
  }
}

TEST(Gcode, NeverUsesAnExponentOrMinusZero) {
  Program program;
  program.steps = {
      {{-1e-9, 0}, {1e-5, 0}, 4e4, true}, {{1e-5, 0}, {1e-5, 0}, 3e-7, true}, {{1e-5, 0}, {123456.5, 0}, 1e7, true}};
  for (const GcodeDialect dialect : kDialects) {
    const std::string text = gcode_text(program, options_for(dialect));
    const std::string body = text.substr(text.rfind(')'));
    EXPECT_EQ(body.find('e'), std::string::npos) << body;
    EXPECT_EQ(body.find("-0.000000"), std::string::npos) << body;
    const Program read = without_plunges(read_gcode(text, "program.nc", {}));
    ASSERT_EQ(read.steps.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE(std::abs(read.steps[i].seconds - program.steps[i].seconds), 1e-6 * program.steps[i].seconds) << body;
    }
  }
}

TEST(Gcode, KeepsTheTimeOfAStepThatRoundingLeavesWithoutLength) {
  Program program;
  program.steps = {{{1, 2}, {1 + 2e-7, 2}, 0.5, true}, {{1 + 2e-7, 2}, {3, 2}, 1.5, true}};
  const Program read = without_plunges(read_gcode(gcode_text(program, options_for(GcodeDialect::G94)), "p.nc", {}));
  ASSERT_EQ(read.steps.size(), 2u);
  EXPECT_EQ(read.steps[0].start, read.steps[0].finish);
  EXPECT_TRUE(read.steps[0].removes);
  EXPECT_DOUBLE_EQ(read.steps[0].seconds, 0.5);
}

TEST(Gcode, RefusesEveryTruncation) {
  const Program planned = program_of(winding_path(), winding_dwells(Motion::Moving), Motion::Moving, 50.0);
  const std::string text = gcode_text(planned, options_for(GcodeDialect::G93Seconds));
  for (std::size_t size = 0; size + 1 < text.size(); ++size) {
    EXPECT_THROW(read_gcode(text.substr(0, size), "program.nc", {}), InputError) << size;
  }
  const std::string cut = text.substr(0, text.size() - 3);
  const std::string message = input_error([&cut] { read_gcode(cut, "program.nc", {}); });
  expect_contains(message, "program.nc: ends at line ");
  expect_contains(message, "without M2 or M30; the program is truncated");
}

TEST(Gcode, RefusesFaultyPrograms) {
  const auto faulty = [](std::vector<ProgramStep> steps) {
    Program program;
    program.steps = std::move(steps);
    EXPECT_THROW(gcode_text(program, options_for(GcodeDialect::G94)), std::logic_error);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  faulty({{{0, 0}, {1, 0}, 1.0, true}, {{1.1, 0}, {2, 0}, 1.0, true}});  // a gap
  faulty({{{0, 0}, {1, 0}, 1.0, true}, {{2, 0}, {3, 0}, 0.0, false}});   // a gap before a lifted step
  faulty({{{0, 0}, {1, 0}, 0.0, true}});                                 // no time
  faulty({{{0, 0}, {1, 0}, 0.019, true}});                               // above maximum feed
  faulty({{{0, 0}, {1, 0}, nan, true}});
  faulty({{{0, 0}, {0, 0}, nan, true}});
  faulty({{{0, 0}, {nan, 0}, 1.0, true}});
  faulty({{{0, 0}, {1, 0}, 1.0, false}});  // a rapid with a duration
  faulty({{{0, 0}, {1, 0}, nan, false}});
}

TEST(Gcode, RefusesBadOptions) {
  const Program program = program_of({"file", {{0, 0}}, {1}}, {1.0}, Motion::Moving, 50.0);
  const auto message = [&program](double max_feed, double lift) {
    GcodeOptions options = options_for(GcodeDialect::G94, max_feed);
    options.lift_height_mm = lift;
    return input_error([&] { gcode_text(program, options); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(0.0, 10.0), "maximum feed = 0 mm/min; required finite and > 0");
  EXPECT_EQ(message(nan, 10.0), "maximum feed = nan mm/min; required finite and > 0");
  EXPECT_EQ(message(1.0, 0.0), "lift height = 0 mm; required finite and >= 1e-6");
  EXPECT_EQ(message(1.0, nan), "lift height = nan mm; required finite and >= 1e-6");
}

TEST(GcodeDialect, ParsesItsWords) {
  for (const GcodeDialect dialect : kDialects) EXPECT_EQ(parse_gcode_dialect(to_string(dialect)), dialect);
  EXPECT_EQ(to_string(GcodeDialect::G93Seconds), "g93-seconds");
  EXPECT_EQ(input_error([] { parse_gcode_dialect("g95"); }),
            "gcode = \"g95\"; accepted: g94, g93-per-minute, g93-seconds");
}

}  // namespace
}  // namespace dwell
