#include "runs/job/pixel_weight_option.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/formats/npy.h"
#include "runs/job/job.h"
#include "runs/plan/pixel_weights.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/plan/small_job.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::small_map;
using test::SmallJob;
using test::TemporaryFolder;

std::vector<double> load(const std::string& text, const HeightMap& map, const Aperture& clear = {}) {
  std::vector<InputFile> inputs;
  return load_pixel_weights(text, clear, map, "map.csv", 1, inputs);
}

/// A file of numbers and nothing else, as numpy writes it.
std::string plain_file(const TemporaryFolder& folder, const std::string& name, const Grid& grid, double first) {
  std::vector<double> values;
  for (Index i = 0; i < grid.size(); ++i) values.push_back(first + 0.01 * static_cast<double>(i));
  return folder.file(name, npy_bytes(HeightMap(grid, values))).string();
}

TEST(PixelWeightOption, AreMultipliedTermByTerm) {
  const TemporaryFolder folder;
  const HeightMap map = small_map();
  const std::string file = plain_file(folder, "w.npy", map.grid, 0.0);
  std::vector<InputFile> inputs;
  const std::vector<double> weights =
      load_pixel_weights(file + "; edge:width=1.2,weight=0.25;centre=3", {}, map, "map.csv", 1, inputs);
  const std::vector<double> edge = weights_at_edge(map, 1.2, 0.25), centre = weights_in_centre(map, 3.0);
  ASSERT_EQ(weights.size(), map.values.size());
  for (std::size_t i = 0; i < weights.size(); ++i)
    EXPECT_NEAR(weights[i], 0.01 * static_cast<double>(i) * edge[i] * centre[i], 1e-12) << i;
  ASSERT_EQ(inputs.size(), 1U);
  EXPECT_EQ(inputs[0].role, "weight");
  EXPECT_EQ(inputs[0].sha256, sha256_of_file(file));
  EXPECT_TRUE(load("", map).empty());
}

TEST(PixelWeightOption, OutsideOfTheClearApertureIsZero) {
  const HeightMap map = small_map();
  const std::vector<double> weights = load("", map, parse_aperture("circle:3,7,4"));
  for (Index i = 0; i < map.grid.size(); ++i) {
    const bool inside =
        distance(map.grid.centre(i), {3.0, 7.0}) <= 4.0 && std::isfinite(map.values[static_cast<std::size_t>(i)]);
    EXPECT_EQ(weights[static_cast<std::size_t>(i)], inside ? 1.0 : 0.0) << i;
  }
}

TEST(PixelWeightOption, TakesNoDataForZero) {
  const TemporaryFolder folder;
  const HeightMap map = small_map();
  std::vector<double> values(map.values.size(), 2.0);
  values[77] = std::nan("");
  const std::string file = folder.file("w.npy", npy_bytes(HeightMap(map.grid, values))).string();
  const std::vector<double> weights = load(file, map);
  EXPECT_EQ(weights[77], 0.0);
  EXPECT_EQ(weights[78], 2.0);
}

TEST(PixelWeightOption, RefusesAFileOfAnotherGridUnitOrSign) {
  const TemporaryFolder folder;
  const HeightMap map = small_map();
  Grid other = map.grid;
  --other.cols;
  const std::string small = plain_file(folder, "small.npy", other, 1.0);
  expect_input_error([&] { load(small, map); },
                     {"small.npy", "22 rows x 29 columns", "map.csv", "22 rows x 30 columns"});
  HeightMap moved(map.grid, std::vector<double>(map.values.size(), 1.0));
  moved.grid.origin.x += 0.25;
  write_map(folder.path() / "moved.csv", moved);  // says nm, too
  expect_input_error([&] { load((folder.path() / "moved.csv").string(), map); },
                     {"moved.csv", "unit", "plain numbers"});
  folder.file("pitch.csv", "# pitch_mm = 0.5,0.25\n1,1\n1,1\n");
  expect_input_error([&] { load((folder.path() / "pitch.csv").string(), map); },
                     {"pitch.csv", "2 rows x 2 columns", "0.25", "map.csv"});
  const std::string negative = plain_file(folder, "negative.npy", map.grid, -0.02);
  expect_input_error([&] { load(negative, map); }, {"negative.npy", "-0.02 in row 1, column 1", "from 0"});
  expect_input_error([&] { load((folder.path() / "none.npy").string(), map); }, {"none.npy"});
}

TEST(PixelWeightOption, RefusesWhatIsHalfATerm) {
  for (const char* text :
       {"edge", "edge:width=3", "edge:weight=1", "edge:width=3,weight=-1", "edge:width=0,weight=1",
        "edge:width=3,weight=1,unit=mm", "centre=", "centre=-1", "centre=nan", "centre:2", "center=2", "edge=3", ";"}) {
    SCOPED_TRACE(text);
    EXPECT_THROW(check_pixel_weights(text), InputError);
  }
  EXPECT_NO_THROW(check_pixel_weights("centre=2;edge:width=3,weight=0.2; edges.npy"));
}

TEST(PixelWeightOption, NamesFilesByAnyRule) {
  const auto longer = [](const std::string& file) { return "/a/" + file; };
  EXPECT_EQ(renamed_pixel_weights("w.npy; centre=2;v.npy", longer), "/a/w.npy;centre=2;/a/v.npy");
  EXPECT_EQ(pixel_weight_files("w.npy; centre=2;v.h5:/weights"), (std::vector<std::string>{"w.npy", "v.h5"}));
}

TEST(PixelWeightOption, GoIntoThePartOfAJob) {
  SmallJob job;
  job.options.clear_aperture = parse_aperture("rect:-2,3,8,11");
  job.options.weight = "centre=2";
  const Job loaded = load_job(job.options);
  EXPECT_FALSE(loaded.part->weights.empty());
  EXPECT_EQ(loaded.map_pixels, small_map().valid_pixels());
  EXPECT_EQ(loaded.part->map.valid_pixels() + loaded.part->beside.valid_pixels(), loaded.map_pixels);
  EXPECT_LT(loaded.part->before.valid_pixels, loaded.map_pixels);
}

}  // namespace
}  // namespace dwell
