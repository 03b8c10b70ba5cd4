#include "core/formats/codev_int.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/formats/map_formats.h"
#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/map/same_map.h"

namespace dwell {
namespace {

const std::string kIntName = "map a.int";

TEST(CodevInt, FirstRowOfTheFileHasTheLargestY) {
  // 3 columns, 2 rows; 0.6328 um and SSZ 2: 316.4 nm a unit. 32767 is no data unless NDA says another value.
  const MapSource source = parse_codev_int(
      "! made by hand\n! twice\nA mirror\nGRD 3 2 SUR WVL 0.6328 SSZ 2\n1 2 3\n-4 32767\n6\n", kIntName);
  EXPECT_EQ(source.rows, 2);
  EXPECT_EQ(source.cols, 3);
  ASSERT_EQ(source.values.size(), 6u);
  EXPECT_DOUBLE_EQ(source.values[0], -4 * 316.4);
  EXPECT_TRUE(std::isnan(source.values[1]));
  EXPECT_DOUBLE_EQ(source.values[2], 6 * 316.4);
  EXPECT_DOUBLE_EQ(source.values[3], 316.4);
  EXPECT_DOUBLE_EQ(source.values[4], 2 * 316.4);
  EXPECT_DOUBLE_EQ(source.values[5], 3 * 316.4);
  EXPECT_EQ(source.header.unit, "nm");
  EXPECT_FALSE(source.header.pitch.has_value());
  EXPECT_FALSE(source.header.origin.has_value());
}

TEST(CodevInt, ReadsWhatTheFieldsSay) {
  const auto values = [](const std::string& text) { return parse_codev_int(text, kIntName).values; };
  EXPECT_EQ(values("t\nGRD 1 1 SUR WVL 1 SSZ 4 NDA -9\n2\n"), std::vector<double>{500});
  EXPECT_EQ(values("t\r\nGRD 2 1 SUR NDA -9 SSZ -1 WVL 2 NNR XSC 1.0\r\n3\r\n32767"),
            (std::vector<double>{-6000, -65534000}));
  EXPECT_TRUE(std::isnan(values("t\nGRD 2 1 SUR WVL 1 SSZ 4 NDA -9\n-9 0\n")[0]));
  EXPECT_EQ(values("GRD 1 1 SUR WVL 1 SSZ 1\n2\n"), std::vector<double>{2000});  // no title
  EXPECT_EQ(values("t\nGRD 1 1 SUR WVL 1 NNB SSZ 1\n2\n"), std::vector<double>{2000});
  EXPECT_EQ(values("GRD of my own\nGRD 1 1 SUR WVL 1 SSZ 1\n2\n"), std::vector<double>{2000});
  EXPECT_EQ(values("\n!\nGRD 1 1 SUR WVL 1 SSZ 1\n! more\n2 ! of it\n"), std::vector<double>{2000});  // empty title
}

TEST(CodevInt, NamesWhatItRefuses) {
  const auto refused = [](const std::string& text, std::initializer_list<std::string> words) {
    test::expect_input_error([&] { parse_codev_int(text, kIntName); }, words);
  };
  refused("", {"map a.int", "no Code V interferogram", "GRD"});
  refused("title\n1 2 3\nGRD 1 1 SUR WVL 1 SSZ 1\n1\n", {"no Code V interferogram"});
  refused("t\nZFR 4 WFR WVL 1 SSZ 1\n1 2 3 4\n", {"line 2", "ZFR", "Zernike"});
  refused("t\nGRD 2 1 FIL WVL 1 SSZ 1\n1 2\n", {"'FIL'", "SUR", "WFR"});
  refused("t\nGRD 0 1 SUR WVL 1 SSZ 1\n1 2\n", {"number of columns = '0'", ">= 1"});
  refused("t\nGRD 2 x SUR WVL 1 SSZ 1\n1 2\n", {"number of rows = 'x'"});
  refused("t\nGRD 2\n1 2\n", {"number of rows = ''"});
  refused("t\nGRD 2 1 SUR SSZ 1\n1 2\n", {"WVL", "missing"});
  refused("t\nGRD 2 1 SUR WVL 1\n1 2\n", {"SSZ", "missing"});
  refused("t\nGRD 2 1 SUR WVL 0 SSZ 1\n1 2\n", {"WVL = '0'", "from 0.1 to 20"});
  refused("t\nGRD 2 1 SUR WVL nan SSZ 1\n1 2\n", {"WVL = 'nan'"});
  refused("t\nGRD 2 1 SUR WVL 1 SSZ 0\n1 2\n", {"SSZ = '0'", "not 0"});
  refused("t\nGRD 2 1 SUR WVL 632.8 SSZ 1\n1 2\n", {"WVL = '632.8'", "[um]", "0.6328"});
  refused("t\nGRD 2 1 SUR WVL 1 SSZ 1e-309\n1 2\n", {"WVL / SSZ"});
  refused("t\nGRD 2 1 SUR WVL 1 SSZ 1 NDA\n1 2\n", {"NDA = ''"});
  refused("t\nGRD 2 1 SUR WVL 1 SSZ 1 XSC 1.5\n1 2\n", {"XSC = '1.5'", "square"});
  refused("t\nGRD 2 1 SUR WVL 1 WVL 1 SSZ 1\n1 2\n", {"'WVL'", "once"});
  refused("t\nGRD 2 1 SUR WVL 1 SSZ 1 ABC 1\n1 2\n", {"'ABC'", "NNB"});
  refused("t\nGRD 2 2 SUR WVL 1 SSZ 1\n1 2\n3\n", {"truncated", "after 3 values", "2 rows of 2"});
  refused("t\nGRD 9999999999 9999999999 SUR WVL 1 SSZ 1\n1 2\n", {"truncated", "9999999999 rows"});
  refused("t\nGRD 2 1 SUR WVL 1 SSZ 1\n1 1e400\n", {"line 3", "'1e400'", "value 2 of row 1"});
  refused("t\nGRD 2 1 SUR WVL 1 SSZ 1\n1 2\n3\n", {"line 4", "'3'", "nothing more"});
}

TEST(CodevInt, AWavefrontNeedsTheHeightOfItsWaves) {
  const test::TemporaryFolder folder;
  const auto wavefront = folder.file("a.int", "t\nGRD 2 1 WFR WVL 0.5 SSZ 1000\n100 -40\n");
  const auto surface = folder.file("b.int", "t\nGRD 2 1 SUR WVL 0.5 SSZ 1000\n100 -40\n");
  MapReadOptions options;
  options.pitch = square_pitch(0.5);
  test::expect_input_error([&] { read_map(wavefront, options); }, {"a.int, line 2", "WFR", "`wave scale`", "0.5 for"});
  EXPECT_EQ(read_map(surface, options).values, (std::vector<double>{50, -20}));
  options.waves.scale = 0.5;
  EXPECT_EQ(read_map(wavefront, options).values, (std::vector<double>{25, -10}));
  test::expect_input_error([&] { read_map(surface, options); },
                           {"b.int", "SUR", "says 1 wavelengths", "`wave scale` 0.5"});
  options.waves = {true, 500.0, 1.0};
  EXPECT_EQ(read_map(surface, options).values, (std::vector<double>{50, -20})) << "what the file says as well";
  options.waves.wavelength = 632.8;
  test::expect_input_error([&] { read_map(surface, options); }, {"b.int", "500 nm", "`wavelength` 632.8 nm", "agree"});
}

TEST(CodevInt, IsChosenByContentOrExtension) {
  const test::TemporaryFolder folder;
  const std::string text = "t\nGRD 2 3 SUR WVL 1 SSZ 1000\n1 2\n3 4\n5 6\n";
  MapReadOptions options;
  options.pitch = square_pitch(0.5);
  const HeightMap expected(Grid{3, 2, 0.5, 0.5, {}}, {5, 6, 3, 4, 1, 2});
  test::expect_same_map(read_map(folder.file("a.int", text), options), expected);
  test::expect_same_map(read_map(folder.file("a.txt", text), options), expected);
  test::expect_input_error([&] { read_map(folder.file("b.int", "1 2\n3 4\n"), options); }, {"b.int", "GRD"});
  test::expect_input_error([&] { read_map(folder.file("a.int", text)); }, {"a.int", "`map pixel`"});
}

}  // namespace
}  // namespace dwell
