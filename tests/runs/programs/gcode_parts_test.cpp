/// G-code in files of so many lines: together they are the whole program and the ways between.

#include "runs/programs/gcode_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/program_formats.h"
#include "tests/runs/programs/program_cases.h"

namespace dwell {
namespace {

using program_cases::input_error;
using program_cases::replaced;

constexpr double kPartsMaxFeed = 1200.0;  // [mm/min]

/// Lines of a raster with turns, one lift and a halt; no symmetry.
Program meander() {
  Program program;
  Point at{-3.0, 0.5};
  const auto move = [&](Point to, double seconds, bool removes = true) {
    program.steps.push_back({at, to, seconds, removes});
    at = to;
  };
  for (int row = 0; row < 6; ++row) {
    for (int k = 0; k < 12; ++k) move(at + Point{row % 2 == 0 ? 0.5 : -0.5, 0.0}, 0.1 + 0.01 * k + 0.03 * row);
    if (row == 2) move(at + Point{4.0, 3.0}, 0.0, false);
    move(at + Point{0.1, 0.75}, 0.2);
    if (row == 4) move(at, 0.4375);
  }
  return program;
}

GcodeOptions parts_options() {
  GcodeOptions options;
  options.max_feed_mm_per_min = kPartsMaxFeed;
  options.lift_height_mm = 8.0;
  options.header = {"dwell 0.0"};
  return options;
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

ReadBeside beside(const std::vector<WrittenProgram>& files) {
  return [&files](const std::string& name) {
    for (const WrittenProgram& file : files) {
      if (file.file == name) return file.bytes;
    }
    return std::string("M2\n");
  };
}

Program read_back_parts(const std::vector<WrittenProgram>& files) {
  return parse_gcode_part_list(files.front().bytes, files.front().file, {}, beside(files));
}

std::vector<ProgramStep> removing(const Program& program) {
  std::vector<ProgramStep> steps = program.steps;
  std::erase_if(steps, [](const ProgramStep& step) { return !step.removes; });
  return steps;
}

TEST(GcodeParts, AreTogetherTheProgramAndTheWaysBetween) {
  for (const GcodeDialect dialect : {GcodeDialect::G94, GcodeDialect::G93PerMinute, GcodeDialect::G93Seconds}) {
    GcodeOptions options = parts_options();
    options.dialect = dialect;
    options.style.path_mode = PathMode{};
    options.style.before = {"M3 S1000"};
    options.style.after = {"M5"};
    options.style.block_numbers = 10;
    Program program = meander();
    program.frame = ProgramFrame({1.5, -2.0}, 30.0, true);
    const Program whole = read_gcode(gcode_text(program, options), "whole", {});
    for (const std::size_t most : {26, 31, 40, 57, 200}) {
      SCOPED_TRACE(most);
      const std::vector<WrittenProgram> files = written_gcode_parts(program, options, most, {});
      const std::size_t parts = files.size() - 1;
      EXPECT_TRUE(most != 200 || parts == 1U) << parts;
      EXPECT_TRUE(most >= 50 || parts >= 3U) << parts;
      for (std::size_t k = 1; k < files.size(); ++k) {
        EXPECT_LE(line_count(files[k].bytes), most);
        const Program part = read_gcode(files[k].bytes, files[k].file, {});  // stands alone
        EXPECT_EQ(part.frame, program.frame);
        ASSERT_EQ(part.path_modes.size(), 1U);
        EXPECT_NE(files[k].bytes.find("M3 S1000\n"), std::string::npos);
        EXPECT_NE(files[k].bytes.find("M5\n"), std::string::npos);
      }
      const Program read = read_back_parts(files);
      const std::vector<ProgramStep> a = removing(read), b = removing(whole);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_LE(distance(a[i].start, b[i].start), 1e-9) << i;
        EXPECT_LE(distance(a[i].finish, b[i].finish), 1e-9) << i;
        EXPECT_NEAR(a[i].seconds, b[i].seconds, 1e-12) << i;
      }
      EXPECT_TRUE(same_removing_steps(read, whole, units::mm_per_s(kPartsMaxFeed)));
      // Each cut adds a way up and down, but for one where the tool is lifted in the whole, too.
      const double up = 8.0 / units::mm_per_s(kPartsMaxFeed), more = read.run_seconds() - whole.run_seconds();
      const double pairs = more / (2.0 * up);
      EXPECT_NEAR(pairs, std::round(pairs), 1e-6);
      EXPECT_GE(pairs, static_cast<double>(parts) - 2.0 - 1e-6);
      EXPECT_LE(pairs, static_cast<double>(parts) - 1.0 + 1e-6);
    }
  }
}

TEST(GcodeParts, AreCutWhereTheToolIsLiftedOrTurns) {
  const Program program = meander();
  // The lift is step 38; the lines for 40 steps end behind it.
  const GcodeOptions options = parts_options();
  const std::size_t before = line_count(gcode_text(meander(), options)) - program.steps.size() - 2;
  const std::vector<WrittenProgram> lifted = written_gcode_parts(program, options, before + 44, {});
  const Program first = read_gcode(lifted[1].bytes, "p", {});
  EXPECT_EQ(removing(first).size(), 38U);
  // Lines of 12 steps and one between: turns at 12, 13, 25, 26.
  const std::vector<WrittenProgram> turned = written_gcode_parts(program, options, before + 28, {});
  const std::size_t size = removing(read_gcode(turned[1].bytes, "p", {})).size();
  EXPECT_TRUE(size == 25U || size == 26U) << size;
}

TEST(GcodeParts, RefuseTooFewLines) {
  const std::string message = input_error([] { written_gcode_parts(meander(), parts_options(), 5, {}); });
  EXPECT_NE(message.find("`max lines` = 5: a part with a single step has "), std::string::npos) << message;
}

TEST(GcodeParts, RefuseAnotherList) {
  const std::vector<WrittenProgram> files = written_gcode_parts(meander(), parts_options(), 40, {});
  const std::string& list = files.front().bytes;
  EXPECT_EQ(program_format_of(list)->fuzz, "gcode_parts");
  struct Case {
    std::string what, with, says;
  };
  const std::string count = "# count: " + std::to_string(files.size() - 1);
  for (const Case& c :
       {Case{"file,lines,sha256", "file,sha256", "column line"},
        Case{count, "# count: 77", "count = 77; required the same"},
        Case{"program_002.nc,", "program_009.nc,", "required the file that the list was made with"},
        Case{"program_002.nc,", "../program_002.nc,", "required the name of a file beside this one"},
        Case{"# lift_mm: 8", "# lifted: 8", "lift_mm is missing"}, Case{"# lift_mm: 8", "# lift_mm: x8", "lift_mm = "},
        Case{"# lift_mm", "# lengths in inches\n# lift_mm", "looks like another unit"}}) {
    const std::string other = replaced(list, c.what, c.with);
    const std::string message =
        input_error([&] { parse_gcode_part_list(other, "program_parts.csv", {}, beside(files)); });
    EXPECT_NE(message.find(c.says), std::string::npos) << c.with << ": " << message;
    EXPECT_EQ(message.find("program_parts.csv"), 0U) << message;
  }
}

}  // namespace
}  // namespace dwell
