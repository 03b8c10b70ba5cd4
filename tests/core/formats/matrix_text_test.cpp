#include "core/formats/matrix_text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

void expect_two_by_three(const std::string& text) {
  const MapSource matrix = parse_matrix_text(text, "map a.csv");
  ASSERT_EQ(matrix.rows, 2) << text;
  ASSERT_EQ(matrix.cols, 3) << text;
  const std::vector<double> expected{1.0, -2.5, 3e2, 4.0, 5.0, 6.0};
  EXPECT_EQ(matrix.values, expected) << text;
}

TEST(MatrixText, ReadsEverySeparatorAndLineEnd) {
  expect_two_by_three("1,-2.5,3e2\n4,5,6\n");
  expect_two_by_three("1, -2.5 ,300\r\n4,5,6");
  expect_two_by_three("1;-2.5;3E+02\n4;5;6\n");
  expect_two_by_three("1\t-2.5\t300\n4\t5\t6\n");
  expect_two_by_three("  1   -2.5 +300  \n4\t5 6\n");
  expect_two_by_three("\xEF\xBB\xBF# measured on Tuesday\n\n1,-2.5,300\n  # later: more\n4,5,6\n\n");
}

TEST(MatrixText, EmptyFieldsAndNanAreNoData) {
  const MapSource matrix = parse_matrix_text(",nan,NaN\n1,,No Data\n,,\n", "map a.csv");
  ASSERT_EQ(matrix.rows, 3);
  ASSERT_EQ(matrix.cols, 3);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(std::isnan(matrix.values[i]), i != 3) << i;
}

TEST(MatrixText, WordsOfSpreadsheetsAreNoDataWhereverTheyStand) {
  // Excel's export of a round part: the first row, and the first of every row, has no value.
  const MapSource matrix = parse_matrix_text(
      "# pitch_mm: 0.5\n#N/A,#N/A,1,#N/A\n#DIV/0!,2,3,#NUM!\n  #VALUE!,4,n/a,NA\n\"#N/A\",\"5\",#NULL!,6\n",
      "map a.csv");
  ASSERT_EQ(matrix.rows, 4);
  ASSERT_EQ(matrix.cols, 4);
  const double none = std::nan("");
  const std::vector<double> expected{none, none, 1, none, none, 2, 3, none, none, 4, none, none, none, 5, none, 6};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(std::isnan(matrix.values[i]), std::isnan(expected[i])) << i;
    if (!std::isnan(expected[i])) {
      EXPECT_EQ(matrix.values[i], expected[i]) << i;
    }
  }
}

TEST(MatrixText, LeavesOutNoRow) {
  const auto refused = [](const std::string& text, std::initializer_list<std::string> words) {
    test::expect_input_error([&] { parse_matrix_text(text, "map a.csv"); }, words);
  };
  // A broken formula is no missing pixel.
  refused("#REF!,2\n3,4\n", {"line 1, column 1", "'#REF!'"});
  refused("1,2\n#NAME?,4\n", {"line 2, column 1", "'#NAME?'"});
  // A row that was struck out, or begins with a marker that nobody knows.
  refused("1,2,3\n#4,5,6\n7,8,9\n", {"line 2", "'#4,5,6'", "as many numbers as a row"});
  refused("1 2 3\n####### 5 6\n7 8 9\n", {"line 2", "as many numbers as a row"});
  refused("#XX;#XX;5\n1;2;3\n", {"line 1", "more than once"});
  refused("1;2;3\n#XX;#XX;5\n", {"line 2", "as many numbers as a row"});
  EXPECT_EQ(parse_matrix_text("#n/a;#NV;5\n1;2;3\n", "map a.csv").rows, 2);
  EXPECT_EQ(parse_matrix_text("\t5\t\n1\t2\t3\n", "map a.csv").cols, 3);
  EXPECT_EQ(parse_matrix_text("# 7,8\n1,2\n# second half, later\n3,4\n", "map a.csv").rows, 2);
  // Two blocks, as programs write several maps into one file.
  refused("1 2\n3 4\n\n\n5 6\n", {"line 3", "line 5", "second block"});
  EXPECT_EQ(parse_matrix_text("\n\n1 2\n3 4\n\n\n", "map a.csv").rows, 2);
}

TEST(MatrixText, ARowOfTabsIsARowWithoutData) {
  const MapSource matrix = parse_matrix_text("\t\n1\t2\n\t\n\t3\n", "map a.txt");
  ASSERT_EQ(matrix.rows, 4);
  ASSERT_EQ(matrix.cols, 2);
  EXPECT_TRUE(std::isnan(matrix.values[0]));
  EXPECT_EQ(matrix.values[2], 1.0);
  EXPECT_TRUE(std::isnan(matrix.values[5]));
  EXPECT_EQ(matrix.values[7], 3.0);
}

TEST(MatrixText, NamesLineAndColumnOfWhatItRefuses) {
  const auto refused = [](const std::string& text, std::initializer_list<std::string> words) {
    test::expect_input_error([&] { parse_matrix_text(text, "map a.csv"); }, words);
  };
  refused("1,2\n3\n", {"map a.csv", "line 2", "1 column", "line 1 has 2"});
  refused("# c\n1,2\n3,4,5\n", {"line 3", "3 columns", "line 2 has 2"});
  refused("1,2\n3,x4\n", {"line 2, column 2", "'x4'", "not a number"});
  refused("1,2\n3,4 5\n", {"line 2, column 2", "'4 5'"});
  refused("1,inf\n", {"line 1, column 2", "infinite"});
  refused("1,-inf\n", {"line 1, column 2", "infinite"});
  refused("1,1e999\n", {"line 1, column 2", "range"});
  refused("1,5;2,5\n", {"line 1, column 1", "'1,5'", "decimal comma"});
  refused("1,5 2,5\n", {"line 1, column 2", "'5 2'", "decimal commas"});
  refused("1,5\t2,5\n3,1\t4,2\n", {"line 1, column 2", "'5\\t2'", "decimal commas", "points"});
  refused("1\t2,5\n", {"line 1, column 1", "'1\\t2'", "decimal commas"});
  refused("0x10,2\n", {"line 1, column 1", "'0x10'"});
  refused("1,+-2\n", {"line 1, column 2"});
  refused("# only a comment\n", {"no row of numbers"});
}

TEST(MatrixText, ReadsItsHeader) {
  const MapHeader one = parse_matrix_text("# pitch_mm: 0.25\n1\n# origin_mm: -1.5, 2\n# unit: um\n", "map").header;
  EXPECT_EQ(one.pitch, (Point{0.25, 0.25}));
  EXPECT_EQ(one.origin, (Point{-1.5, 2.0}));
  EXPECT_EQ(one.unit, "um");
  EXPECT_EQ(parse_matrix_text("# pitch_mm: 0.25,0.5\n1\n", "map").header.pitch, (Point{0.25, 0.5}));
}

TEST(MatrixText, NamesTheHeaderLineItRefuses) {
  const auto refused = [](const std::string& line, const std::string& word) {
    test::expect_input_error([&] { parse_matrix_text("# first\n" + line + "\n1\n", "map a.csv"); },
                             {"map a.csv, line 2", word, "required"});
  };
  refused("# pitch_mm: 0", "'0'");
  refused("# pitch_mm: -0.1", "'-0.1'");
  refused("# pitch_mm: nan", "'nan'");
  refused("# pitch_mm: 0.1,0", "'0.1,0'");
  refused("# pitch_mm:", "''");
  refused("# origin_mm: 1", "'1'");
  refused("# origin_mm: 1,2,3", "'1,2,3'");
  refused("# origin_mm: 1,inf", "'1,inf'");
  test::expect_input_error([] { parse_matrix_text("# unit: nm\n# unit: nm\n1\n", "map a.csv"); },
                           {"line 2", "unit", "second time"});
}

TEST(MatrixText, WritesRowZeroFirst) {
  const HeightMap map({2, 3, 0.1, 0.2, {-1.0, 4.0}}, {1.0, 2.0, 3.0, 0.1, NAN, -6.5});
  const std::string text = matrix_text(map, ',');
  EXPECT_NE(text.find("# pitch_mm: 0.1,0.2\n"), std::string::npos);
  EXPECT_NE(text.find("# origin_mm: -1,4\n"), std::string::npos);
  EXPECT_NE(text.find("# unit: nm\n"), std::string::npos);
  EXPECT_TRUE(text.ends_with("\n1,2,3\n0.1,nan,-6.5\n")) << text;
}

}  // namespace
}  // namespace dwell
