#include "paths/path_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

class PathFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    file_ = std::filesystem::path(::testing::TempDir()) / (std::string("dwell_path_file_") + info->name() + ".csv");
  }
  void TearDown() override { std::filesystem::remove(file_); }

  ToolPath read(const std::string& text) {
    std::ofstream(file_, std::ios::binary) << text;
    return read_path_file(file_);
  }
  /// The message without the name of the file, which it must start with.
  std::string message(const std::string& text) {
    const std::string full = test::message_of([&] { read(text); });
    const std::string start = file_.string() + ": ";
    EXPECT_TRUE(full.starts_with(start)) << full;
    return full.substr(std::min(full.size(), start.size()));
  }

  std::filesystem::path file_;
};

TEST_F(PathFile, ReadsPoints) {
  const ToolPath path = read("x_mm,y_mm\n1,2\n-3.5,4e-1\n");
  EXPECT_EQ(path.kind, "file");
  EXPECT_EQ(path.points, (std::vector<Point>{{1, 2}, {-3.5, 0.4}}));
  EXPECT_EQ(path.lifted, (std::vector<char>{1, 0}));
}

TEST_F(PathFile, ColumnsInAnyOrderOthersIgnoredCommentsBlankLinesAndLineEnds) {
  const ToolPath path = read(
      "\xEF\xBB\xBF# made by hand\r\n lift , dwell_s,y_mm, x_mm \r\n0,0.5,20,10\r\n\r\n# pause\r\n1,text,21, "
      "+11\r\n0,,22,12");
  EXPECT_EQ(path.points, (std::vector<Point>{{10, 20}, {11, 21}, {12, 22}}));
  EXPECT_EQ(path.lifted, (std::vector<char>{1, 1, 0}));
}

TEST_F(PathFile, RepeatedPointsBecomeHalts) {
  const ToolPath path = read("x_mm,y_mm\n0,0\n1,0\n1,0\n1,0\n2,0\n");
  const std::vector<Stroke> strokes = moving_strokes(path);
  EXPECT_EQ(strokes[1].length(), 0.5);
  EXPECT_EQ(strokes[2].length(), 0.0);
  EXPECT_EQ(strokes[3].length(), 0.5);
}

TEST_F(PathFile, RefusesAMissingHeader) {
  EXPECT_EQ(message("1,2\n3,4\n"), "line 1: header \"1,2\"; it must name columns x_mm,y_mm[,lift]");
  EXPECT_EQ(message("# note\nx,y\n3,4\n"), "line 2: header \"x,y\"; it must name columns x_mm,y_mm[,lift]");
  EXPECT_EQ(message(std::string("\x93NUMPY\x01\x00 v", 10)),
            "line 1: header \"?NUMPY?? v\"; it must name columns x_mm,y_mm[,lift]");
  EXPECT_EQ(message(""), "no header line; the first line must name columns x_mm,y_mm[,lift]");
  EXPECT_EQ(message("# only\n\n"), "no header line; the first line must name columns x_mm,y_mm[,lift]");
  EXPECT_EQ(message("x_mm,y_mm,x_mm\n1,2,3\n"), "line 1: column x_mm is named twice; required once");
}

TEST_F(PathFile, RefusesBadLines) {
  EXPECT_EQ(message("x_mm,y_mm\n"), "no dwell point follows the header; at least one is required");
  EXPECT_EQ(message("x_mm,y_mm\n1,2\n3\n"), "line 3 has 1 column; the header has 2");
  EXPECT_EQ(message("x_mm,y_mm\n1,2,3\n"), "line 2 has 3 columns; the header has 2");
  EXPECT_EQ(message("x_mm,y_mm\n1,two\n"), "line 2: y_mm = \"two\"; required: a finite number");
  EXPECT_EQ(message("x_mm,y_mm\nnan,2\n"), "line 2: x_mm = \"nan\"; required: a finite number");
  EXPECT_EQ(message("x_mm,y_mm\n1,2\n#N/A,2\n"), "line 3: x_mm = \"#N/A\"; required: a finite number");
  EXPECT_EQ(message("x_mm,y_mm\n1,-inf\n"), "line 2: y_mm = \"-inf\"; required: a finite number");
  EXPECT_EQ(message("x_mm,y_mm\n,2\n"), "line 2: x_mm = \"\"; required: a finite number");
  EXPECT_EQ(message("x_mm,y_mm,lift\n1,2,0\n\n1,2,yes\n"), "line 4: lift = \"yes\"; required: 0 or 1");
  EXPECT_EQ(message("x_mm,y_mm,lift\n1,2,0.5\n"), "line 2: lift = \"0.5\"; required: 0 or 1");
  EXPECT_EQ(message("x_mm,y_mm,lift\n1,2,nan\n"), "line 2: lift = \"nan\"; required: 0 or 1");
}

TEST_F(PathFile, RefusesAFileThatIsNotThere) {
  const std::string text = test::message_of([&] { read_path_file(file_); });
  EXPECT_NE(text.find(file_.string()), std::string::npos) << text;
}

TEST_F(PathFile, RefusesACommentThatNamesAnotherUnitOrPlace) {
  for (const std::string comment : {"# unit: steps", "#Units=pulses", "# origin: 5,5", "# scale_factor = 2"}) {
    EXPECT_EQ(message(comment + "\nx_mm,y_mm\n1,2\n"),
              "line 1: comment \"" + comment.substr(comment[1] == ' ' ? 2 : 1) +
                  "\" may change what the coordinates mean; accepted: mm, in the map's coordinates");
  }
  for (const std::string comment : {"unit: um", "Units=inch", "x unit: m", "coordinates in um", "x_um y_um", "inch"}) {
    const std::string text = message("x_mm,y_mm\n# " + comment + "\n1,2\n");
    EXPECT_TRUE(text.starts_with("line 2: \"")) << text;
    EXPECT_NE(text.find("in the comment \"" + comment +
                        "\" looks like another unit; accepted: x_mm and y_mm in mm, or the comment without a unit"),
              std::string::npos)
        << text;
  }
  // The header of a feed table, which may be read as a path, and remarks.
  EXPECT_EQ(read("# unit: mm\n# units: x_mm and y_mm mm, dwell_s s, feed_mm_per_min mm/min\n# made: by hand\n"
                 "# lines of 2 mm\n# input: map x in um.csv sha256=00\nx_mm,y_mm\n1,2\n")
                .size(),
            1u);
}

TEST_F(PathFile, RefusesACommentThatNamesOtherPlaces) {
  const auto text = [](const std::string& comment) { return "# " + comment + "\nx_mm,y_mm\n1,2\n"; };
  for (const char* comment : {"y axis down", "rotated by 90 deg", "pixels", "x and y in pixels", "shifted by 3 mm",
                              "mirrored", "scaled by 2", "viewed from the back"}) {
    const std::string said = message(text(comment));
    EXPECT_TRUE(said.starts_with("line 1: the comment \"" + std::string(comment) + "\" looks like")) << said;
  }
  for (const char* comment : {"3 pixels wide", "the first of 3 paths", "rotated by 0 deg", "option: map_rows = top",
                              "path: raster", "overlap 20 %", "in order of the run"}) {
    EXPECT_EQ(parse_path_text(text(comment), "p.csv").points.size(), 1u) << comment;
  }
}

TEST_F(PathFile, RefusesAColumnOfAlmostTheName) {
  for (const std::string column : {"Lift", "lifted", "LIFT", "X_mm"}) {
    EXPECT_EQ(
        message("x_mm,y_mm," + column + "\n1,2,1\n"),
        "line 1: column \"" + column + "\"; accepted: x_mm, y_mm, lift, exactly so, and columns of other meaning");
  }
}

}  // namespace
}  // namespace dwell
