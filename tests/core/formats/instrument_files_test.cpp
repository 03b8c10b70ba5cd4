/// The readers on small files that are committed, as instruments write them (instrument_files.h). What a real
/// instrument wrote is read by the tests that need ../shared/data and are skipped without it.

#include "tests/core/formats/instrument_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "core/base/whole_file.h"
#include "core/formats/map_formats.h"
#include "core/formats/map_io.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

using test::InstrumentFile;

std::filesystem::path committed(const InstrumentFile& file) {
  return std::filesystem::path(DWELL_SOURCE_DIR) / "tests/core/formats/files" / file.name;
}

MapReadOptions options_for(const InstrumentFile& file) {
  MapReadOptions options;
  options.pitch = file.pitch;
  options.scale = file.scale;
  return options;
}

/// The part as it was made up, whatever the format.
void expect_the_part(const HeightMap& map, const InstrumentFile& file) {
  ASSERT_EQ(map.grid.rows, test::kPartRows) << file.name;
  ASSERT_EQ(map.grid.cols, test::kPartCols) << file.name;
  EXPECT_NEAR(map.grid.pitch_x, file.grid.pitch_x, 1e-9) << file.name;
  EXPECT_NEAR(map.grid.pitch_y, file.grid.pitch_y, 1e-9) << file.name;
  EXPECT_NEAR(map.grid.origin.x, file.grid.origin.x, 1e-9) << file.name;
  EXPECT_NEAR(map.grid.origin.y, file.grid.origin.y, 1e-9) << file.name;
  for (Index r = 0; r < test::kPartRows; ++r) {
    for (Index c = 0; c < test::kPartCols; ++c) {
      const double height = test::part_height(r, c);
      ASSERT_EQ(std::isnan(map.at(r, c)), std::isnan(height)) << file.name << " " << r << " " << c;
      if (!std::isnan(height)) {
        ASSERT_NEAR(map.at(r, c), height, file.tolerance) << file.name << " " << r << " " << c;
      }
    }
  }
}

TEST(InstrumentFiles, HoldEveryFormat) {
  for (const MapFormat& format : map_formats()) {
    const std::vector<InstrumentFile> files = test::instrument_files();
    EXPECT_TRUE(std::any_of(files.begin(), files.end(),
                            [&](const InstrumentFile& file) {
                              return map_format_of(read_whole_file(committed(file)),
                                                   committed(file).extension().string()) == &format;
                            }))
        << format.name << " has no file in instrument_files.h";
  }
}

TEST(InstrumentFiles, AreReadAsThePartThatTheyHold) {
  for (const InstrumentFile& file : test::instrument_files()) {
    const HeightMap map = read_map(committed(file), options_for(file));
    expect_the_part(map, file);
    // Said again in numbers, for part_height() might be wrong as well: the bump at +x, the smaller one at +y, no data
    // at the corner of smallest x and y. 120 + 0.25 * 18 - 0.5 * 9, 60 + 0.25 * 7 - 0.5 * 14 and what the other adds.
    EXPECT_NEAR(map.at(9, 18), 120.0, 0.1) << file.name;
    EXPECT_NEAR(map.at(14, 7), 54.75, 0.1) << file.name;
    EXPECT_EQ(map.valid_pixels(), 18 * 24 - 3) << file.name;
    EXPECT_TRUE(std::isnan(map.at(0, 0)) && std::isnan(map.at(0, 1)) && std::isnan(map.at(1, 0))) << file.name;
  }
}

TEST(InstrumentFiles, AreThoseThatTheGeneratorMakes) {
  for (const InstrumentFile& file : test::instrument_files()) {
    const std::string made = file.bytes();
    if (std::getenv("DWELL_WRITE_INSTRUMENT_FILES") != nullptr) write_whole_file(committed(file), made);
    const std::string kept = read_whole_file(committed(file));
    EXPECT_LT(kept.size(), 20000u) << file.name;
    if (std::string(file.name) != "part.datx") {
      EXPECT_TRUE(kept == made) << file.name << ": DWELL_WRITE_INSTRUMENT_FILES=1 writes it anew";
    }
    const test::TemporaryFolder folder;
    expect_the_part(read_map(folder.file(file.name, made), options_for(file)), file);
  }
}

// A file is read as what it is under any name: none of these needs its own.
TEST(InstrumentFiles, AreKnownByWhatTheyHold) {
  const test::TemporaryFolder folder;
  for (const InstrumentFile& file : test::instrument_files()) {
    const std::filesystem::path renamed = folder.path() / "measurement.txt";
    write_whole_file(renamed, read_whole_file(committed(file)));
    expect_the_part(read_map(renamed, options_for(file)), file);
  }
}

TEST(InstrumentFiles, CutShortAreRefused) {
  const test::TemporaryFolder folder;
  for (const InstrumentFile& file : test::instrument_files()) {
    const std::string whole = read_whole_file(committed(file));
    const auto cut = folder.file(file.name, whole.substr(0, whole.size() / 2));
    const bool may_end_anywhere = std::string(file.name) == "part.xyz";  // fewer points are a smaller part
    if (!may_end_anywhere) {
      test::expect_input_error([&] { read_map(cut, options_for(file)); }, {file.name});
    }
  }
}

}  // namespace
}  // namespace dwell
