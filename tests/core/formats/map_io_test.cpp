#include "core/formats/map_io.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/whole_file.h"
#include "core/formats/npy.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/map/same_map.h"

namespace dwell {
namespace {

using test::TemporaryFolder;

/// Nothing in it is symmetric: size, pitches, origin, values, the place without data.
HeightMap asymmetric() {
  HeightMap map(Grid{3, 4, 0.1, 0.25, {-1.7, 0.3}});
  for (std::size_t i = 0; i < map.values.size(); ++i) map.values[i] = 1.0 / (static_cast<double>(i) + 3.0) - 0.2;
  map.at(0, 0) = NAN;
  map.at(2, 1) = -1.2345678901234567e-300;
  return map;
}

MapReadOptions with_pitch(double pitch) {
  MapReadOptions options;
  options.pitch = square_pitch(pitch);
  return options;
}

class RoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(RoundTrip, ReadsBackEqualWithoutAnyOption) {
  const TemporaryFolder folder;
  const auto file = folder.path() / GetParam();
  write_map(file, asymmetric());
  test::expect_same_map(read_map(file), asymmetric());
  EXPECT_EQ(folder.entries(), 1u);
}

TEST_P(RoundTrip, KeepsHowTheMapWasMade) {
  const TemporaryFolder folder;
  const auto file = folder.path() / GetParam();
  HeightMap map = asymmetric();
  map.history = {"read part.dat", "crop rect:0,0,1,1: kept"};
  write_map(file, map);
  EXPECT_EQ(read_map(file).history, map.history);
}

TEST_P(RoundTrip, ReadsBackEmptyBordersAndSingleLines) {
  const TemporaryFolder folder;
  const auto file = folder.path() / GetParam();
  HeightMap border(Grid{4, 5, 1.0 / 3.0, 0.1, {0.1, -0.2}});
  border.at(2, 2) = 5.0;
  HeightMap column(Grid{3, 1, 0.5, 0.25, {1e3, 0.0}}, {NAN, 2.0, NAN});
  HeightMap pixel(Grid{1, 1, 0.5, 0.25, {}}, {7.0});
  for (const HeightMap& map : {border, column, pixel}) {
    write_map(file, map);
    test::expect_same_map(read_map(file), map);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         testing::Values("map.csv", "map.txt", "map.xyz", "MAP.XYZ", "map.h5", "map.hdf5", "map.fits"));

TEST(MapIo, XyzKeepsItsMeaningUnderAnotherName) {
  const TemporaryFolder folder;
  write_map(folder.path() / "a.xyz", asymmetric());
  std::filesystem::rename(folder.path() / "a.xyz", folder.path() / "a.dat");
  test::expect_same_map(read_map(folder.path() / "a.dat"), asymmetric());
}

TEST(MapIo, NpyReadsBackWithPitchAndOriginGiven) {
  const TemporaryFolder folder;
  HeightMap map = asymmetric();
  map.grid.pitch_y = 0.1;
  for (const std::string name : {"map.npy", "map.bin"}) {  // the content, not the name, says what it is
    write_map(folder.path() / "map.npy", map);
    if (name != "map.npy") std::filesystem::rename(folder.path() / "map.npy", folder.path() / name);
    MapReadOptions options = with_pitch(0.1);
    options.origin = map.grid.origin;
    test::expect_same_map(read_map(folder.path() / name, options), map);
  }
}

TEST(MapIo, FirstLineOfAMatrixIsTheSmallestY) {
  const TemporaryFolder folder;
  MapReadOptions options = with_pitch(0.5);
  options.scale = 1e3;
  const HeightMap map = read_map(folder.file("a.csv", "1,2,3\n4,,6\n"), options);
  EXPECT_EQ(map.grid, (Grid{2, 3, 0.5, 0.5, {}}));
  EXPECT_EQ(map.at(0, 2), 3e3);
  EXPECT_EQ(map.at(1, 0), 4e3);
  EXPECT_TRUE(std::isnan(map.at(1, 1)));
  EXPECT_EQ(map.grid.y(1), 0.5);
}

TEST(MapIo, ThreeColumnsAreAMatrixUnlessTheFileSaysXyz) {
  const TemporaryFolder folder;
  const std::string rows = "0 0 1\n1 0 2\n0 1 3\n1 1 4\n";
  EXPECT_EQ(read_map(folder.file("a.txt", rows), with_pitch(1.0)).grid.rows, 4);
  EXPECT_EQ(read_map(folder.file("a.xyz", rows), with_pitch(1.0)).grid.rows, 2);
  EXPECT_EQ(read_map(folder.file("b.txt", "x y z\n" + rows)).at(1, 0), 3.0);
  test::expect_input_error([&] { read_map(folder.file("c.txt", rows)); }, {"c.txt", "`map pixel`", "x y z"});
}

TEST(MapIo, HeaderAndOptionsMustAgree) {
  const TemporaryFolder folder;
  const auto file = folder.file("a.csv", "# pitch_mm: 0.1\n# origin_mm: 0,-2\n# unit: um\n1,2\n");
  MapReadOptions options = with_pitch(0.1);
  options.origin = Point{0.0, -2.0};
  options.scale = 1e3;
  EXPECT_EQ(read_map(file, options).at(0, 1), 2e3);
  EXPECT_EQ(read_map(file, options).grid, (Grid{1, 2, 0.1, 0.1, {0.0, -2.0}}));

  MapReadOptions other = options;
  other.pitch = square_pitch(0.1000001);
  test::expect_input_error([&] { read_map(file, other); }, {"a.csv", "pitch_mm = 0.1,0.1", "`map pixel`", "0.1000001"});
  other = options;
  other.origin = Point{0.001, -2.0};
  test::expect_input_error([&] { read_map(file, other); }, {"a.csv", "origin_mm = 0,-2", "`map origin`", "0.001,-2"});
  other = options;
  other.scale = 1.0;
  test::expect_input_error([&] { read_map(file, other); }, {"a.csv", "unit um", "`map unit`", "factor of 1;", "agree"});
  other.scale.reset();
  EXPECT_EQ(read_map(file, other).at(0, 1), 2e3) << "without an option the file is taken at its word";
  const auto waves = folder.file("b.csv", "# unit: waves\n# pitch_mm: 1\n1,2\n");
  test::expect_input_error([&] { read_map(waves); }, {"b.csv", "unit waves", "`wavelength` [nm]", "`wave scale`"});
}

TEST(MapIo, PitchOfPixelsThatAreNotSquareIsComparedBothWays) {
  const TemporaryFolder folder;
  const auto plain = folder.file("a.csv", "1,2,3\n4,,6\n"), said = folder.file("b.csv", "# pitch_mm: 0.5,0.25\n1,2\n");
  MapReadOptions options;
  options.pitch = Point{0.5, 0.25};
  const HeightMap map = read_map(plain, options);
  EXPECT_EQ(map.grid, (Grid{2, 3, 0.5, 0.25, {}}));
  EXPECT_EQ(map.at(1, 2), 6.0);
  EXPECT_EQ(map.grid.centre(1, 2), (Point{1.0, 0.25}));
  EXPECT_EQ(read_map(said, options).grid, (Grid{1, 2, 0.5, 0.25, {}}));
  for (const Point other : {Point{0.5, 0.5}, Point{0.25, 0.25}, Point{0.25, 0.5}, Point{0.5, 0.25001}}) {
    options.pitch = other;
    test::expect_input_error([&] { read_map(said, options); }, {"b.csv", "pitch_mm = 0.5,0.25", "`map pixel`"});
  }
  options.pitch = Point{0.5, -0.25};
  test::expect_input_error([&] { read_map(plain, options); }, {"`map pixel` = 0.5,-0.25 mm", "> 0"});
}

TEST(MapIo, SaysOfARateThatHeightsAreRequiredAndOfNothingElse) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& unit) {
    try {
      read_map(folder.file("a.csv", "# pitch_mm: 1\n# unit: " + unit + "\n1,2\n"));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal("nm/s").find("(heights are required here, not rates)"), std::string::npos);
  EXPECT_NE(refusal("bananas").find("'bananas'"), std::string::npos);
  EXPECT_EQ(refusal("bananas").find("not rates"), std::string::npos);
  EXPECT_EQ(refusal("micron"), "");
}

TEST(MapIo, FitsASurfaceToScatteredPoints) {
  const TemporaryFolder folder;
  std::string text = "# x[mm] y[mm] z[um]\n";
  unsigned dice = 5;
  const auto roll = [&dice] { return static_cast<double>((dice = dice * 1664525U + 1013904223U) >> 16) / 65536.0; };
  for (int i = 0; i < 200; ++i) {
    const double x = 7.0 * roll() - 2.0, y = 5.0 * roll() + 1.0;
    text += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(1e-3 * (3.0 * x - y * y)) + "\n";
  }
  const auto file = folder.file("a.xyz", text);
  MapReadOptions options;
  test::expect_input_error([&] { read_map(file, options); }, {"a.xyz", "`map grid`"});
  options.grid = ScatterOptions{0.25, 0.6};
  const HeightMap map = read_map(file, options);
  EXPECT_EQ(map.grid.pitch_x, 0.25);
  EXPECT_NEAR(map.grid.origin.x, -2.0, 0.1);
  EXPECT_NEAR(map.grid.origin.y, 1.0, 0.1);
  EXPECT_GT(map.valid_pixels(), 300);
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      const Point at = map.grid.centre(row, col);
      if (std::isnan(map.at(row, col))) continue;
      EXPECT_NEAR(map.at(row, col), 3.0 * at.x - at.y * at.y, 0.01);
    }
  }
  ASSERT_EQ(map.history.size(), 1u);
  EXPECT_NE(map.history[0].find("grid pitch=0.25,reach=0.6: 200 points"), std::string::npos) << map.history[0];
  options.pitch = square_pitch(0.3);
  test::expect_input_error([&] { read_map(file, options); }, {"a.xyz", "`map pixel` is 0.3 mm", "0.25 mm"});
  options.pitch.reset();
  const auto matrix = folder.file("a.csv", "# pitch_mm: 1\n1,2\n3,5\n");
  test::expect_input_error([&] { read_map(matrix, options); }, {"a.csv", "`map grid`", "2 x 2", "leave it out"});
}

TEST(MapIo, NamesTheMissingOrBadPitchByTheOptionsName) {
  const TemporaryFolder folder;
  MapReadOptions tif;
  tif.name = "tif";
  const auto file = folder.file("spot.csv", "1,2\n3,4\n");
  test::expect_input_error([&] { read_map(file, tif); }, {"tif", "spot.csv", "`tif pixel`"});
  test::expect_input_error([&] { read_map(file); }, {"map", "spot.csv", "`map pixel`", "# pitch_mm"});
  write_whole_file(folder.path() / "spot.npy", npy_bytes(asymmetric()));
  test::expect_input_error([&] { read_map(folder.path() / "spot.npy", tif); },
                           {"spot.npy", "`tif pixel`", "sidecar spot.npy.json"});
  for (const double pitch : {0.0, -0.1, std::nan(""), HUGE_VAL}) {
    test::expect_input_error([&] { read_map(file, with_pitch(pitch)); }, {"`map pixel` = ", "spot.csv", "> 0"});
  }
  MapReadOptions bad = with_pitch(1.0);
  bad.origin = Point{0.0, NAN};
  test::expect_input_error([&] { read_map(file, bad); }, {"`map origin`", "nan", "finite"});
  for (const double scale : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    bad = with_pitch(1.0);
    bad.scale = scale;
    test::expect_input_error([&] { read_map(file, bad); }, {"`map unit`", "> 0"});
  }
}

TEST(MapIo, SaysWhatAFileLooksLike) {
  using namespace std::string_literals;
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& name, const std::string& bytes, const std::string& word) {
    const auto file = folder.file(name, bytes);
    test::expect_input_error([&] { read_map(file, with_pitch(1.0)); }, {file.string(), word});
  };
  refused("a.csv", "", "empty");
  refused("a.csv", "\x89PNG\r\n\x1a\n\0\0"s, "PNG");
  refused("a.csv", "PK\x03\x04rest", "ZIP");
  refused("a.csv", "\x89HDF\r\n\x1a\n"s, "not a readable HDF5 file: its 8 bytes");
  refused("a.xyz", "\x88\x1b\x03\x6f\0\x01"s, "truncated Zygo .dat file; 6 bytes");
  refused("a.csv", "SIMPLE  =                    T", "not a readable FITS file");
  refused("a.h5", "1,2\n", "not an HDF5 file");
  refused("a.datx", "\x88\x1b\x03\x6f\0\x01"s, "truncated Zygo .dat file");
  refused("a.fits", "1,2\n", "not a FITS file");
  refused("a.csv", "MATLAB 7.3 MAT-file, made by", "MATLAB 7.3");
  refused("a.csv", "1,2\n3,\0\x01\n"s, "binary");
  refused("a.csv",
          "\xff\xfe"
          "1\0,\0"s,
          "UTF-16");
  refused("a.npy", "1,2\n3,4\n", "not an NPY array but text");
  refused("a.npy", "\x93NUMPY\x01\0\x76"s, "truncated");
  refused("a.csv", "1,2\n3\n", "line 2");
  refused("a.csv", "nan,nan\n,\n", "all 4 values are no data");
  refused("a.xyz", "0 0 nan\n1 1 No Data\n", "all 4 values are no data");
}

TEST(MapIo, NamesMissingFilesAndDirectories) {
  const TemporaryFolder folder;
  const auto missing = folder.path() / "none.csv";
  test::expect_input_error([&] { read_map(missing); }, {missing.string(), "No such file"});
  test::expect_input_error([&] { read_map(folder.path()); }, {folder.path().string(), "directory"});
}

TEST(MapIo, RefusesWhatIsBeyondAnyHeightAfterScaling) {
  const TemporaryFolder folder;
  MapReadOptions options = with_pitch(1.0);
  options.scale = 1e300;
  const auto file = folder.file("a.csv", "1,2\n3,1e19\n");
  test::expect_input_error([&] { read_map(file, options); },
                           {"a.csv", "value 1 in row 1, column 1 of the map is 1e+300 nm", "is the unit right"});
}

TEST(MapIo, RefusesToWriteWhatItCouldNotRead) {
  const TemporaryFolder folder;
  HeightMap map = asymmetric();
  test::expect_input_error([&] { write_map(folder.path() / "a.png", map); }, {"a.png", "'.png'", ".csv"});
  test::expect_input_error([&] { write_map(folder.path() / "a", map); }, {"''", ".csv"});
  map.at(1, 1) = HUGE_VAL;
  test::expect_input_error([&] { write_map(folder.path() / "a.csv", map); }, {"a.csv", "infinite"});
  EXPECT_EQ(folder.entries(), 0u);
}

}  // namespace
}  // namespace dwell
