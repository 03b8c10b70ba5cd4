#include "core/formats/zygo_dat.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/form/spread.h"
#include "tests/core/formats/byte_flips.h"
#include "tests/core/formats/zygo_dat_bytes.h"
#include "tests/core/map/same_map.h"

namespace dwell {
namespace {

using test::ZygoDatFile;

MapSource read_zygo_dat(const std::string& bytes) { return parse_zygo_dat(bytes, "map a.dat"); }

ZygoDatFile variant(int format) {
  ZygoDatFile file;
  if (format == 2) file.magic = 0x881b0370;
  if (format == 3) file.magic = 0x881b0371;
  if (format == 3) file.header_size = 4096;
  file.format = static_cast<unsigned>(format);
  return file;
}

TEST(ZygoDat, TurnsTheTopRowIntoTheLargestYAndFringesIntoNanometres) {
  for (const int format : {1, 2, 3}) {
    const ZygoDatFile file = variant(format);
    const MapSource source = read_zygo_dat(file.bytes());
    ASSERT_EQ(source.rows, 2);
    ASSERT_EQ(source.cols, 3);
    // 1.25 x 0.5 x 632.8 nm over 32768 numbers to a fringe, in float32 of the file
    const double nm = 1.25 * 0.5 * 632.8 / 32768;
    const std::vector<double> expected{32768 * nm, NAN, -2147483647 * nm, 100 * nm, -200 * nm, NAN};
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (std::isnan(expected[i])) {
        EXPECT_TRUE(std::isnan(source.values[i])) << i;
      } else {
        EXPECT_NEAR(source.values[i], expected[i], 1e-7 * std::abs(expected[i])) << i;
      }
    }
    EXPECT_EQ(source.header.unit, "nm");
    ASSERT_TRUE(source.header.pitch.has_value());
    EXPECT_EQ(source.header.pitch->x, 1e3 * static_cast<double>(2e-4F));
    EXPECT_EQ(source.header.pitch->y, source.header.pitch->x);
    EXPECT_EQ(source.camera_pixel, (Point{7.0, -12.0})) << "the bottom row is row 12 of the camera, counted from 0";
  }
}

TEST(ZygoDat, KnowsEveryPhaseResolution) {
  const double fringe = 1.25 * 0.5 * 632.8;
  for (const auto& [code, numbers] : {std::pair{0U, 4096.0}, {1U, 32768.0}, {2U, 131072.0}}) {
    ZygoDatFile file;
    file.phase_resolution = code;
    EXPECT_NEAR(read_zygo_dat(file.bytes()).values[3], 100 * fringe / numbers, 1e-7 * fringe) << code;
  }
}

TEST(ZygoDat, SkipsTheIntensityWhateverItsSize) {
  ZygoDatFile none;
  none.intensity_cols = none.intensity_rows = none.frames = none.intensity_bytes = 0;
  ZygoDatFile one;
  one.frames = 0;  // some files say 0 for one
  one.intensity_bytes = 5 * 3 * 2;
  ZygoDatFile absent;
  absent.intensity_bytes = 0;
  for (const ZygoDatFile& file : {none, one, absent}) {
    EXPECT_EQ(read_zygo_dat(file.bytes()).values[0], read_zygo_dat(ZygoDatFile().bytes()).values[0]);
  }
}

TEST(ZygoDat, LeavesThePitchOpenWhereTheFileDoes) {
  const test::TemporaryFolder folder;
  ZygoDatFile file;
  file.resolution = 0.0F;
  const auto path = folder.file("a.dat", file.bytes());
  test::expect_input_error([&] { read_map(path); }, {"a.dat", "`map pixel`", "lateral resolution", "byte 184"});
  MapReadOptions options;
  options.pitch = square_pitch(0.25);
  options.max_pv = 1e8;
  EXPECT_EQ(read_map(path, options).grid, (Grid{2, 3, 0.25, 0.25, {7 * 0.25, -12 * 0.25}}));
  options.origin = Point{1.0, 2.0};
  EXPECT_EQ(read_map(path, options).grid.origin, (Point{1.0, 2.0})) << "the camera's place gives way to the user's";
  options.scale = 1e3;
  test::expect_input_error([&] { read_map(path, options); }, {"a.dat", "unit nm", "`map unit` nm"});
}

TEST(ZygoDat, NamesFieldByteAndValueOfWhatItRefuses) {
  const auto refused = [](auto change, std::initializer_list<std::string> words) {
    ZygoDatFile file;
    change(file);
    test::expect_input_error([&] { read_zygo_dat(file.bytes()); }, words);
  };
  const float infinite = std::numeric_limits<float>::infinity();
  refused([](auto& f) { f.magic = 0x881b0372; }, {"map a.dat", "0x881b0372", "byte 0", "0x881b0371, 3, 4096"});
  refused([](auto& f) { f.format = 2; }, {"header format 2", "byte 4"});
  refused([](auto& f) { f.header_size = 4096; }, {"header size 4096", "byte 6"});
  refused([](auto& f) { f.intensity_bytes = 58; },
          {"intensity", "58", "byte 60", "5 columns x 3 rows x 2 frames", "60"});
  refused([](auto& f) { f.frames = 65535; }, {"intensity", "byte 60", "1966050"});
  refused([](auto& f) { f.phase_bytes = 20; }, {"phase block", "20", "byte 72", "3 columns x 2 rows", "24"});
  refused([](auto& f) { f.cols = 0; }, {"0 columns (byte 68) x 2 rows"});
  refused([](auto& f) { f.rows = 0; }, {"0 rows (byte 70)"});
  refused([](auto& f) { f.rows = f.cols = 65535, f.phase_bytes = 0xfff80004; }, {"phase block", "need 17179344900"});
  refused([](auto& f) { f.phase_resolution = 3; }, {"phase resolution = 3", "byte 218", "0, 1 and 2"});
  refused([](auto& f) { f.sign = 1; }, {"data sign = 1", "byte 232"});
  refused([](auto& f) { f.scale = 0.0F; }, {"interferometric scale factor = 0", "byte 164", "> 0"});
  refused([](auto& f) { f.wavelength = NAN; }, {"wavelength = nan", "byte 168"});
  refused([](auto& f) { f.obliquity = -1.0F; }, {"obliquity factor = -1", "byte 176"});
  refused([=](auto& f) { f.resolution = infinite; }, {"lateral resolution = inf", "byte 184"});
  refused([](auto& f) { f.resolution = -1e-4F; }, {"lateral resolution = -", "byte 184"});
  refused([](auto& f) { f.phase.push_back(1); }, {"overlong", "922", "918"});
}

TEST(ZygoDat, RefusesEveryTruncation) {
  for (const int format : {1, 3}) {
    const std::string whole = variant(format).bytes();
    for (std::size_t size = 3; size < whole.size(); ++size) {
      test::expect_input_error([&] { read_zygo_dat(whole.substr(0, size)); },
                               {"map a.dat", "truncated", std::to_string(size)});
    }
  }
}

TEST(ZygoDat, SurvivesDamage) {
  test::expect_survives_flips(ZygoDatFile().bytes(), 834, 20000, read_zygo_dat, "map a.dat");
  test::expect_survives_flips(ZygoDatFile().bytes(), 10, 2000, read_zygo_dat, "map a.dat");
}

// The file holds its pitch in single precision, and people type what they read_zygo_dat.
TEST(ZygoDat, AgreesWithAPitchAsItIsPrinted) {
  const test::TemporaryFolder folder;
  write_whole_file(folder.path() / "a.dat", ZygoDatFile().bytes());
  MapReadOptions options;
  options.pitch = square_pitch(0.2);
  options.max_pv = 1e8;
  EXPECT_EQ(read_map(folder.path() / "a.dat", options).grid.pitch_x, static_cast<double>(2e-4F) * 1e3);
  options.pitch = square_pitch(0.20001);
  test::expect_input_error([&] { read_map(folder.path() / "a.dat", options); }, {"pitch_mm", "`map pixel`", "agree"});
}

// The file says its own scale: an option that says another would be a factor of two that nobody sees.
TEST(ZygoDat, StatesWavelengthAndScale) {
  const test::TemporaryFolder folder;
  const auto file = folder.file("wavefront.dat", ZygoDatFile().bytes());
  MapReadOptions options;
  options.max_pv = 1e8;
  const HeightMap expected = read_map(file, options);
  options.waves = {true, 632.8, 0.5 * 1.25};
  test::expect_same_map(read_map(file, options), expected);
  options.waves = {false, {}, 0.5};
  test::expect_input_error([&] { read_map(file, options); },
                           {"wavefront.dat", "byte 164", "says 0.625 wavelengths", "`wave scale` 0.5", "agree"});
  options.waves = {false, 543.5, {}};
  test::expect_input_error([&] { read_map(file, options); }, {"byte 168", "632.8", "`wavelength` 543.5 nm"});
}

/// The file that comes with prysm (425 x 432 pixels of MetroPro 8.3.5). Reference: read_zygo_dat of prysm's io.py (the
/// version that knows three phase resolutions), in 64-bit precision, Python 3.11.2, NumPy 1.24.2: shape (432, 425),
/// population standard deviation, maximum at [401, 268], minimum at [146, 387], counted from the top. Both readers do
/// the same few operations on the same integers, so only their order may differ: a few units in the last place.
TEST(ZygoDat, ReadsARealFileAsPrysmDoes) {
  const std::string file = DWELL_SHARED_DATA "/zygo/sample.dat";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const HeightMap map = read_map(file);
  ASSERT_EQ(map.grid.rows, 432);
  ASSERT_EQ(map.grid.cols, 425);
  EXPECT_EQ(map.grid.pitch_x, 0.11792420264100656);
  EXPECT_EQ(map.grid.pitch_y, 0.11792420264100656);
  EXPECT_NEAR(map.grid.origin.x, 139 * 0.11792420264100656, 1e-12);
  EXPECT_NEAR(map.grid.origin.y, -(38 + 431) * 0.11792420264100656, 1e-12);
  EXPECT_EQ(map.valid_pixels(), 136359);
  const test::Spread spread = test::spread_of(map);
  EXPECT_NEAR(spread.pv, 330.70017333488437, 1e-9);
  EXPECT_NEAR(spread.deviation, 44.591409383361714, 1e-9);
  EXPECT_NEAR(map.at(431 - 401, 268), 80.181442943527685, 1e-10);
  EXPECT_NEAR(map.at(431 - 146, 387), -250.51873039135668, 1e-10);
  EXPECT_NEAR(map.at(431, 194), -39.636900684390795, 1e-10) << "the first pixel of the file that was seen";
  EXPECT_NEAR(map.at(0, 227), -130.42036968186761, 1e-10) << "the last one";
  for (Index col = 0; col < 194; ++col) EXPECT_TRUE(std::isnan(map.at(431, col)));
}

}  // namespace
}  // namespace dwell
