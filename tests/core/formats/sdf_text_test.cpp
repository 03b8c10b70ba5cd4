#include "core/formats/sdf_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/map/same_map.h"

namespace dwell {
namespace {

const std::string kSdfName = "map a.sdf";

/// 3 points, 2 profiles, 10 x 250 um, heights in um, the fields in another order than the standard's.
std::string file(const std::string& magic, const std::string& data = "1.5 bad -3\r\n4 5e-1 6\r\n*\r\n") {
  return magic +
         "\r\nManufacID = hand\r\nCreateDate = 221120260549\r\nModDate = 221120260549\r\nNumProfiles = 2\r\n"
         "NumPoints = 3\r\nXscale = 10.0e-6\r\nYscale = 250.0e-6\r\nZscale = 1.0e-6\r\nZresolution = -1\r\n"
         "Compression = 0\r\nDataType = 7\r\nCheckType = 0\r\n*\r\n" +
         data;
}

/// `text` with a header line for a field instead of its own.
std::string with(std::string text, const std::string& field, const std::string& line) {
  const std::size_t begin = text.find("\n" + field + " ") + 1;
  return text.replace(begin, text.find('\n', begin) + 1 - begin, line);
}

void expect_equal_values(const MapSource& source, const std::vector<double>& expected) {
  ASSERT_EQ(source.values.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (std::isnan(expected[i])) {
      EXPECT_TRUE(std::isnan(source.values[i])) << i;
    } else {
      EXPECT_DOUBLE_EQ(source.values[i], expected[i]) << i;
    }
  }
}

TEST(SdfText, FirstProfileHasTheSmallestYByIsoAndTheLargestByBcr) {
  for (const std::string magic : {"aISO-1.0", "aISO-2.0"}) {
    const MapSource source = parse_sdf_text(file(magic), kSdfName);
    EXPECT_EQ(source.rows, 2);
    EXPECT_EQ(source.cols, 3);
    ASSERT_TRUE(source.header.pitch.has_value());
    EXPECT_DOUBLE_EQ(source.header.pitch->x, 0.01);
    EXPECT_DOUBLE_EQ(source.header.pitch->y, 0.25);
    EXPECT_EQ(source.header.unit, "nm");
    EXPECT_FALSE(source.header.origin.has_value());
    expect_equal_values(source, {1500, NAN, -3000, 4000, 500, 6000});
  }
  expect_equal_values(parse_sdf_text(file("aBCR-1.0"), kSdfName), {4000, 500, 6000, 1500, NAN, -3000});
}

TEST(SdfText, ReadsTheCommentsAndWordsOfBcr) {
  std::string text = file("aBCR-1.0   ; first", "1 2 3 ; one\n ; two\n4 5 6\n* ; end\nOperator = someone\n*\n");
  text = with(with(with(text, "Compression", "compression = NULL ; or 0\n"), "CheckType", "CheckType=None\n"),
              "DataType", "DataType = INTEGER ; or 5\n");
  expect_equal_values(parse_sdf_text(text, kSdfName), {4000, 5000, 6000, 1000, 2000, 3000});
}

TEST(SdfText, ReadsAProfileWithoutAYScale) {
  std::string text =
      with(with(file("aISO-1.0", "1 2 3\n*\n"), "NumProfiles", "NumProfiles = 1\n"), "Yscale", "Yscale = 0\n");
  const MapSource source = parse_sdf_text(text, kSdfName);
  EXPECT_EQ(source.header.pitch, (Point{10.0e-6 * 1e3, 10.0e-6 * 1e3}));
  expect_equal_values(source, {1000, 2000, 3000});
}

TEST(SdfText, NamesWhatItRefuses) {
  const auto refused = [](const std::string& text, std::initializer_list<std::string> words) {
    test::expect_input_error([&] { parse_sdf_text(text, kSdfName); }, words);
  };
  refused("", {"map a.sdf", "aISO-1.0"});
  refused(file("bISO-1.0"), {"'bISO-1.0'", "aISO-1.0", "export a binary one"});
  refused(file("aISO-3.0"), {"'aISO-3.0'"});
  refused(file("aISO-1.0").substr(0, 148), {"truncated", "header does not end"});
  for (const std::string field :
       {"NumPoints", "NumProfiles", "Xscale", "Yscale", "Zscale", "Compression", "DataType", "CheckType"}) {
    refused(with(file("aISO-1.0"), field, ""), {"no " + field});
    refused(with(file("aISO-1.0"), field, field + " = x\n"), {field + " = 'x'", "required"});
    refused(with(file("aISO-1.0"), field, field + " = 1\n" + field + " = 1\n"), {field, "second time"});
  }
  refused(with(file("aISO-1.0"), "NumPoints", "NumPoints = 0\n"), {"NumPoints = '0'", ">= 1"});
  refused(with(file("aISO-1.0"), "NumPoints", "NumPoints = 9999999999999\n"), {"truncated", "9999999999999 values"});
  refused(with(file("aISO-1.0"), "Xscale", "Xscale = 0\n"), {"Xscale = '0'", "> 0"});
  refused(with(file("aISO-1.0"), "Xscale", "Xscale = 1e307\n"), {"beyond any surface"});
  refused(with(file("aISO-1.0"), "Zscale", "Zscale = -1e-9\n"), {"Zscale = '-1e-9'", "> 0"});
  refused(with(file("aISO-1.0"), "Zscale", "Zscale = nan\n"), {"Zscale = 'nan'"});
  refused(with(file("aISO-1.0"), "Compression", "Compression = 1\n"), {"Compression = '1'", "none"});
  refused(with(file("aISO-1.0"), "CheckType", "CheckType = 1\n"), {"CheckType = '1'", "none"});
  refused(with(file("aISO-1.0"), "DataType", "DataType = 8\n"), {"DataType = '8'", "0 to 7"});
  refused(with(file("aISO-1.0"), "DataType", "DataType 7\n"), {"line 12", "'DataType 7'", "name = value"});
  refused(file("aISO-1.0", "1 2 3\n4 5\n*\n"), {"line 17", "'*'", "value 3 of row 2"});
  refused(file("aISO-1.0", "1 2 3\n4 5\n"), {"truncated", "after 5 values"});
  refused(file("aISO-1.0", "1 2 3\n4 5 6\n"), {"line *"});
  refused(file("aISO-1.0", "1 2 3\n4 5 6 7\n*\n"), {"line 16", "line *", "NumProfiles = 2"});
  refused(file("aISO-1.0", "1 2 3\n4 1,5 6\n*\n"), {"line 16", "'1,5'"});
  refused(file("aISO-1.0", "1 2 3\n4 inf 6\n*\n"), {"'inf'"});
  refused(file("aISO-1.0", "1 2 nan\n4 5 6\n*\n"), {"line 15", "'nan'", "value 3 of row 1", "BAD for no data"});
  refused(file("aISO-1.0", "1 2 3\n4 5 6\n*\n# pitch_mm: 0.01,0.26\n*\n"), {"trailer", "0.01,0.26", "Yscale"});
  refused(file("aISO-1.0", "1 2 3\n4 5 6\n*\n# unit: um\n*\n"), {"trailer", "unit um"});
}

TEST(SdfText, RefusesFieldsThatContradictTheStandard) {
  const auto with_field = [](const std::string& field) {
    return with(file("aISO-1.0", "1 2 3\n4 5 6\n*\n"), "Compression", "Compression = 0\n" + field + "\n");
  };
  const auto refused = [&](const std::string& field, std::initializer_list<std::string> words) {
    test::expect_input_error([&] { parse_sdf_text(with_field(field), kSdfName); }, words);
  };
  refused("Unit = um", {"map a.sdf", "unit of 'um'", "m is required"});
  refused("NoData = -9999", {"-9999", "BAD is required"});
  refused("Zoffset = 3", {"SDF header field zoffset = 3"});
  for (const char* harmless : {"Unit = m", "ZUnits = metre", "Operator = nobody", "Xoffset = 0"}) {
    EXPECT_DOUBLE_EQ(parse_sdf_text(with_field(harmless), kSdfName).values.at(1), 2000.0) << harmless;
  }
  EXPECT_NE(parse_sdf_text(with_field("Xoffset = 3"), kSdfName).unclear_origin.find("xoffset = 3"), std::string::npos);
  const auto with_trailer = [](const std::string& line) {
    return file("aISO-1.0", "1 2 3\n4 5 6\n*\n" + line + "\n*\n");
  };
  for (const char* line : {"<Unit>um</Unit>", "Units = um"}) {
    test::expect_input_error([&] { parse_sdf_text(with_trailer(line), kSdfName); }, {"unit of 'um'"});
  }
  EXPECT_EQ(parse_sdf_text(with_trailer("< OperatorName > Tom < / OperatorName >"), kSdfName).rows, 2);
}

/// Nothing in it is symmetric.
HeightMap asymmetric_map_with_history() {
  HeightMap map(Grid{3, 4, 0.1, 1.0 / 3.0, {-1.7, 0.3}});
  for (std::size_t i = 0; i < map.values.size(); ++i) map.values[i] = 1.0 / (static_cast<double>(i) + 3.0) - 0.2;
  map.at(0, 0) = NAN;
  map.at(2, 1) = -1.2345678901234567e-300;
  map.history = {"read part.dat", "crop rect:0,0,1,1: kept"};
  return map;
}

// Scales in mm would make a part of metres.
TEST(SdfText, RefusesScalesThatAreNotInMetres) {
  for (const std::string field : {"Xscale", "Yscale"}) {
    const std::string text = with(file("aISO-1.0"), field, field + " = 0.25\r\n");
    test::expect_input_error([&] { parse_sdf_text(text, kSdfName); },
                             {"map a.sdf", field + " = 0.25", "250", "at most 0.05"});
  }
}

TEST(SdfText, ReadsBackEqualWithoutAnyOption) {
  const test::TemporaryFolder folder;
  write_map(folder.path() / "a.sdf", asymmetric_map_with_history());
  EXPECT_EQ(folder.entries(), 1u);
  for (const std::string name : {"a.sdf", "a.txt"}) {  // the content, not the name, says what it is
    if (name != "a.sdf") std::filesystem::rename(folder.path() / "a.sdf", folder.path() / name);
    const HeightMap read = read_map(folder.path() / name);
    test::expect_same_map(read, asymmetric_map_with_history());
    EXPECT_EQ(read.history, asymmetric_map_with_history().history);
  }
  const HeightMap column(Grid{3, 1, 0.5, 0.25, {1e3, 0.0}}, {NAN, 2.0, NAN});
  const HeightMap row(Grid{1, 3, 0.5, 0.25, {1e3, 0.0}}, {NAN, 2.0, NAN});
  for (const HeightMap& map : {column, row}) {
    write_map(folder.path() / "b.sdf", map);
    test::expect_same_map(read_map(folder.path() / "b.sdf"), map);
  }
}

TEST(SdfText, WritesTheHeaderOfTheStandard) {
  const HeightMap map(Grid{2, 3, 0.01, 0.25, {}}, {1.5, NAN, -3, 4, 0.5, 6});
  EXPECT_TRUE(sdf_text(map).starts_with(
      "aISO-1.0\r\nManufacID = dwell\r\nCreateDate = 010120000000\r\nModDate = 010120000000\r\nNumPoints = 3\r\n"
      "NumProfiles = 2\r\nXscale = 1e-05\r\nYscale = 0.00025\r\nZscale = 1e-09\r\nZresolution = -1\r\n"
      "Compression = 0\r\nDataType = 7\r\nCheckType = 0\r\n*\r\n1.5 BAD -3\r\n4 0.5 6\r\n*\r\n"));
}

// Other readers take the file as ASCII and split it at every asterisk.
TEST(SdfText, WritesATrailerOfAsciiWithoutAsterisks) {
  HeightMap map(Grid{1, 2, 0.01, 0.25, {}}, {1.5, 2.0});
  map.history = {"subtract:file=caf\u00e9*.csv"};
  const std::string text = sdf_text(map);
  EXPECT_THAT(text, testing::HasSubstr("# made: subtract:file=caf???.csv\r\n*\r\n"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '*'), 3);
}

TEST(SdfText, OptionsMustAgree) {
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.sdf", file("aISO-1.0"));
  MapReadOptions options;
  options.pitch = square_pitch(0.1);
  test::expect_input_error([&] { read_map(path, options); }, {"a.sdf", "0.01,0.25", "`map pixel`"});
  options = {};
  options.scale = 1e3;
  test::expect_input_error([&] { read_map(path, options); }, {"a.sdf", "unit nm", "`map unit`"});
  options = {};
  options.origin = Point{-1.0, 2.0};
  EXPECT_EQ(read_map(path, options).grid.origin, (Point{-1.0, 2.0}));
  test::expect_input_error([&] { read_map(folder.file("b.sdf", "1 2\n3 4\n")); }, {"b.sdf", "'1 2'", "aISO-1.0"});
  test::expect_input_error([&] { read_map(folder.file("c.csv", "bISO-1.0\x01\x02")); }, {"c.csv", "bISO-1.0"});
}

}  // namespace
}  // namespace dwell
