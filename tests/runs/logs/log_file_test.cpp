#include "runs/logs/log_file.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "core/formats/hdf5_file.h"
#include "core/formats/npy.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

/// What is refused of a text, and why.
std::string refusal(const std::string& text, const LogReading& reading = {}) {
  try {
    parse_log_text(text, "run.csv", reading);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

LogReading columns(const std::string& text, std::optional<double> period = {}) {
  return {parse_log_columns(text), period};
}

/// Three samples of a tool on its way from (1, -2) to (1.5, -4) mm between 0.25 and 0.35 s.
void expect_three(const MotionLog& log) {
  ASSERT_EQ(log.size(), 3u);
  EXPECT_NEAR(log.seconds[0], 0.25, 1e-12);
  EXPECT_NEAR(log.seconds[2], 0.35, 1e-12);
  EXPECT_NEAR(log.period, 0.05, 1e-12);
  EXPECT_NEAR(log.places[0].x, 1.0, 1e-12);
  EXPECT_NEAR(log.places[0].y, -2.0, 1e-12);
  EXPECT_NEAR(log.places[2].x, 1.5, 1e-12);
  EXPECT_NEAR(log.places[2].y, -4.0, 1e-12);
}

TEST(MotionLogFile, ReadsColumnsByNameInAnyOrderUnitAndSeparator) {
  expect_three(parse_log_text("t_s,x_mm,y_mm\n0.25,1,-2\n0.3,1.25,-3\n0.35,1.5,-4\n", "run.csv"));
  expect_three(parse_log_text(
      "# y_um;state;Time [ms];x (mm)\r\n-2000;RUN;250;1\r\n-3000;RUN;300;1.25\r\n-4000;END;350;1.5\r\n", "run.csv"));
  expect_three(parse_log_text("\"time\"\t\"y\"\t\"x\"\nms\tcm\tum\n250\t-0.2\t1000\n300\t-0.3\t1250\n350\t-0.4\t1500\n",
                              "run.txt"));
  expect_three(
      parse_log_text("X/um   Y/mm  t/min\n1000 -2 0.00416666666666666667\n1250 -3 0.005\n1500 -4 "
                     "0.00583333333333333333\n",
                     "run.txt"));
  const MotionLog bare = parse_log_text("0.25 1 -2\n0.3 1.25 -3\n0.35 1.5 -4", "run.txt");
  expect_three(bare);
  ASSERT_EQ(bare.notes.size(), 1u);
  EXPECT_EQ(bare.notes[0], "the file says no unit of time and places: taken as s and mm");
}

TEST(MotionLogFile, ReadsColumnsThatTheUserNames) {
  const std::string text = "A,B,C,D\n7,250,1000,-2\n7,300,1250,-3\n8,350,1500,-4\n";
  expect_three(parse_log_text(text, "run.csv", columns("B:ms,C:um,D:mm")));
  expect_three(parse_log_text(text, "run.csv", columns("2:ms,3:um,4:mm")));
  const MotionLog counted =
      parse_log_text("5 1 -2\n6 1.25 -3\n7 1.5 -4\n", "run.txt", columns("1:samples,2:mm,3:mm", 0.05));
  expect_three(counted);
  const MotionLog timeless = parse_log_text("x_mm y_mm\n1 -2\n1.25 -3\n1.5 -4\n", "run.txt", {{}, 0.05});
  ASSERT_EQ(timeless.size(), 3u);
  EXPECT_EQ(timeless.seconds[2], 0.1);
  EXPECT_TRUE(timeless.notes.empty());
}

TEST(MotionLogFile, ReadsArraysAndHdf5) {
  const test::TemporaryFolder folder;
  HeightMap rows(Grid{3, 3, 1.0, 1.0, {}});
  rows.values = {0.25, 1, -2, 0.3, 1.25, -3, 0.35, 1.5, -4};
  folder.file("run.npy", npy_bytes(rows));
  expect_three(read_motion_log(folder.path() / "run.npy"));
  Hdf5Content content;
  content.path = "axes/trace";
  content.rows = 3, content.cols = 4;
  const std::vector<double> values{-2000, 9, 250, 1, -3000, 9, 300, 1.25, -4000, 9, 350, 1.5};
  content.values = values;
  content.lists = {{"columns", {"y_um", "current_A", "t_ms", "x_mm"}}};
  folder.file("run.h5", hdf5_bytes(content));
  expect_three(read_motion_log(folder.path() / "run.h5"));
  expect_three(read_motion_log(folder.path().string() + "/run.h5:/axes/trace"));
  EXPECT_THROW(read_motion_log(folder.path().string() + "/run.h5:/axes/none"), InputError);
}

TEST(MotionLogFile, SaysWhatIsWrongWithTheClock) {
  std::string text = "t_s,x_mm,y_mm\n";
  double ahead = 0.0;
  for (int i = 0; i < 1000; ++i) {
    if (i == 200 || i == 201) continue;  // dropped: the tool is farther by as much
    if (i == 500) ahead = 40.0;          // the clock was set
    if (i == 700) ahead = -1.0;
    text += std::to_string(1.0 + 0.001 * i + ahead) + "," + std::to_string(0.01 * i) + ",0.5\n";
    if (i == 300) text += std::to_string(1.0 + 0.001 * i) + "," + std::to_string(0.01 * i) + ",0.5\n";
  }
  const MotionLog log = parse_log_text(text, "run.csv");
  EXPECT_EQ(log.size(), 998u);
  EXPECT_NEAR(log.period, 1e-3, 1e-9);
  EXPECT_NEAR(log.seconds.back() - log.seconds.front(), 0.999, 1e-6);
  ASSERT_EQ(log.gaps.size(), 1u);
  EXPECT_EQ(log.gaps[0], 199u);
  ASSERT_EQ(log.notes.size(), 3u);
  EXPECT_EQ(log.notes[0], "1 sample repeated, left out");
  EXPECT_EQ(log.notes[1], "2 jumps of the clock taken out, the first by 40 s at 1.499 s");
  EXPECT_EQ(log.notes[2],
            "2 samples missing in 1 place, the first at 1.199 s; the tool is taken to run straight there");
}

TEST(MotionLogFile, LeavesOutALineThatWasCutOff) {
  const MotionLog log = parse_log_text("t_s,x_mm,y_mm\n0.25,1,-2\n0.3,1.25,-3\n0.35,1.5,-4\n0.4,1.7", "run.csv");
  expect_three(log);
  ASSERT_EQ(log.notes.size(), 1u);
  EXPECT_EQ(log.notes[0], "line 5 was cut off and is left out");
}

TEST(MotionLogFile, RefusesByLineColumnAndValue) {
  const auto expect_refused = [](const std::string& text, const std::string& part, const LogReading& reading = {}) {
    EXPECT_NE(refusal(text, reading).find(part), std::string::npos) << refusal(text, reading);
  };
  const std::string rows = "0.25,1,-2\n0.3,1.25,-3\n0.35,1.5,-4\n";
  expect_refused("t_s,x_mm,y_mm\n0.25,1,-2\n0.3,,-3\n0.35,1.5,-4\n",
                 "run.csv: line 3: column \"x_mm\" = ''; a finite number with a decimal point is required");
  expect_refused("t_s,x_mm,y_mm\n0.25,1,-2\n0.3,nan,-3\n0.35,1.5,-4\n", "line 3: column \"x_mm\" = 'nan'");
  expect_refused("t_s;x_mm;y_mm\n1;1;2\n2;1,5;-3\n3;1;2\n", "line 3: column \"x_mm\" = '1,5'");
  expect_refused("t_s,x_mm,y_mm\n0.25,1,-2\n0.3,-3\n0.35,1.5,-4\n", "line 3: 2 columns; the first row has 3");
  expect_refused("t_s,x_mm,y_mm\n0.25,1,-2\n0.3,1,2,-3\n", "line 3: 4 columns; the first row has 3");
  expect_refused("t_s,x_deg,y_mm\n" + rows, "no column clearly holds x among the columns t_s, x_deg, y_mm");
  expect_refused("t_s,x [deg],y_mm\n" + rows, "column \"x [deg]\" has the unit \"deg\"; accepted: mm, um");
  expect_refused("t (rpm),x,y\n" + rows, "column \"t (rpm)\" has the unit \"rpm\"; accepted: s, ms");
  expect_refused("t_s,x_mm,y_mm,xact\n1,2,3,4\n", "more than one column holds x");
  expect_refused("# positions in um\nt,x,y\n" + rows, "line 1: '# positions in um' says the unit");
  EXPECT_EQ(refusal("# positions in um\nt,x,y\n" + rows, columns("t:s,x:um,y:um")), "");
  EXPECT_EQ(refusal("# positions in um\nt_s,x_um,y_um\n" + rows), "");
  expect_refused("t_s,x_mm,y_mm\n" + rows, "says the unit mm, but `log columns` says um; they must agree",
                 columns("t_s:s,x_mm:um,y_mm"));
  expect_refused("a,b,c,d\n1,2,3,4\n", "names \"e\", which is no column", columns("a:s,e:mm,c:mm"));
  expect_refused("a,b,c,d\n1,2,3,4\n", "one column is named for two of time, x and y", columns("a:s,b:mm,b:mm"));
  expect_refused("1,2,3,4\n", "4 columns without names; 3 (time, x, y) are required");
  expect_refused("1,2,3\n", "`log columns` names x and y alone", columns("2,3"));
  expect_refused("n:1,2\n1 2 3\n2 3 4\n3 4 5\n", "counts samples; `log period` is required",
                 columns("1:samples,2:mm,3:mm"));
  expect_refused("t_s,x_mm,y_mm\n" + rows, "`log period` is given as well", {{}, 0.001});
  expect_refused("t_s,x_mm,y_mm\n0.25,1,-2\n", "1 sample; at least 3 are required");
  expect_refused("words only\n", "no line holds two numbers");
  expect_refused("t_s,x_mm,y_mm\n0.3,1,-2\n0.2,1.25,-3\n0.1,1.5,-4\n", "the time never increases");
  std::string coarse = "t_s,x_mm,y_mm\n", jumping = coarse;
  for (int i = 0; i < 100; ++i) {
    coarse += std::to_string(0.01 * (i / 2)) + "," + std::to_string(i) + ",0\n";
    jumping += std::to_string(i % 10 == 9 ? 0.0 : 0.01 * i) + "," + std::to_string(i) + ",0\n";
  }
  expect_refused(coarse, "50 of 100 samples have the time of the one before");
  expect_refused(jumping, "the clock jumps ");
  for (const char* text : {"", "a", "a,b,c,d", "a:,b,c", ",b,c"})
    EXPECT_THROW(parse_log_columns(text), InputError) << text;
}

TEST(MotionLogFile, RefusesFilesOfOtherKinds) {
  const test::TemporaryFolder folder;
  folder.file("empty.csv", "");
  folder.file("a.png", "\x89PNG\r\n\x1a\n....");
  folder.file("bad.npy", "\x93NUMPY");
  for (const char* name : {"empty.csv", "a.png", "bad.npy", "none.csv"})
    EXPECT_THROW(read_motion_log(folder.path() / name), InputError) << name;
}

}  // namespace
}  // namespace dwell
