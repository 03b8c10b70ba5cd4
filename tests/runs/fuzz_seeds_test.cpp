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
#include "core/map/aperture.h"
#include "paths/path_catalogue.h"
#include "paths/path_file.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/program_reader.h"

namespace dwell {
namespace {

using Read = std::function<void(const std::filesystem::path&)>;

void read_as_map(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  MapReadOptions options;
  if (extension == ".npy" || extension == ".int") options.pitch = 0.5;
  if (file.filename() == "commas.csv" || file.filename() == "plain.xyz") options.scale = 1e3;
  read_map(file, options);
}

const std::map<std::string, Read>& readers() {
  static const Read kProgram = [](const std::filesystem::path& file) { read_program(file); };
  static const std::map<std::string, Read> kReaders{
      {"matrix_text", read_as_map},
      {"xyz_text", read_as_map},
      {"npy", read_as_map},
      {"sdf_text", read_as_map},
      {"codev_int", read_as_map},
      {"zygo_dat", read_as_map},
      {"hdf5", read_as_map},
      {"fits", read_as_map},
      {"npy_sidecar",
       [](const auto& file) { parse_npy_sidecar(read_whole_file(file), std::string(64, 'a'), file.string()); }},
      {"path_file", [](const auto& file) { read_path_file(file); }},
      {"path_spec", [](const auto& file) { parse_path_spec(read_whole_file(file)); }},
      {"spec_text", [](const auto& file) { parse_spec_text(read_whole_file(file), "seed"); }},
      {"aperture", [](const auto& file) { parse_aperture(read_whole_file(file)); }},
      {"gcode", kProgram},
      {"feed_table", kProgram}};
  return kReaders;
}

TEST(FuzzSeeds, AreReadButForThoseThatShowARefusal) {
  const std::filesystem::path seeds = std::filesystem::path(DWELL_SOURCE_DIR) / "tests/fuzz/seeds";
  const std::set<std::string> refused{"far.xyz", "rounding.xyz", "blanks.txt", "index.csv", "scattered.xyz"};
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
  EXPECT_LT(bytes, 20000u);
}

/// A target of its own, and more than one seed to begin from.
void expect_fuzzed(const std::string& name) {
  const std::filesystem::path fuzz = std::filesystem::path(DWELL_SOURCE_DIR) / "tests/fuzz";
  EXPECT_TRUE(std::filesystem::exists(fuzz / ("reader_" + name + ".cpp"))) << name << " has no fuzz target";
  EXPECT_TRUE(std::filesystem::is_directory(fuzz / "seeds" / name)) << name << " has no seeds";
  EXPECT_TRUE(readers().contains(name)) << name << " is not among the readers above";
}

TEST(FuzzSeeds, EveryFormatHasATargetAndSeeds) {
  for (const MapFormat& format : map_formats()) expect_fuzzed(format.fuzz);
  for (const char* text : {"matrix_text", "xyz_text"}) expect_fuzzed(text);  // what is left
  for (const ProgramFormat& format : program_formats()) expect_fuzzed(format.fuzz);
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
