// The first inputs of the fuzz targets, so that these begin inside the readers and not at their first line.

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include "core/base/errors.h"
#include "core/base/spec_text.h"
#include "core/base/whole_file.h"
#include "core/formats/map_formats.h"
#include "core/formats/map_io.h"
#include "core/formats/npy_sidecar.h"
#include "core/formats/profile_text.h"
#include "core/map/aperture.h"
#include "paths/path_catalogue.h"
#include "paths/path_file.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/program_reader.h"
#include "runs/programs/shipped_templates.h"
#include "runs/programs/template_reader.h"

namespace dwell {
namespace {

using Read = std::function<void(const std::filesystem::path&)>;

/// The few options are those that a user would have to give for these seeds: a pitch where the format holds none.
void read_as_map(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  MapReadOptions options;
  if (extension == ".npy" || extension == ".int") options.pitch = square_pitch(0.5);
  if (file.filename() == "commas.csv" || file.filename() == "plain.xyz") options.scale = 1e3;
  read_map(file, options);
}

/// Seeds of programs by templates name theirs in the first line.
void read_by_named_template(const std::filesystem::path& file) {
  const std::string text = read_whole_file(file);
  const std::size_t end = text.find('\n');
  read_by_template(std::string_view(text).substr(end + 1), "seed", find_program_template(text.substr(0, end)));
}

/// The readers by their fuzz targets: those of both tables of formats, text maps, which no row of a table claims, and
/// the texts that are no format of a map or program.
std::map<std::string, Read> readers() {
  std::map<std::string, Read> all{
      {"matrix_text", read_as_map},
      {"xyz_text", read_as_map},
      {"npy_sidecar",
       [](const auto& file) { parse_npy_sidecar(read_whole_file(file), std::string(64, 'a'), file.string()); }},
      {"profile_text", [](const auto& file) { parse_profile_text(read_whole_file(file), {}, file.string()); }},
      {"path_file", [](const auto& file) { read_path_file(file); }},
      {"path_spec", [](const auto& file) { parse_path_spec(read_whole_file(file)); }},
      {"spec_text", [](const auto& file) { parse_spec_text(read_whole_file(file), "seed"); }},
      {"program_template", [](const auto& file) { parse_program_template(read_whole_file(file), "seed"); }},
      {"template_program", read_by_named_template},
      {"aperture", [](const auto& file) { parse_aperture(read_whole_file(file)); }}};
  for (const MapFormat& format : map_formats()) all[format.fuzz] = read_as_map;
  for (const ProgramFormat& format : program_formats()) {
    GcodeReading reading;
    if (format.fuzz == "xps_trajectory") reading.start = Point{1.0, -2.0};  // which such a file never says
    all[format.fuzz] = [reading](const auto& file) { read_program(file, reading); };
  }
  return all;
}

TEST(FuzzSeeds, AreReadButForThoseThatShowARefusal) {
  const std::filesystem::path seeds = std::filesystem::path(DWELL_SOURCE_DIR) / "tests/fuzz/seeds";
  const std::set<std::string> refused{"far.xyz",       "rounding.xyz", "blanks.txt",    "index.csv",
                                      "scattered.xyz", "images.fits",  "remarks.csv",   "last.csv",
                                      "wavefront.int", "one.trj",      "same_place.csv"};
  std::size_t bytes = 0;
  for (const auto& [name, read] : readers()) {
    std::size_t files = 0;
    for (const auto& seed : std::filesystem::directory_iterator(seeds / name)) {
      ++files;
      bytes += seed.file_size();
      if (refused.contains(seed.path().filename().string())) {
        EXPECT_THROW(read(seed.path()), InputError) << seed.path();
      } else {
        EXPECT_NO_THROW(read(seed.path())) << seed.path();
      }
    }
    EXPECT_GE(files, 2u) << name;
  }
  EXPECT_LT(bytes, 65000u);
}

TEST(FuzzSeeds, ReadersTargetsAndSeedsAreTheSame) {
  const std::filesystem::path fuzz = std::filesystem::path(DWELL_SOURCE_DIR) / "tests/fuzz";
  std::set<std::string> read, targets, seeds;
  for (const auto& [name, reader] : readers()) read.insert(name);
  for (const auto& file : std::filesystem::directory_iterator(fuzz)) {
    const std::string stem = file.path().stem().string(), prefix = "reader_";
    if (stem.starts_with(prefix)) targets.insert(stem.substr(prefix.size()));
  }
  for (const auto& folder : std::filesystem::directory_iterator(fuzz / "seeds")) {
    seeds.insert(folder.path().filename().string());
  }
  EXPECT_EQ(read, targets) << "tests/fuzz/reader_NAME.cpp";
  EXPECT_EQ(read, seeds) << "tests/fuzz/seeds/NAME";
}

TEST(FuzzSeeds, EveryPlannerHasASeed) {
  const std::filesystem::path seeds = std::filesystem::path(DWELL_SOURCE_DIR) / "tests/fuzz/seeds/path_spec";
  for (const PathRecord& record : path_catalogue()) {
    ASSERT_TRUE(std::filesystem::exists(seeds / record.name)) << record.name;
    EXPECT_EQ(parse_path_spec(read_whole_file(seeds / record.name)).record->name, record.name);
  }
}

}  // namespace
}  // namespace dwell
