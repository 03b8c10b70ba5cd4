#include "core/formats/fits.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/formats/byte_flips.h"
#include "tests/core/formats/fits_test_file.h"
#include "tests/core/map/same_map.h"

namespace dwell {
namespace {

std::string header(const std::vector<std::string>& cards) { return test::fits_cards(cards); }

std::vector<std::string> primary(int bitpix, int cols, int rows, const std::vector<std::string>& more = {}) {
  std::vector<std::string> cards{"SIMPLE  =                    T", fmt::format("BITPIX  = {:20}", bitpix),
                                 "NAXIS   =                    2", fmt::format("NAXIS1  = {:20}", cols),
                                 fmt::format("NAXIS2  = {:20}", rows)};
  cards.insert(cards.end(), more.begin(), more.end());
  return cards;
}

template <class T>
std::string big_endian(const std::vector<T>& values) {
  std::string bytes;
  for (const T value : values) {
    const auto* raw = reinterpret_cast<const char*>(&value);
    for (std::size_t i = sizeof(T); i-- > 0;) bytes += raw[i];
  }
  bytes.resize((bytes.size() + 2879) / 2880 * 2880, '\0');
  return bytes;
}

MapSource read_fits(const std::string& bytes) { return parse_fits(bytes, "map a.fits"); }

const std::vector<double> kOneToSix{1, 2, 3, 4, 5, 6};  // 2 rows, 3 columns

TEST(Fits, TheFirstRowIsTheSmallestY) {
  const MapSource source = read_fits(header(primary(-64, 3, 2)) + big_endian(kOneToSix));
  EXPECT_EQ(source.rows, 2);
  EXPECT_EQ(source.cols, 3);
  EXPECT_EQ(source.values, kOneToSix);
  EXPECT_FALSE(source.header.pitch || source.header.origin || source.header.unit);
}

TEST(Fits, ReadsEveryTypeScaledWithItsBlank) {
  const std::vector<std::string> scaled{"BSCALE  =                  0.5", "BZERO   =                 10.0",
                                        "BLANK   =                    7"};
  const auto expect = [&](int bitpix, const std::string& data) {
    const MapSource source = read_fits(header(primary(bitpix, 3, 1, scaled)) + data);
    EXPECT_EQ(source.values.at(0), 10.5) << bitpix;
    EXPECT_TRUE(std::isnan(source.values.at(1))) << bitpix;
    EXPECT_EQ(source.values.at(2), 60.0) << bitpix;
  };
  expect(8, big_endian(std::vector<std::uint8_t>{1, 7, 100}));
  expect(16, big_endian(std::vector<std::int16_t>{1, 7, 100}));
  expect(32, big_endian(std::vector<std::int32_t>{1, 7, 100}));
  expect(64, big_endian(std::vector<std::int64_t>{1, 7, 100}));
  expect(-32, big_endian(std::vector<float>{1, NAN, 100}));
  expect(-64, big_endian(std::vector<double>{1, NAN, 100}));
  const test::TemporaryFolder folder;
  MapReadOptions options;
  options.pitch = square_pitch(1.0);
  const auto file =
      folder.file("a.fits", header(primary(-32, 3, 1)) + big_endian(std::vector<float>{1, HUGE_VALF, 100}));
  test::expect_input_error([&] { read_map(file, options); }, {"a.fits", "infinite", "column 2"});
}

TEST(Fits, FindsTheOnlyImageOfAMap) {
  const std::string empty = header({"SIMPLE  =                    T", "BITPIX  =                    8",
                                    "NAXIS   =                    0", "EXTEND  =                    T"});
  const auto extension = [](const std::vector<int>& sizes) {
    std::vector<std::string> cards{"XTENSION= 'IMAGE   '", "BITPIX  =                  -64",
                                   fmt::format("NAXIS   = {:20}", sizes.size())};
    for (std::size_t i = 0; i < sizes.size(); ++i) cards.push_back(fmt::format("NAXIS{}  = {:20}", i + 1, sizes[i]));
    cards.insert(cards.end(), {"PCOUNT  =                    0", "GCOUNT  =                    1"});
    return header(cards) + big_endian(kOneToSix);
  };
  EXPECT_EQ(read_fits(empty + extension({6}) + extension({1, 3, 2}) + extension({3, 2, 1})).cols, 3);
  test::expect_input_error(
      [&] {
        read_fits(empty + extension({6}) + extension({1, 3, 2}));
      },
      {"map a.fits", "no image of two axes"});
}

// c07: the first of several images was taken without a word.
TEST(Fits, ListsSeveralImagesAndTakesTheOneThatIsNamed) {
  using test::FitsUnit;
  const std::string bytes = test::fits_file({FitsUnit{},
                                             {"PUPIL", 2, 1, {0, 1}, {"PITCHMM = 0.5"}},
                                             {"SURF", 3, 2, kOneToSix, {"PITCHMM = 0.25"}},
                                             {"SURF", 1, 1, {7}, {"PITCHMM = 1.0"}}});
  const test::TemporaryFolder folder;
  const std::string name = folder.file("a.fits", bytes).string();
  test::expect_input_error([&] { read_map(name); },
                           {"a.fits", "3 images", "1 or PUPIL (2 x 1 pixels)", "2 or SURF (3 x 2 pixels)", "':3'"});
  EXPECT_EQ(read_map(name + ":2").values, kOneToSix);
  EXPECT_EQ(read_map(name + ":2").grid.pitch_x, 0.25);
  EXPECT_EQ(read_map(name + ":pupil").values, (std::vector<double>{0, 1}));
  test::expect_input_error([&] { read_map(name + ":SURF"); }, {"2 images", "called 'SURF'", "2 or SURF", "3 or SURF"});
  for (const char* wrong : {":0", ":4", ":none", ":/2"}) {
    test::expect_input_error([&] { read_map(name + wrong); }, {"0 images", "1 or PUPIL"});
  }
  const std::string single =
      folder.file("b.fits", test::fits_file({{"", 3, 2, kOneToSix, {"PITCHMM = 1.0"}}})).string();
  EXPECT_EQ(read_map(single + ":0").values, kOneToSix);
}

TEST(Fits, QuestionsPathDifferencesByNameKeywordAndComment) {
  const test::TemporaryFolder folder;
  const auto refused = [&](const std::string& name, const std::vector<std::string>& more, const char* shown) {
    std::vector<std::string> cards{"PITCHMM = 0.5"};
    cards.insert(cards.end(), more.begin(), more.end());
    const auto file = folder.file("a.fits", test::fits_file({{}, {name, 3, 2, kOneToSix, cards}}));
    test::expect_input_error([&] { read_map(file); }, {"a.fits", shown, "`wave scale`", "0.5", "1 if"});
    MapReadOptions options;
    options.waves.scale = 0.5;
    EXPECT_EQ(read_map(file, options).at(1, 2), 3.0) << shown;
  };
  refused("OPD", {}, "EXTNAME");
  refused("MAP", {"BTYPE   = 'Wavefront'"}, "BTYPE");
  refused("MAP", {"WFE_RMS = 75.2"}, "WFE_RMS");
  refused("MAP", {"COMMENT OPD of the pupil"}, "COMMENT");
  const auto made = folder.file(
      "b.fits", test::fits_file({{"", 3, 2, kOneToSix, {"PITCHMM = 0.5", "HISTORY half of the wavefront"}}}));
  EXPECT_EQ(read_map(made).values, kOneToSix) << "history tells what was done";
}

TEST(Fits, KnowsPitchOriginAndUnit) {
  const auto header_of = [&](const std::vector<std::string>& more) {
    return read_fits(header(primary(-64, 3, 2, more)) + big_endian(kOneToSix)).header;
  };
  EXPECT_EQ(header_of({"PITCHMM =                 0.25"}).pitch, (Point{0.25, 0.25}));
  const std::vector<std::string> world{"CUNIT1  = 'mm'",  "CUNIT2  = 'um'",    "CDELT1  = 0.5",
                                       "CDELT2  = 250.0", "CRPIX1  = 2.0",     "CRPIX2  = 1.0",
                                       "CRVAL1  = 10.0",  "CRVAL2  = -3000.0", "BUNIT   = 'um  '"};
  EXPECT_EQ(header_of(world).pitch, (Point{0.5, 0.25}));
  EXPECT_EQ(header_of(world).origin, (Point{9.5, -3.0}));
  EXPECT_EQ(header_of(world).unit, "um");
  EXPECT_EQ(header_of({"CUNIT1  = 'mm'", "CUNIT2  = 'mm'", "CD1_1   = 0.5", "CD2_2   = 0.25"}).pitch,
            (Point{0.5, 0.25}));
  EXPECT_FALSE(header_of({"CUNIT1  = 'deg'", "CUNIT2  = 'deg'", "CDELT1  = -0.5", "CDELT2  = 0.5"}).pitch)
      << "angles of the sky are no pitch";
  EXPECT_FALSE(header_of({"CDELT1  = 0.5", "CDELT2  = 0.5"}).pitch) << "of what?";
}

TEST(Fits, NamesTheKeywordOfWhatItRefuses) {
  const auto refused = [&](const std::vector<std::string>& more, std::initializer_list<std::string> words) {
    test::expect_input_error([&] { read_fits(header(primary(-64, 3, 2, more)) + big_endian(kOneToSix)); }, words);
  };
  refused({"PITCHMM = 0.0"}, {"map a.fits", "PITCHMM", "0", "> 0"});
  refused({"PITCHMM = 'wide'"}, {"PITCHMM", "a number is required"});
  refused({"CUNIT1  = 'mm'", "CDELT1  = -0.5"}, {"CDELT1", "-0.5", "> 0"});
  refused({"CUNIT1  = 'mm'", "CD1_1   = 0.5", "CD1_2   = 0.1"}, {"CD1_2", "0.1", "along x and y"});
  test::expect_input_error([&] { read_fits("1,2\n"); }, {"map a.fits", "not a FITS file"});
  test::expect_input_error([&] { read_fits(header(primary(-64, 300000, 200000))); }, {"map a.fits", "300000"});
}

TEST(Fits, WritesWhatItReadsBackEqual) {
  const test::TemporaryFolder folder;
  HeightMap map(Grid{2, 3, 0.1, 1.0 / 3.0, {-1.7, 0.1 + 0.2}}, {NAN, 1e6 / 7.0, -1.0 / 3.0, 0.0, 5.0, 6.0});
  map.history = {"read part.dat", "it's " + std::string(200, 'x'), "caf\xc3\xa9"};
  write_map(folder.path() / "a.fits", map);
  const HeightMap back = read_map(folder.path() / "a.fits");
  test::expect_same_map(back, map);
  EXPECT_EQ(back.history, (std::vector<std::string>{map.history[0], map.history[1], "caf??"}));
  EXPECT_EQ(fits_bytes(map).size() % 2880, 0u);
  EXPECT_EQ(fits_bytes(map), fits_bytes(map));
}

// CFITSIO reads whole blocks, whatever the memory holds behind the file's last byte.
TEST(Fits, NeedsEveryNumberButNotTheFillAfterThem) {
  const std::string whole = header(primary(-64, 3, 2)) + big_endian(kOneToSix);
  const std::size_t end = 2880 + 8 * kOneToSix.size();
  for (const std::size_t size : {whole.size() - 1, end + 1, end}) {
    EXPECT_EQ(read_fits(std::string(whole.data(), size)).values, kOneToSix) << size;
  }
  for (const std::size_t size : {end - 1, end - 8, std::size_t{2881}}) {
    test::expect_input_error([&] { read_fits(std::string(whole.data(), size)); }, {"map a.fits", "truncated"});
  }
}

TEST(Fits, SurvivesTruncationAndDamage) {
  const std::string whole =
      header(primary(16, 3, 2, {"BZERO   = 5.0", "CUNIT1  = 'mm'", "CDELT1  = 0.5"})) + big_endian(kOneToSix);
  for (std::size_t size = 8; size < whole.size(); size += 61) {
    test::expect_map_or_input_error([&] { return read_fits(whole.substr(0, size)); }, "map a.fits",
                                    std::to_string(size));
  }
  test::expect_survives_flips(whole, 800, 500, read_fits, "map a.fits");
}

}  // namespace
}  // namespace dwell
