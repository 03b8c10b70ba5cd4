#include "core/formats/zygo_datx.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/formats/hdf5_map.h"
#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/form/spread.h"
#include "tests/core/formats/byte_flips.h"
#include "tests/core/formats/hdf5_test_file.h"

namespace dwell {
namespace {

using test::Hdf5TestFile;

constexpr const char* kPath = "/Data/Surface/{A}";
constexpr double kNoData = std::numeric_limits<double>::max();

/// A .datx of 2 rows and 3 columns; nothing in it is symmetric.
struct Datx {
  std::string path = kPath;
  std::string unit = "Fringes", base_unit = "Fringes";
  std::vector<double> values{1.0, -2.0, kNoData, 4.0, NAN, 0.5};
  std::vector<double> x{0.0, 1e-4, 0.0, 0.0}, y{0.0, 2.5e-4, 0.0, 0.0}, z{0.0, 6e-7, 0.5, 1.25};
  bool own_factors = true, coordinates = true, no_data = true;

  void write(Hdf5TestFile& file) const {
    file.doubles(path, {2, 3}, values);
    if (!unit.empty()) file.text(path, "Unit", unit);
    if (no_data) file.number(path, "No Data", {kNoData});
    file.converter(path, "X Converter", "Pixels", x);
    file.converter(path, "Y Converter", "Pixels", y);
    file.converter(path, "Z Converter", base_unit, z);
    if (coordinates) file.coordinates(path, 22, 15, 3, 2);
    if (!own_factors) return;
    file.number(path, "Wavelength", {6e-7});
    file.number(path, "Interferometric Scale Factor", {0.5});
    file.number(path, "Obliquity Factor", {1.25});
  }
  std::string bytes() const {
    Hdf5TestFile file;
    write(file);
    return file.bytes();
  }
};

MapSource read_datx(const std::string& bytes) { return parse_hdf5(bytes, "map a.datx"); }

void expect_close_values(const MapSource& source, const std::vector<double>& expected) {
  ASSERT_EQ(source.values.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(std::isnan(source.values[i]), std::isnan(expected[i])) << i;
    if (!std::isnan(expected[i])) {
      EXPECT_NEAR(source.values[i], expected[i], 1e-12 * std::abs(expected[i])) << i;
    }
  }
}

TEST(ZygoDatx, TurnsTheTopRowIntoTheLargestYAndFringesIntoNanometres) {
  const MapSource source = read_datx(Datx().bytes());
  EXPECT_EQ(source.rows, 2);
  EXPECT_EQ(source.cols, 3);
  const double fringe = 600 * 0.5 * 1.25;
  expect_close_values(source, {4 * fringe, NAN, 0.5 * fringe, fringe, -2 * fringe, NAN});
  EXPECT_EQ(source.header.unit, "nm");
  ASSERT_TRUE(source.header.pitch.has_value());
  EXPECT_DOUBLE_EQ(source.header.pitch->x, 0.1);
  EXPECT_DOUBLE_EQ(source.header.pitch->y, 0.25);
  EXPECT_EQ(source.camera_pixel, (Point{15.0, -23.0})) << "the bottom row is row 23 of the camera, counted from 0";
}

TEST(ZygoDatx, TakesFactorsFromTheConverterIfItMust) {
  Datx datx;
  datx.own_factors = false;
  expect_close_values(read_datx(datx.bytes()), read_datx(Datx().bytes()).values);
  datx.unit = "";
  expect_close_values(read_datx(datx.bytes()), read_datx(Datx().bytes()).values);
}

TEST(ZygoDatx, KnowsLengths) {
  Datx datx;
  datx.coordinates = false;
  for (const auto& [unit, nm] : {std::pair{"NanoMeters", 1.0}, {"MicroMeters", 1e3}, {"Meters", 1e9}}) {
    datx.unit = datx.base_unit = unit;
    const MapSource source = read_datx(datx.bytes());
    expect_close_values(source, {4 * nm, NAN, 0.5 * nm, nm, -2 * nm, NAN});
    EXPECT_EQ(source.camera_pixel, Point{});
  }
}

TEST(ZygoDatx, LeavesThePitchOpenWhereTheFileDoes) {
  Datx datx;
  datx.y[1] = 0.0;
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.datx", datx.bytes());
  test::expect_input_error([&] { read_map(path); }, {"a.datx", "`map pixel`", "'Y Converter'"});
  MapReadOptions options;
  options.pitch = square_pitch(0.5);
  EXPECT_EQ(read_map(path, options).grid, (Grid{2, 3, 0.5, 0.5, {7.5, -11.5}}));
}

// A header in single precision says 0.1000000047 where a user types 0.1; the tolerance was lost on the way from the
// reader's process.
TEST(ZygoDatx, TakesAPitchThatAgreesInSinglePrecision) {
  Datx datx;
  datx.x[1] = datx.y[1] = 1.00000004749745e-4;
  const test::TemporaryFolder folder;
  const auto path = folder.file("a.datx", datx.bytes());
  MapReadOptions options;
  options.pitch = square_pitch(0.1);
  EXPECT_NEAR(read_map(path, options).grid.pitch_x, 0.1, 1e-8);
  options.pitch = square_pitch(0.10001);
  test::expect_input_error([&] { read_map(path, options); }, {"a.datx", "0.10001", "agree"});
}

// Heights in fringes and in nm were both made with the factor that the surface states.
TEST(ZygoDatx, StatesItsScale) {
  const test::TemporaryFolder folder;
  Datx in_nm;
  in_nm.unit = in_nm.base_unit = "NanoMeters";
  const auto fringes = folder.file("opd.datx", Datx().bytes()), nm = folder.file("b.datx", in_nm.bytes());
  MapReadOptions options;
  const double high = read_map(fringes, options).at(0, 0), low = read_map(nm, options).at(0, 0);
  options.waves.scale = 0.5 * 1.25;
  EXPECT_EQ(read_map(fringes, options).at(0, 0), high);
  test::expect_input_error([&] { read_map(nm, options); }, {"b.datx", "'Interferometric Scale Factor'", "says 0.5 "});
  options.waves.scale = 0.5;
  EXPECT_EQ(read_map(nm, options).at(0, 0), low);
  test::expect_input_error([&] { read_map(fringes, options); }, {"opd.datx", "says 0.625 ", "`wave scale` 0.5"});
}

TEST(ZygoDatx, FollowsTheLinksToTheSurface) {
  Datx second;
  second.path = "/Data/Surface/{B}";
  second.values[0] = 7.0;
  const auto file_with = [&](const std::vector<std::vector<const char*>>& links) {
    Hdf5TestFile file;
    Datx().write(file);
    second.write(file);
    if (!links.empty()) file.meta_data(links);
    return file.bytes();
  };
  const double fringe = 600 * 0.5 * 1.25;
  const std::string linked = file_with({{"Root", "Attributes", "/Attributes"},
                                        {"Root", "Measurement", "{M}"},
                                        {"{M}", "Surface", "{B}"},
                                        {"{B}", "Path", "/Data/Surface/{B}"},
                                        {"{A}", "Path", "/Data/Surface/{A}"}});
  EXPECT_NEAR(read_datx(linked).values[3], 7.0 * fringe, 1e-9);
  EXPECT_NEAR(parse_hdf5_at(linked, kPath, "map a").values[3], fringe, 1e-9) << "a path that is given counts for more";
  test::expect_input_error([&] { read_datx(file_with({})); }, {"map a.datx", "2 surfaces", "/Data/Surface/{A}"});
  test::expect_input_error([&] { read_datx(file_with({{"Root", "Measurement", "{M}"}})); }, {"2 surfaces"});
}

TEST(ZygoDatx, NamesTheAttributeOfWhatItRefuses) {
  const auto refused = [](auto change, std::initializer_list<std::string> words) {
    Datx datx;
    change(datx);
    test::expect_input_error([&] { read_datx(datx.bytes()); }, words);
  };
  refused([](Datx& d) { d.unit = d.base_unit = "Waves"; }, {"map a.datx", "'Unit'", "Waves", "Fringes, NanoMeters"});
  refused([](Datx& d) { d.unit = "NanoMeters"; }, {"'Unit'", "NanoMeters", "'Z Converter' says Fringes"});
  refused([](Datx& d) { d.own_factors = false, d.z.clear(); }, {"'Wavelength'", "neither"});
  refused([](Datx& d) { d.own_factors = false, d.z[2] = 0.0; }, {"'Interferometric Scale Factor'", "= 0", "> 0"});
  refused([](Datx& d) { d.own_factors = false, d.z[3] = NAN; }, {"'Obliquity Factor'", "nan"});
  refused([](Datx& d) { d.x[1] = -1e-4; }, {"'X Converter'", "-0.0001", ">= 0"});
  refused([](Datx& d) { d.y[1] = HUGE_VAL; }, {"'Y Converter'", "inf"});
}

TEST(ZygoDatx, CountsWhatIsTooHighAsNoDataWhereTheFileDoesNotSay) {
  Datx datx;
  datx.no_data = false;
  datx.unit = datx.base_unit = "NanoMeters";
  expect_close_values(read_datx(datx.bytes()), {4, NAN, 0.5, 1, -2, NAN});
}

TEST(ZygoDatx, SurvivesTruncationAndDamage) {
  const std::string whole = Datx().bytes();
  for (std::size_t size = 8; size < whole.size(); size += 61) {
    test::expect_map_or_input_error([&] { return read_datx(whole.substr(0, size)); }, "map a.datx",
                                    std::to_string(size));
  }
  test::expect_survives_flips(whole, whole.size(), 150, read_datx, "map a.datx");
}

/// The file of Mx 8.3.3 that comes with monolithic. Reference: read_zygo_datx of prysm's io.py (as for sample.dat),
/// Python 3.11.2, NumPy 1.24.2, h5py 3.7.0: shape (259, 33), population standard deviation, maximum at [258, 32],
/// minimum at [217, 5], counted from the top. Tolerances as there.
TEST(ZygoDatx, ReadsARealFileAsPrysmDoes) {
  const std::string file = DWELL_SHARED_DATA "/zygo/sample.datx";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const HeightMap map = read_map(file);
  ASSERT_EQ(map.grid.rows, 259);
  ASSERT_EQ(map.grid.cols, 33);
  EXPECT_EQ(map.grid.pitch_x, 1.0000000474974513);
  EXPECT_EQ(map.grid.pitch_y, 1.0000000474974513);
  EXPECT_NEAR(map.grid.origin.x, 15 * 1.0000000474974513, 1e-12);
  EXPECT_NEAR(map.grid.origin.y, -(22 + 258) * 1.0000000474974513, 1e-12);
  EXPECT_EQ(map.valid_pixels(), 7771);
  const test::Spread spread = test::spread_of(map);
  EXPECT_NEAR(spread.pv, 453.03047887532682, 1e-9);
  EXPECT_NEAR(spread.deviation, 80.817652639659201, 1e-9);
  EXPECT_NEAR(map.at(0, 32), 306.55542666074592, 1e-10);
  EXPECT_NEAR(map.at(258 - 217, 5), -146.47505221458093, 1e-10);
  EXPECT_NEAR(map.at(258, 0), 125.33055123082136, 1e-10);
}

}  // namespace
}  // namespace dwell
