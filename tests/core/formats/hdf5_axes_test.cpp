#include "core/formats/hdf5_axes.h"

#include <gtest/gtest.h>

#include "core/formats/hdf5_map.h"
#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/formats/hdf5_test_file.h"

namespace dwell {
namespace {

using test::Hdf5TestFile;

/// A map of 2 x 3 with coordinates of its columns and rows.
struct Coordinates {
  std::vector<double> x{-1.0, -0.5, 0.0}, y{250.0, 1250.0};
  std::string x_unit = "mm", y_unit = "um", x_name = "/x", y_name = "/y";
  bool attached = true;

  std::string bytes() const {
    Hdf5TestFile file;
    write(file);
    return file.bytes();
  }
  void write(Hdf5TestFile& file) const {
    file.doubles("/z", {2, 3}, {1, 2, 3, 4, 5, 6});
    file.doubles(x_name, {x.size()}, x);
    file.doubles(y_name, {y.size()}, y);
    if (!x_unit.empty()) file.text(x_name, "units", x_unit);
    if (!y_unit.empty()) file.text(y_name, "units", y_unit);
    if (!attached) return;
    file.scale(y_name, 0, "/z");
    file.scale(x_name, 1, "/z");
  }
};

MapSource read_nc(const Coordinates& coordinates) { return parse_hdf5(coordinates.bytes(), "map a.nc"); }

TEST(Hdf5Axes, GivePitchAndOrigin) {
  for (const bool attached : {true, false}) {
    Coordinates c;
    c.attached = attached;
    const MapSource source = read_nc(c);
    EXPECT_EQ(source.header.pitch, (Point{0.5, 1.0})) << attached;
    EXPECT_EQ(source.header.origin, (Point{-1.0, 0.25})) << attached;
    EXPECT_EQ(source.values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(source.unclear_origin, "");
  }
}

TEST(Hdf5Axes, DescendingCoordinatesTurnTheMap) {
  Coordinates c;
  c.y = {1250.0, 250.0};
  EXPECT_EQ(read_nc(c).values, (std::vector<double>{4, 5, 6, 1, 2, 3}));
  EXPECT_EQ(read_nc(c).header.origin, (Point{-1.0, 0.25}));
  c = {};
  c.x = {0.0, -0.5, -1.0};
  EXPECT_EQ(read_nc(c).values, (std::vector<double>{3, 2, 1, 6, 5, 4}));
  EXPECT_EQ(read_nc(c).header.pitch, (Point{0.5, 1.0}));
}

TEST(Hdf5Axes, MustBeRegularWholeAndOfTheirAxis) {
  const auto refused = [](auto change, std::initializer_list<std::string> words) {
    Coordinates c;
    change(c);
    test::expect_input_error([&] { read_nc(c); }, words);
  };
  refused([](auto& c) { c.x[1] = -0.44; }, {"map a.nc", "'/x'", "its columns", "number 2 is -0.44", "equal steps"});
  refused([](auto& c) { c.x = {1, 1, 1}; }, {"'/x'", "equal steps"});
  refused([](auto& c) { c.x = {1, 2, 3, 4}; }, {"'/x'", "holds 4 numbers", "3 are required"});
  refused([](auto& c) { c.y_name = "/x2/x"; }, {"'/x2/x'", "its rows", "exchange the two dimensions"});
  Coordinates rounded;
  rounded.x = {-1.0, -0.49, 0.0};
  EXPECT_EQ(read_nc(rounded).header.pitch, (Point{0.5, 1.0})) << "rounding does no harm";
}

TEST(Hdf5Axes, WithoutAUnitOfLengthLeaveOpenWhatTheySay) {
  Coordinates c;
  c.x_unit = c.y_unit = "";
  const MapSource open = read_nc(c);
  EXPECT_FALSE(open.header.pitch || open.header.origin);
  EXPECT_NE(open.pitch_hint.find("coordinates '/x' without a unit of length"), std::string::npos);
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.nc", c.bytes());
  MapReadOptions options;
  test::expect_input_error([&] { read_map(path, options); }, {"coordinates '/y' without", "`map origin`"});
  options.origin = Point{};
  test::expect_input_error([&] { read_map(path, options); }, {"`map pixel`", "'/x'"});
  options.pitch = square_pitch(0.5);
  EXPECT_EQ(read_map(path, options).grid, (Grid{2, 3, 0.5, 0.5, {}}));
}

// x and y at every pixel, as meshgrid makes them.
TEST(Hdf5Axes, MayBeAMesh) {
  const auto read = [](const std::vector<double>& x, const std::vector<double>& y, const char* name = "X_mm") {
    Hdf5TestFile file;
    file.doubles("/z", {2, 3}, {1, 2, 3, 4, 5, 6});
    file.doubles(name, {2, 3}, x);
    file.doubles("Y_mm", {2, 3}, y);
    return parse_hdf5_at(file.bytes(), "/z", "map a.h5");
  };
  const std::vector<double> along{-1, -0.5, 0, -1, -0.5, 0}, across{2, 2, 2, 3, 3, 3};
  EXPECT_EQ(read(along, across).header.pitch, (Point{0.5, 1.0}));
  EXPECT_EQ(read(along, across).header.origin, (Point{-1.0, 2.0}));
  test::expect_input_error([&] { read(across, along); }, {"'/Y_mm'", "the coordinates of its rows", "first index"});
  EXPECT_FALSE(read(along, across, "x_slope").header.pitch) << "another map";
}

TEST(Hdf5Axes, OfAnotherLengthAreNamed) {
  Hdf5TestFile file;
  file.doubles("/z", {2, 3}, {1, 2, 3, 4, 5, 6});
  file.doubles("/x", {4}, {1, 2, 3, 4});
  EXPECT_NE(parse_hdf5(file.bytes(), "map a.h5").unclear_origin.find("'/x', which are not as many"), std::string::npos);
}

TEST(Hdf5Axes, NumbersOfPixelsSayNothing) {
  Coordinates c;
  c.x_unit = c.y_unit = "";
  c.x = {0, 1, 2};
  c.y = {1, 2};
  const MapSource source = read_nc(c);
  EXPECT_FALSE(source.header.pitch || source.header.origin);
  EXPECT_EQ(source.unclear_origin, "");
}

TEST(Hdf5Axes, AgreeWithTheAttributes) {
  const auto read_with = [](double pitch_x) {
    Hdf5TestFile file;
    Coordinates().write(file);
    file.number("/z", "pitch_mm", {pitch_x, 1.0});
    return parse_hdf5(file.bytes(), "map a.nc");
  };
  EXPECT_EQ(read_with(0.5).header.pitch, (Point{0.5, 1.0}));
  test::expect_input_error([&] { read_with(0.4); }, {"pitch_mm", "0.4", "'/x' and '/y'", "0.5 and 1 mm", "agree"});
}

}  // namespace
}  // namespace dwell
