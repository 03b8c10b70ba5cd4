#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "paths/feed/plan_program.h"
#include "runs/programs/feed_table.h"
#include "tests/runs/programs/program_cases.h"

namespace dwell {
namespace {

using program_cases::expect_contains;
using program_cases::input_error;
using program_cases::kMaxFeedPerMin;
using program_cases::replaced;
using program_cases::TestFile;
using program_cases::winding_dwells;
using program_cases::winding_path;

FeedTable winding_table(Motion motion) {
  FeedTable table = feed_table_of(winding_path(), winding_dwells(motion), motion, kMaxFeedPerMin);
  table.version = "0.1.0";
  table.inputs = {{"map my mirror.csv", "0123abcd"}, {"tif spot.csv", "4567ef01"}};
  return table;
}

std::string refused(const std::string& text) {
  const TestFile file("feed.csv", text);
  const std::string message = input_error([&file] { read_feed_table(file.path()); });
  expect_contains(message, file.path().string());
  return message;
}

TEST(FeedTable, WritesTheDocumentedText) {
  const ToolPath path{"raster", {{0, 0}, {2, 0}, {2, 4}, {-5, 0}}, {1, 0, 0, 1}};
  FeedTable table = feed_table_of(path, {1.0, 3.0, 7.0, 1.0 / 3.0}, Motion::Moving, 3000.0);
  table.version = "0.1.0";
  table.inputs = {{"map mirror.csv", "0123abcd"}};
  EXPECT_EQ(feed_table_text(table),
            "# dwell 0.1.0\n"
            "# motion: moving\n"
            "# max_feed_mm_per_min: 3000\n"
            "# path: raster\n"
            "# rows: 4\n"
            "# total_dwell_s: 11.333333333\n"
            "# units: x_mm and y_mm mm, dwell_s s, feed_mm_per_min mm/min\n"
            "# input: map mirror.csv sha256=0123abcd\n"
            "sequence,x_mm,y_mm,dwell_s,feed_mm_per_min,lift\n"
            "1,0.000000,0.000000,1.00000000,120.000000,1\n"
            "2,2.000000,0.000000,3.00000000,60.0000000,0\n"
            "3,2.000000,4.000000,7.00000000,34.2857142,0\n"
            "4,-5.000000,0.000000,0.333333333,0,1\n");
}

TEST(FeedTable, ReadsBackEqual) {
  for (const Motion motion : {Motion::Moving, Motion::Stop}) {
    const FeedTable table = winding_table(motion);
    const TestFile file("feed.csv", feed_table_text(table));
    const FeedTable back = read_feed_table(file.path());
    EXPECT_EQ(back.path.points, table.path.points);
    EXPECT_EQ(back.path.lifted, table.path.lifted);
    EXPECT_EQ(back.path.kind, "file");
    EXPECT_EQ(back.dwell_s, table.dwell_s);
    EXPECT_EQ(back.feed_mm_per_min, table.feed_mm_per_min);
    EXPECT_EQ(back.motion, motion);
    EXPECT_EQ(back.max_feed_mm_per_min, kMaxFeedPerMin);
    EXPECT_EQ(back.version, "0.1.0");
    EXPECT_EQ(back.inputs, table.inputs);
  }
}

TEST(FeedTable, HoldsThePlannedProgramWithinItsRounding) {
  for (const Motion motion : {Motion::Moving, Motion::Stop}) {
    const Program planned = program_of(winding_path(), winding_dwells(motion), motion, 50.0);
    const TestFile file("feed.csv", feed_table_text(winding_table(motion)));
    const Program read = program_of(read_feed_table(file.path()));
    ASSERT_EQ(read.steps.size(), planned.steps.size());
    for (std::size_t i = 0; i < read.steps.size(); ++i) {
      // Coordinates of points are rounded to 1e-6 mm; an extrapolated end is off by three times that half unit.
      EXPECT_LE(distance(read.steps[i].start, planned.steps[i].start), 1.5e-6 * std::sqrt(2.0)) << i;
      EXPECT_LE(distance(read.steps[i].finish, planned.steps[i].finish), 1.5e-6 * std::sqrt(2.0)) << i;
      // A dwell is right to 5e-9; its division between two halves of a stroke follows the rounded lengths.
      EXPECT_LE(std::abs(read.steps[i].seconds - planned.steps[i].seconds), 3e-6 * planned.steps[i].seconds) << i;
      EXPECT_EQ(read.steps[i].removes, planned.steps[i].removes) << i;
    }
    EXPECT_LE(std::abs(read.total_seconds() - planned.total_seconds()), 1e-7 * planned.total_seconds());
  }
}

TEST(FeedTable, NeverExceedsMaximumFeedWhenEveryStrokeIsAtTheLimit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-50.0, 50.0);
  const double max_feed = 1234.56789;
  for (int trial = 0; trial < 200; ++trial) {
    ToolPath path{"file", {}, {}};
    for (int j = 0; j < 20; ++j) {
      const double scale = trial % 2 == 0 ? 1.0 : 1e-4;  // long and very short strokes
      path.points.push_back({scale * uniform(random), scale * uniform(random)});
      path.lifted.push_back(j % 7 == 0);
    }
    std::vector<double> dwell;
    for (const Stroke& stroke : moving_strokes(path)) dwell.push_back(stroke.length() / (max_feed / 60.0));
    const FeedTable table = feed_table_of(path, dwell, Motion::Moving, max_feed);
    const std::vector<Stroke> strokes = moving_strokes(table.path);
    for (std::size_t j = 0; j < strokes.size(); ++j) {
      EXPECT_LE(table.feed_mm_per_min[j], max_feed);
      EXPECT_LE(strokes[j].length() / table.dwell_s[j] * 60.0, max_feed * (1.0 + 1e-14));
    }
    const TestFile file("feed.csv", feed_table_text(table));
    EXPECT_EQ(read_feed_table(file.path()).dwell_s, table.dwell_s);
  }
}

TEST(FeedTable, AcceptsATableThatWasNotRoundedFirst) {
  FeedTable table = winding_table(Motion::Moving);
  table.path = winding_path();
  table.path.points[3].x = 2.12345674999;
  table.dwell_s = winding_dwells(Motion::Moving);
  const std::vector<Stroke> strokes = moving_strokes(table.path);
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    table.dwell_s[j] += 1e-10;
    table.feed_mm_per_min[j] = std::min(60.0 * strokes[j].length() / table.dwell_s[j], kMaxFeedPerMin);
  }
  const TestFile file("feed.csv", feed_table_text(table));
  EXPECT_EQ(read_feed_table(file.path()).path.size(), 8u);
}

TEST(FeedTable, RefusesEveryTruncation) {
  const std::string text = feed_table_text(winding_table(Motion::Stop));
  for (std::size_t size = 0; size + 1 < text.size(); ++size) {
    const TestFile file("feed.csv", text.substr(0, size));
    EXPECT_THROW(read_feed_table(file.path()), InputError) << size;
  }
  const TestFile whole("feed.csv", text.substr(0, text.size() - 1));  // no newline at the end: nothing is lost
  EXPECT_EQ(read_feed_table(whole.path()).path.size(), 8u);
}

TEST(FeedTable, RefusesTamperedNumbersNamingTheLine) {
  const std::string text = feed_table_text(winding_table(Motion::Moving));
  expect_contains(text, "\n2,1.300000,0.400000,0.333333333,241.4953");  // line 12
  expect_contains(refused(replaced(text, "\n2,1.300000", "\n2,1.300100")), "line 11: feed_mm_per_min");
  expect_contains(refused(replaced(text, "241.4953", "241.4963")), "line 12: feed_mm_per_min = 241.496");
  expect_contains(refused(replaced(text, ",0.333333333,", ",0.333343333,")), "but the header says total_dwell_s");
  expect_contains(refused(replaced(text, ",0.333333333,241.4953", ",0.000000000,241.4953")), "total_dwell_s");
  expect_contains(refused(replaced(text, "max_feed_mm_per_min: 3000", "max_feed_mm_per_min: 200")),
                  "allows at most 200");
  expect_contains(refused(replaced(text, "motion: moving", "motion: stop")), "line 11: feed_mm_per_min");
  // A lift moved elsewhere changes the strokes.
  expect_contains(refused(replaced(text, "0,1\n6,", "0,0\n6,")), "feed_mm_per_min");
  const std::string stop = feed_table_text(winding_table(Motion::Stop));
  expect_contains(refused(replaced(stop, "2.00000000,", "2.10000000,")), "dwell_s adds up to");
}

TEST(FeedTable, RefusesBadRowsNamingTheLine) {
  const std::string text = feed_table_text(winding_table(Motion::Moving));
  expect_contains(refused(replaced(text, "\n2,", "\n3,")), "line 12: sequence = \"3\"; required 2");
  expect_contains(refused(replaced(text, "\n2,", "\nx,")), "line 12: sequence = \"x\"; required 2");
  expect_contains(refused(replaced(text, "\n2,1.300000", "\n2,nan")),
                  "line 12: x_mm = \"nan\"; required a finite number");
  expect_contains(refused(replaced(text, ",0.400000,", ",inf,")), "line 12: y_mm = \"inf\"");
  expect_contains(refused(replaced(text, ",0.400000,", ",0.4 mm,")), "line 12: y_mm = \"0.4 mm\"");
  expect_contains(refused(replaced(text, ",0.333333333,", ",-0.333333333,")),
                  "line 12: dwell_s = -0.333333333; required a number from 0 to 1e+08 (s)");
  expect_contains(refused(replaced(text, ",0.333333333,", ",,")), "line 12: dwell_s = \"\"");
  expect_contains(refused(replaced(text, "241.4953", "-241.4953")), "line 12: feed_mm_per_min = -241.4953");
  expect_contains(refused(replaced(text, ",0\n3,", ",2\n3,")), "line 12: lift = \"2\"; accepted: 0, 1");
  expect_contains(refused(replaced(text, ",0\n3,", ",0,0\n3,")), "has more than 6 columns");
  expect_contains(refused(replaced(text, ",0\n3,", "\n3,")), "has 5 of 6 columns");
}

TEST(FeedTable, RefusesBadHeadersNamingTheLine) {
  const std::string text = feed_table_text(winding_table(Motion::Moving));
  expect_contains(refused(replaced(text, "# motion: moving\n", "")), "\"# motion: moving|stop\" is missing");
  expect_contains(refused(replaced(text, "motion: moving", "motion: walking")),
                  "line 2: motion = \"walking\"; accepted: moving, stop");
  expect_contains(refused(replaced(text, "# max_feed_mm_per_min: 3000\n", "")),
                  "\"# max_feed_mm_per_min: NUMBER\" is missing");
  expect_contains(refused(replaced(text, "min: 3000", "min: 0")),
                  "line 3: max_feed_mm_per_min = 0; required a number from 0.01");
  expect_contains(refused(replaced(text, "min: 3000", "min: nan")), "line 3: max_feed_mm_per_min = \"nan\"");
  expect_contains(refused(replaced(text, "# rows: 8\n", "")), "\"# rows: NUMBER\" is missing");
  expect_contains(refused(replaced(text, "rows: 8", "rows: 9")), "8 rows, but the header says 9");
  expect_contains(refused(replaced(text, "rows: 8", "rows: 7")), "8 rows, but the header says 7");
  expect_contains(refused(replaced(text, "rows: 8", "rows: many")), "line 5: rows = many; required a whole number");
  expect_contains(refused(replaced(text, "# total_dwell_s", "# total")), "\"# total_dwell_s: NUMBER\" is missing");
  expect_contains(refused(replaced(text, "x_mm,y_mm,dwell_s,feed", "y_mm,x_mm,dwell_s,feed")),
                  "line 10: column line \"sequence,y_mm,x_mm");
  expect_contains(refused(replaced(text, " sha256=", " md5=")), "line 8: input");
  expect_contains(refused("# dwell 0.1.0\n"), "no column line");
}

TEST(FeedTable, RefusesHeaderLinesThatMayChangeTheNumbers) {
  const std::string text = feed_table_text(winding_table(Motion::Moving));
  for (const char* line : {"# unit: um", "# Units = mm, ms", "#x_unit:inch", "# max_feed_mm_per_s: 50", "# scale: 2",
                           "# Origin_mm: 5,5", "# lift height: 3"}) {
    expect_contains(refused(replaced(text, "# rows", std::string(line) + "\n# rows")), "line 5: header line");
  }
  expect_contains(refused(replaced(text, "feed_mm_per_min mm/min\n", "feed_mm_per_min m/min\n")),
                  "may change what the numbers mean");
  expect_contains(refused(replaced(text, "# rows", "# motion: stop\n# rows")),
                  "is the second header line of this name");
  for (const char* line : {"# feed in mm/s", "# x in um", "# made by: hand, in inches", "# dwell in ms"}) {
    const std::string message = refused(replaced(text, "# rows", std::string(line) + "\n# rows"));
    expect_contains(message, "line 5: \"");
    expect_contains(message, "looks like another unit; accepted: x_mm and y_mm mm, dwell_s s, feed_mm_per_min mm/min");
  }
  for (const char* line : {"# y axis down", "# made by: hand, rotated by 90 deg", "# x and y in pixels"}) {
    const std::string message = refused(replaced(text, "# rows", std::string(line) + "\n# rows"));
    expect_contains(message, "line 5: the comment \"");
    expect_contains(message, "accepted: x_mm and y_mm mm");
  }
  // Blanks and signs are free, and so are remarks.
  const TestFile file("feed.csv",
                      replaced(replaced(text, "# rows: ", "# made by: Meier\n# a remark: with a colon\n#rows="),
                               "# motion: moving", "#  motion:moving"));
  EXPECT_EQ(read_feed_table(file.path()).path.size(), 8u);
}

TEST(FeedTable, RefusesTimesAndFeedsBeyondAnyMachine) {
  const std::string text = feed_table_text(winding_table(Motion::Moving));
  expect_contains(refused(replaced(text, ",0.333333333,", ",1e300,")), "dwell_s = 1e300; required a number from 0 to");
  expect_contains(refused(replaced(text, "241.4953", "1e300241.4953")), "feed_mm_per_min");
  expect_contains(refused(replaced(text, "min: 3000", "min: 1e300")), "max_feed_mm_per_min = 1e300; required a number");
}

TEST(FeedTable, WritesNoHeaderFieldOverTwoLines) {
  FeedTable table = winding_table(Motion::Moving);
  table.inputs = {{"map a\nb.csv", "00"}};
  const TestFile file("feed.csv", feed_table_text(table));
  EXPECT_EQ(read_feed_table(file.path()).inputs[0].first, "map a?b.csv");
}

TEST(FeedTable, RefusesToWriteWhatItCouldNotRead) {
  FeedTable table = winding_table(Motion::Moving);
  table.dwell_s[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(feed_table_text(table), std::logic_error);
  table.dwell_s.pop_back();
  EXPECT_THROW(feed_table_text(table), std::logic_error);
  EXPECT_THROW(feed_table_of(winding_path(), {1.0}, Motion::Moving, 3000.0), InputError);
}

}  // namespace
}  // namespace dwell
