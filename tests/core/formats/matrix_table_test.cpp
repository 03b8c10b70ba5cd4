#include "core/formats/matrix_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

using test::expect_input_error;

HeightMap read_table(const std::string& text, const std::string& table = "", std::optional<double> pitch = 0.5) {
  const test::TemporaryFolder folder;
  MapReadOptions options;
  if (pitch) options.pitch = square_pitch(*pitch);
  if (!table.empty()) options.table = parse_matrix_table(table);
  return read_map(folder.file("a.csv", text), options);
}

void expect_hint(const std::string& text, std::initializer_list<std::string> words) {
  expect_input_error([&] { read_table(text); }, {"a.csv", "`map table` index", "`map table` heights"});
  expect_input_error([&] { read_table(text); }, words);
}

// As pandas writes a frame, with and without its header, and as others write axes.
const std::string kPandas = ",0,1,2\n0,40.8,-51.1,8.4\n1,-4.3,-40.4,-4.6\n2,4.5,-7.1,-5.6\n3,-7.8,9.6,-4.8\n";
const std::string kAxes = "nan,0.0,0.5,1.0\n2.0,40.8,-51.1,8.4\n2.25,-4.3,-40.4,-4.6\n2.5,4.5,-7.1,-5.6\n";
const std::string kIndexAlone = "1,40.8,-51.1\n2,-4.3,-40.4\n3,4.5,-7.1\n4,-7.8,9.6\n5,2.2,1.1\n";
const std::string kHeaderAlone = "0,10,20,30,40\n40.8,-51.1,8.4,3.3,2.1\n-4.3,-40.4,-4.6,1.2,0.2\n";
const std::string kNumberedCorner =
    "0,0.0,0.5,1.0,1.5\n0,40.8,-51.1,8.4,2\n1,-4.3,-40.4,-4.6,1\n2,4.5,-7.1,-5.6,7\n3,4.4,-7.2,-5.1,3\n";

TEST(MatrixTable, RefusesAnIndexAndCoordinatesWithAHint) {
  expect_hint(kPandas, {"first row (3 numbers from 0 in steps of 1)", "first column (4 numbers from 0"});
  expect_hint(kAxes, {"first row (3 numbers from 0 in steps of 0.5)", "first column (3 numbers from 2"});
  expect_hint(kIndexAlone, {"the first column (5 numbers from 1 in steps of 1)"});
  expect_hint(kHeaderAlone, {"the first row (5 numbers from 0 in steps of 10)"});
  expect_hint(kNumberedCorner, {"first row (4 numbers", "first column (4 numbers"});
}

/// Heights without any order, with coordinates as printed with so many decimals: x of 0.09375, y of 0.0625 mm.
std::string printed_table(const std::string& corner, int decimals, bool row, bool column, bool last = false) {
  constexpr int kRows = 9, kCols = 12;
  std::string text;
  const auto add = [&](const std::string& heading, const std::string& numbers, bool headed) {
    text += !headed ? numbers : last ? numbers + "," + heading : heading + "," + numbers;
    text += "\n";
  };
  std::string x;
  for (int col = 0; col < kCols; ++col) x += fmt::format("{}{:.{}f}", col == 0 ? "" : ",", 0.09375 * col, decimals);
  if (row) add(corner, x, column);
  for (int i = 0; i < kRows; ++i) {
    std::string heights;
    for (int col = 0; col < kCols; ++col) {
      heights += fmt::format("{}{}", col == 0 ? "" : ",", (i * 37 + col * col * 29 + i * i * col * 11) % 101 - 50);
    }
    add(fmt::format("{:.{}f}", 1.0 + 0.0625 * i, decimals), heights, column);
  }
  return text;
}

TEST(MatrixTable, KnowsCoordinatesThatArePrintedWithFewDigits) {
  for (const int decimals : {2, 3, 4}) {
    for (const char* corner : {"", "0", "nan"}) {
      const std::string text = printed_table(corner, decimals, true, true);
      expect_hint(text, {"first row (12 numbers from 0", "first column (9 numbers from 1"});
      const HeightMap map = read_table(text, "mm", std::nullopt);
      EXPECT_EQ(map.grid.rows, 9) << text;
      EXPECT_EQ(map.grid.cols, 12) << text;
      EXPECT_NEAR(map.grid.pitch_x, 0.09375, 1e-3) << text;
      EXPECT_NEAR(map.grid.pitch_y, 0.0625, 1e-3) << text;
      EXPECT_EQ(map.at(0, 1), -21.0);
      EXPECT_EQ(read_table(text, "index", 0.0625).grid, (Grid{9, 12, 0.0625, 0.0625, {}}));
    }
    expect_hint(printed_table("", decimals, true, false), {"the first row (12 numbers from 0"});
    expect_hint(printed_table("", decimals, false, true), {"the first column (9 numbers from 1"});
  }
}

TEST(MatrixTable, RefusesCoordinatesThatStandLast) {
  for (const char* table : {"", "mm", "index"}) {
    for (const bool row : {false, true}) {
      const std::string text = printed_table("nan", 3, row, true, true);
      expect_input_error([&] { read_table(text, table); }, {"the last column (9 numbers from 1", "put it first"});
    }
  }
  EXPECT_EQ(read_table(printed_table("", 3, false, true, true), "heights").grid.cols, 13);
  expect_input_error([] { read_table(printed_table("", 3, true, false), "mm"); }, {"first column", "needed of both"});
}

TEST(MatrixTable, TakesPlanesSmallMapsAndEmptyCornersForHeights) {
  for (const char* text : {
           "1,2,3\n4,5,7\n6,1,9\n",                                  // three numbers in equal steps are an accident
           "0,1,2,3,4,5\n1,2,3,4,5,6\n2,3,4,5,6,7\n",                // a tilted plane
           "nan,1,2,3\n1,2,3,4\n2,3,4,5\n3,4,5,6\n",                 // the same without its corner
           "0,1,2,3,4,5\n",                                          // a single line
           "nan,3,9,4\n2,1,7,3\n5,6,2,8\n",                          // a round part
           "5,5,5,5,5\n5,5,5,5,5\n1,7,2,8,3\n",                      // flat
           "0,1,4,9,16\n1,2,5,10,17\n4,5,8,13,20\n9,10,13,18,25\n",  // a bowl
       }) {
    EXPECT_NO_THROW(read_table(text)) << text;
  }
  EXPECT_EQ(read_table(kPandas, "heights").grid.rows, 5);
}

TEST(MatrixTable, LeavesOutTheIndex) {
  for (const std::string& text : {kPandas, kAxes, std::string("y\\x,a,b,c\n0,40.8,-51.1,8.4\n1,-4.3,-40.4,-4.6\n")}) {
    const HeightMap map = read_table(text, "index");
    EXPECT_EQ(map.grid.cols, 3) << text;
    EXPECT_EQ(map.grid.pitch_x, 0.5) << text;
    EXPECT_EQ(map.at(0, 0), 40.8) << text;
    EXPECT_EQ(map.at(1, 2), -4.6) << text;
    ASSERT_EQ(map.history.size(), 1u) << text;
    EXPECT_NE(map.history[0].find("table: the first row"), std::string::npos) << map.history[0];
  }
  const HeightMap by_column = read_table(kIndexAlone, "index");
  EXPECT_EQ(by_column.grid, (Grid{5, 2, 0.5, 0.5, {}}));
  EXPECT_EQ(by_column.at(4, 0), 2.2);
  const HeightMap by_row = read_table(kHeaderAlone, "index");
  EXPECT_EQ(by_row.grid, (Grid{2, 5, 0.5, 0.5, {}}));
  EXPECT_EQ(by_row.at(1, 4), 0.2);
  EXPECT_EQ(read_table(kNumberedCorner, "index").grid, (Grid{4, 4, 0.5, 0.5, {}}));
}

TEST(MatrixTable, TakesPitchAndOriginFromCoordinates) {
  const HeightMap map = read_table(kAxes, "mm", std::nullopt);
  EXPECT_EQ(map.grid, (Grid{3, 3, 0.5, 0.25, {0.0, 2.0}}));
  EXPECT_EQ(map.at(2, 1), -7.1);
  EXPECT_EQ(read_table(kAxes, "cm", std::nullopt).grid, (Grid{3, 3, 5.0, 2.5, {0.0, 20.0}}));
  // Falling y: the first row of the file is the last of the map.
  const HeightMap falling = read_table("nan,0,1,2\n7,1,2,9\n5,4,8,6\n", "um", std::nullopt);
  EXPECT_DOUBLE_EQ(falling.grid.origin.y, 5e-3);
  EXPECT_DOUBLE_EQ(falling.grid.pitch_y, 2e-3);
  EXPECT_EQ(falling.at(0, 1), 8.0);
  EXPECT_EQ(falling.at(1, 2), 9.0);
  const HeightMap mirrored = read_table("nan,2,1,0\n5,1,2,9\n7,4,8,6\n", "mm", std::nullopt);
  EXPECT_EQ(mirrored.at(0, 0), 9.0);
  EXPECT_EQ(mirrored.at(1, 2), 4.0);
}

TEST(MatrixTable, RefusesWhatDoesNotFit) {
  expect_input_error([] { read_table("1,2,3\n4,5,9\n7,1,3\n", "mm"); }, {"a.csv", "`map table` mm", "equal steps"});
  expect_input_error([] { read_table("3,2,7\n4,5,9\n7,1,3\n", "index"); },
                     {"a.csv", "`map table` index", "equal steps"});
  expect_input_error([] { read_table("nan,0,1,2\n7,1,2,9\n5,4,8,6\n", "index"); },
                     {"a.csv", "falling", "`map table` mm"});
  expect_input_error([] { read_table("# pitch_mm: 0.4\n" + kAxes, "mm", std::nullopt); },
                     {"a.csv", "0.5 x 0.25", "agree"});
  expect_input_error([] { read_table(kPandas, "rows"); }, {"'rows'", "heights, index"});
  expect_input_error([] { read_table("y,a,b\n0,1,2\n1,3,9\n"); }, {"line 1, column 1", "'y'", "names of columns"});
  const test::TemporaryFolder folder;
  MapReadOptions options;
  options.table = MatrixTable{MatrixTable::Kind::Numbering, "", 0.0};
  const auto points = folder.file("a.xyz", "0 0 1\n1 0 2\n");
  expect_input_error([&] { read_map(points, options); }, {"a.xyz", "`map table`", "points"});
}

TEST(MatrixTable, RefusesPointsThatNameNoColumns) {
  std::string grid, many;
  for (int i = 0; i < 12; ++i) {
    grid += std::to_string(i % 4) + "," + std::to_string(i / 4) + "," + std::to_string(i * i % 7) + "\n";
  }
  for (int i = 0; i < 120; ++i) {
    many += std::to_string(i * 37 % 101) + " " + std::to_string(i * 53 % 97) + " " + std::to_string(i) + "\n";
  }
  for (const std::string& text : {grid, many}) {
    expect_input_error([&] { read_table(text); },
                       {"a.csv", "rows of 3 numbers", "points x y z", "`map table` heights"});
    EXPECT_EQ(read_table(text, "heights").grid.cols, 3);
  }
}

}  // namespace
}  // namespace dwell
