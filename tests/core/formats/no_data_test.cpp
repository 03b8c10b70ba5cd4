#include "core/formats/no_data.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/formats/npy.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

using test::expect_input_error;

/// A part of 6 x 7 pixels with heights of 80 to 121, and a frame of `mark` around it.
std::vector<double> framed(double mark) {
  std::vector<double> values;
  for (int row = 0; row < 8; ++row) {
    for (int col = 0; col < 9; ++col) {
      const bool frame = row == 0 || col == 0 || row == 7 || col == 8;
      values.push_back(frame ? mark : 80.0 + (row - 1) * 7.0 + (col - 1));
    }
  }
  return values;
}

constexpr std::size_t kFrame = 30, kPart = 42;

std::size_t count_of_data(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::count_if(values.begin(), values.end(), [](double v) { return !std::isnan(v); }));
}

std::vector<std::string> remove_from(std::vector<double>& values, const std::optional<NoDataMarkers>& asked = {},
                                     std::vector<double> said = {}, double factor = 1.0) {
  return remove_no_data({&values, factor, std::move(said)}, asked, "map a.csv", "map");
}

TEST(NoData, TheLargestFloatAndItsKinAreNoHeights) {
  for (const double mark : {double{FLT_MAX}, -double{FLT_MAX}, DBL_MAX, 1.70141e38, 9.96921e36, 1e30, -1e20, 1e300}) {
    std::vector<double> values = framed(mark);
    const auto history = remove_from(values);
    EXPECT_EQ(count_of_data(values), kPart) << mark;
    ASSERT_EQ(history.size(), 1u) << mark;
    EXPECT_NE(history[0].find("no data: 30 pixels of the usual marks (1e+20 and more)"), std::string::npos)
        << history[0];
    // Also where the reader has scaled the file's numbers already.
    if (mark < 1e300) {
      values = framed(mark * 1e-9);
      remove_from(values, {}, {}, 1e-9);
      EXPECT_EQ(count_of_data(values), kPart) << mark;
    }
  }
  std::vector<double> negative = framed(5.0);  // a file whose numbers count downwards
  EXPECT_TRUE(remove_from(negative, NoDataMarkers{}, {}, -0.5).empty());
  std::vector<double> values = framed(9.9e19);
  expect_input_error([&] { remove_from(values); }, {"9.9e+19"});
}

TEST(NoData, RefusesALoneExtremeThatRepeats) {
  for (const double mark : {-9999.0, 32767.0, -32768.0, 65535.0, -99999.0, 1e10, 1234.5}) {
    std::vector<double> values = framed(mark);
    const std::string shown = fmt::format("{}", mark);
    expect_input_error([&] { remove_from(values); },
                       {"map a.csv: 30 pixels are " + shown, "`map no data` " + shown, "`map no data` none"});
    EXPECT_TRUE(remove_from(values, NoDataMarkers{}).empty());
    EXPECT_EQ(count_of_data(values), kFrame + kPart);
    const auto history = remove_from(values, NoDataMarkers{{mark}});
    EXPECT_EQ(history, std::vector<std::string>{"no data: 30 pixels of " + shown + ", as asked"});
    EXPECT_EQ(count_of_data(values), kPart);
  }
}

TEST(NoData, FindsAMarkBesideAnotherAndBesideSpikes) {
  std::vector<double> values = framed(-9999.0);
  for (std::size_t i = 0; i < 9; ++i) values[i] = 32767.0;
  values[40] = 5000.0;  // a spike on its own
  std::vector<double> one = values;
  expect_input_error([&] { remove_from(one); }, {"21 pixels are -9999"});
  one = values;
  expect_input_error([&] { remove_from(one, NoDataMarkers{{-9999.0}}); }, {"9 pixels are 32767"});
  EXPECT_EQ(remove_from(values, NoDataMarkers{{-9999.0}}, {32767.0}).size(), 2u);
  EXPECT_EQ(count_of_data(values), kPart);
}

// Some programs have a code for each reason: the one beside the other hides neither.
TEST(NoData, FindsCodesNextToEachOther) {
  for (const double next : {-9998.0, -9999.5}) {
    std::vector<double> values = framed(-9999.0);
    for (std::size_t i = 0; i < 9; ++i) values[i] = next;
    expect_input_error([&] { remove_from(values); }, {"30 pixels are -9999", "next to it"});
  }
  std::vector<double> values = framed(-9999.0);
  values[3] = -9998.0;
  expect_input_error([&] { remove_from(values); }, {"30 pixels are -9999"});
  // A step on the part has heights of its own.
  std::vector<double> step = framed(5000.0);
  for (std::size_t i = 0; i < step.size(); ++i) step[i] += 0.01 * static_cast<double>(i % 7);
  EXPECT_TRUE(remove_from(step).empty());
}

/// A part of 20 x 20 pixels in a frame of `mark`, over whose edge a program has interpolated.
std::vector<double> smeared(double mark, double scale) {
  constexpr int kSide = 28, kFrameWidth = 4;
  std::vector<double> values;
  for (int row = 0; row < kSide; ++row) {
    for (int col = 0; col < kSide; ++col) {
      const int depth = std::min({row, col, kSide - 1 - row, kSide - 1 - col}) - kFrameWidth;
      const double height = scale * std::sin(0.3 * row + 0.2 * col * col);
      const double share = depth < 0 ? 1.0 : depth == 0 ? 0.7 + 0.003 * col : depth == 1 ? 0.2 + 0.001 * row : 0.0;
      values.push_back(share * mark + (1.0 - share) * height);
    }
  }
  return values;
}

TEST(NoData, RefusesAMarkThatIsSmearedIntoThePart) {
  const auto remove = [](std::vector<double> values, const std::optional<NoDataMarkers>& asked = {}) {
    return remove_no_data({&values, 1.0, {}, 28}, asked, "map a.csv", "map");
  };
  for (const double mark : {-9999.0, 32767.0, 1000.0}) {
    expect_input_error([&] { remove(smeared(mark, 20.0)); },
                       {"map a.csv", fmt::format("pixels are {}", mark), "rim", fmt::format("`map no data` {}", mark)});
    EXPECT_TRUE(remove(smeared(mark, 20.0), NoDataMarkers{}).empty());
    EXPECT_EQ(remove(smeared(mark, 20.0), NoDataMarkers{{mark}}).size(), 1u);
  }
  for (const double height : {-9999.5, 12.0, -40.0, 0.0}) EXPECT_TRUE(remove(smeared(height, 20.0)).empty()) << height;
  EXPECT_TRUE(remove(smeared(-9999.0, 2000.0)).empty()) << "a part that spans as much";
}

// A frame over whose edge nobody has interpolated is not said to be so.
TEST(NoData, SpeaksOfInterpolationOnlyWhereThereWasOne) {
  for (const std::size_t cols : {std::size_t{0}, std::size_t{9}}) {
    std::vector<double> values = framed(-9999.0);
    try {
      remove_no_data({&values, 1.0, {}, cols}, {}, "map a.csv", "map");
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(
          message,
          "map a.csv: 30 pixels are -9999, and no other is nearer than 80: a mark for no data? Give `map no data` "
          "-9999 if so, or `map no data` none if it is a height");
    }
  }
  // A part with a rough rim, which is neither interpolated nor near.
  std::vector<double> rough = smeared(-9999.0, 20.0);
  for (std::size_t i = 0; i < rough.size(); ++i) {
    if (rough[i] < -400.0 && rough[i] > -9998.0) rough[i] = (i % 3 == 0 ? -380.0 : 380.0);
  }
  try {
    remove_no_data({&rough, 1.0, {}, 28}, {}, "map a.csv", "map");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("interpolated"), std::string::npos) << error.what();
  }
}

TEST(NoData, KnowsTheUsualMarksAmongLargeNumbers) {
  for (const double mark : {3.4e38, -3.40282e38, 1.7e38, 9.97e36, 9.96921e36, 1e20, -1e34, 1e37, 1.26765e30, 9.999e20,
                            1.79e308, -8.98847e307, 1e300, double{1e35F}}) {
    EXPECT_TRUE(is_huge_marker(mark)) << mark;
  }
  for (const double height : {1e150, -1e150, 2e25, 1e19, 1e39, 1e301, 3.3e38, 0.0, std::nan(""), HUGE_VAL}) {
    EXPECT_FALSE(is_huge_marker(height)) << height;
  }
}

// What is beyond any height and no usual mark is a slip: refused with its place, also among a few others.
TEST(NoData, RefusesWhatIsNeitherAHeightNorAMark) {
  const test::TemporaryFolder folder;
  MapReadOptions options;
  expect_input_error([&] { read_map(folder.file("a.csv", "# pitch_mm: 1\n1,2,3\n4,1e150,6\n"), options); },
                     {"a.csv", "value 1e+150 in row 2, column 2", "from -1e+09 to 1e+09 nm", "`map no data`"});
  expect_input_error([&] { read_map(folder.file("a.xyz", "0 0 1\n1 0 2\n0 1 -1e150\n1 1 4\n"), options); },
                     {"a.xyz", "value -1e+150 in row 2, column 1", "nm"});
  expect_input_error([&] { read_map(folder.file("b.csv", "# pitch_mm: 1\n# unit: m\n1,2,3\n"), options); },
                     {"b.csv", "value 2 in row 1, column 2", "2e+09 nm"});
  expect_input_error([&] { read_map(folder.file("c.csv", "# pitch_mm: 1\n1e150,1e150,3\n1e150,1e150,2\n"), options); },
                     {"c.csv", "value 1e+150 in row 1, column 1"});
  options.no_data = NoDataMarkers{{1e150}};
  EXPECT_EQ(read_map(folder.path() / "a.csv", options).valid_pixels(), 5);
  MapReadOptions rates;
  rates.name = "tif";
  rates.quantity = MapQuantity::Rate;
  expect_input_error([&] { read_map(folder.path() / "a.csv", rates); }, {"1e+09 nm/s", "`tif no data`"});
}

TEST(NoData, LeavesHeightsAlone) {
  // Zero, flat parts, plateaus of removal functions, quantised and few heights, a spike on its own.
  std::vector<std::vector<double>> maps{framed(0.0), framed(130.0), framed(79.0), {1.0, 1.0, 1.0, 1.0, 50.0, 51.0}};
  std::vector<double> disc(100, 0.0), levels(90, 3.0);
  for (std::size_t i = 40; i < 60; ++i) disc[i] = 12.0;
  for (std::size_t i = 0; i < 30; ++i) levels[i] = 500.0;
  maps.insert(maps.end(), {disc, levels});
  std::vector<double> spike = framed(100.0);
  spike[0] = spike[1] = spike[2] = 9999.0;
  maps.push_back(spike);
  for (std::vector<double>& values : maps) {
    const std::vector<double> before = values;
    EXPECT_TRUE(remove_from(values).empty());
    EXPECT_EQ(values, before);
  }
}

TEST(NoData, ReadsWhatTheUserWrites) {
  EXPECT_EQ(parse_no_data("-9999").values, std::vector<double>{-9999.0});
  EXPECT_EQ(to_string(parse_no_data("-9999, 32767")), "-9999,32767");
  EXPECT_EQ(to_string(parse_no_data("none")), "none");
  for (const char* text : {"", "nan", "-9999,", "inf", "no"}) {
    expect_input_error([&] { parse_no_data(text); }, {std::string("'") + text + "'", "none"});
  }
}

// Of every format, in the file's own numbers, before the unit.
TEST(NoData, ComparesWithTheNumbersOfTheFile) {
  const test::TemporaryFolder folder;
  MapReadOptions options;
  options.no_data = NoDataMarkers{{-9999.0}};
  options.scale = 1e3;
  HeightMap map = read_map(folder.file("a.csv", "# pitch_mm: 1\n-9999,1\n2,3.5\n"), options);
  EXPECT_EQ(map.valid_pixels(), 3);
  EXPECT_EQ(map.at(1, 1), 3500.0);
  ASSERT_EQ(map.history.size(), 1u);
  EXPECT_EQ(map.history[0], "no data: 1 pixel of -9999, as asked");
  map = read_map(folder.file("a.xyz", "0 0 -9999\n1 0 2\n0 1 3\n1 1 4\n"), options);
  EXPECT_EQ(map.valid_pixels(), 3);
  write_whole_file(folder.path() / "a.npy", npy_bytes(HeightMap({2, 2, 1, 1, {}}, {1.0, -9999.0, 3.0, 7.0})));
  options.pitch = square_pitch(1.0);
  map = read_map(folder.path() / "a.npy", options);
  EXPECT_TRUE(std::isnan(map.at(0, 1)));
  EXPECT_EQ(map.at(1, 1), 7000.0);
  const std::string grid = "GRD 3 2 SUR WVL 0.5 SSZ -1000\n-9999 1 2\n3 4 5\n";
  MapReadOptions coded;
  coded.pitch = square_pitch(1.0);
  coded.no_data = NoDataMarkers{{-9999.0}};
  map = read_map(folder.file("a.int", grid), coded);
  EXPECT_EQ(map.valid_pixels(), 5) << "counted as in the file, not in nm";
  EXPECT_DOUBLE_EQ(map.at(0, 2), -2.5);
  const MapReadOptions none;
  map = read_map(folder.file("b.csv", "# pitch_mm: 1\n# nodata: -1\n-1,1\n2,3.5\n"), none);
  EXPECT_EQ(map.history, std::vector<std::string>{"no data: 1 pixel of -1, as the file says"});
  EXPECT_EQ(map.valid_pixels(), 3);
}

TEST(NoData, RefusesHeightsThatNoPartSpans) {
  const test::TemporaryFolder folder;
  const auto file = folder.file("a.csv", "# pitch_mm: 1\n# unit: um\n1,2\n-3,10001\n");
  MapReadOptions options;
  expect_input_error([&] { read_map(file, options); },
                     {"a.csv", "-0.003 to 10.001 mm", "10.004 mm", "at most 10 mm", "`map max pv`", "`map no data`"});
  options.max_pv = 1.1e7;
  EXPECT_EQ(read_map(file, options).at(1, 1), 10001e3);
  MapReadOptions rates;
  rates.name = "tif";
  rates.quantity = MapQuantity::Rate;
  const auto fast = folder.file("b.csv", "# pitch_mm: 1\n# unit: mm/s\n1,2\n3,14\n");
  expect_input_error([&] { read_map(fast, rates); }, {"b.csv", "rates", "mm/s", "`tif no data`"});
}

}  // namespace
}  // namespace dwell
