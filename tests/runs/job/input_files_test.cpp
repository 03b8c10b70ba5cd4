#include "runs/job/input_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/formats/npy.h"
#include "core/formats/npy_sidecar.h"
#include "runs/job/place_option.h"
#include "runs/plan/part.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/tif/measured_tool.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::TemporaryFolder;

RemovalFunction tif_of(const std::string& text) {
  JobOptions options;
  options.tif = text;
  std::vector<InputFile> inputs;
  return load_removal_function(options, inputs);
}

TEST(LoadMap, ScalesPlacesAndRecordsTheFile) {
  const TemporaryFolder folder;
  JobOptions options;
  options.map = folder.file("map.csv", "1,2,nan\n4,5,6\n").string();
  options.map_pixel_mm = square_pitch(0.5);
  options.map_unit = "um";
  options.map_origin_mm = Point{-1.0, 7.0};
  std::vector<InputFile> inputs;
  const HeightMap map = load_map(options, inputs);
  EXPECT_EQ(map.grid, (Grid{2, 3, 0.5, 0.5, {-1.0, 7.0}}));
  EXPECT_EQ(map.at(0, 1), 2000.0);
  EXPECT_EQ(map.at(1, 2), 6000.0);
  EXPECT_TRUE(std::isnan(map.at(0, 2)));
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0].role, "map");
  EXPECT_EQ(inputs[0].file, options.map);
  EXPECT_EQ(inputs[0].sha256, sha256_of_file(options.map));
}

TEST(LoadMap, SaysWhichOptionIsMissing) {
  const TemporaryFolder folder;
  JobOptions options;
  std::vector<InputFile> inputs;
  expect_input_error([&] { load_map(options, inputs); }, {"--map", "required"});
  options.map = folder.file("map.csv", "1,2\n").string();
  expect_input_error([&] { load_map(options, inputs); }, {"map.csv", "`map pixel`", "# pitch_mm"});
  EXPECT_TRUE(inputs.empty());
}

TEST(LoadRemovalFunction, UnderstandsFormulas) {
  const RemovalFunction gaussian = tif_of("gaussian:peak=8,fwhm=2,radius=3");
  EXPECT_EQ(gaussian.kind, RemovalFunction::Kind::Gaussian);
  EXPECT_EQ(gaussian.peak, 8.0);
  EXPECT_EQ(gaussian.fwhm, 2.0);
  EXPECT_EQ(gaussian.radius, 3.0);
  const RemovalFunction by_sigma = tif_of("gaussian:peak=8,sigma=1,radius=4");
  EXPECT_NEAR(by_sigma.fwhm, std::sqrt(8.0 * std::numbers::ln2), 1e-14);
  EXPECT_NEAR(by_sigma.sigma, 1.0, 1e-14);
  EXPECT_EQ(tif_of("gaussian:peak=8,fwhm=2").radius, 3.0);  // 1.5 FWHM unless it is said
  const RemovalFunction disc = tif_of("disc:slope=2,radius=3");
  EXPECT_EQ(disc.kind, RemovalFunction::Kind::Disc);
  EXPECT_EQ(disc.peak, 6.0);
}

TEST(LoadRemovalFunction, RefusesBadFormulas) {
  expect_input_error([] { tif_of(""); }, {"--tif", "required", "gaussian"});
  expect_input_error([] { tif_of("gaussian:peak=8"); }, {"gaussian:peak=8", "fwhm or sigma"});
  expect_input_error([] { tif_of("gaussian:peak=8,fwhm=2,sigma=1"); }, {"either fwhm or sigma"});
  expect_input_error([] { tif_of("gaussian:fwhm=2"); }, {"peak"});
  expect_input_error([] { tif_of("gaussian:peak=nan,fwhm=2"); }, {"peak", "nan"});
  expect_input_error([] { tif_of("gaussian:peak=-1,fwhm=2"); }, {"peak", "-1", "from 1e-09"});
  expect_input_error([] { tif_of("gaussian:peak=1,fwhm=2,width=3"); }, {"width", "peak, fwhm, sigma, radius"});
  expect_input_error([] { tif_of("disc:slope=1"); }, {"radius"});
  expect_input_error([] { tif_of("disc:slope=1,radius=0"); }, {"radius", "from 1e-06"});
}

TEST(LoadRemovalFunction, ReadsAFileWithItsUnitPitchAndAxis) {
  const TemporaryFolder folder;
  JobOptions options;
  options.tif = folder.file("spot.csv", "0,0,0,0,0\n0,0,0,0,0\n0,0,6,3,0\n0,0,0,0,0\n0,0,0,0,0\n").string();
  options.tif_pixel_mm = square_pitch(0.5);
  options.tif_unit = "um/min";
  options.tif_centre = parse_tif_centre("middle");
  std::vector<InputFile> inputs;
  const RemovalFunction middle = load_removal_function(options, inputs);
  EXPECT_EQ(middle.kind, RemovalFunction::Kind::Measured);
  EXPECT_DOUBLE_EQ(middle.peak, 100.0);           // 6 um/min
  EXPECT_DOUBLE_EQ(middle.volume, 150.0 * 0.25);  // 9 um/min over pixels of 0.25 mm^2
  EXPECT_DOUBLE_EQ(middle.samples.grid.origin.x, -1.0);
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0].role, "tif");
  EXPECT_EQ(inputs[0].sha256, sha256_of_file(options.tif));

  options.tif_centre = parse_tif_centre("centroid");
  EXPECT_NEAR(load_removal_function(options, inputs).samples.grid.origin.x, -7.0 / 6.0, 1e-14);
  options.tif_centre = parse_tif_centre("0.75,0.25");
  EXPECT_DOUBLE_EQ(load_removal_function(options, inputs).samples.grid.origin.x, -0.75);
  EXPECT_DOUBLE_EQ(load_removal_function(options, inputs).samples.grid.origin.y, -0.25);
}

// A removal function is placed by its own middle: a doubtful origin keeps nobody from reading it, unless its axis is
// given as a place in the file.
TEST(LoadRemovalFunction, NeedsAClearOriginOnlyForAnAxisThatIsGiven) {
  const TemporaryFolder folder;
  const HeightMap rates(Grid{3, 3, 0.5, 0.5, {}}, {0, 0, 0, 0, 6, 0.1, 0, 0, 0});
  const auto file = folder.path() / "spot.npy";
  write_whole_file(file, npy_bytes(rates));
  write_whole_file(npy_sidecar_name(file),
                   "{\"pitch_mm\": [0.5, 0.5], \"x_offset\": 3, \"sha256\": \"" + sha256_of_file(file) + "\"}");
  JobOptions options;
  options.tif = file.string();
  std::vector<InputFile> inputs;
  EXPECT_DOUBLE_EQ(load_removal_function(options, inputs).samples.grid.origin.x, -0.5);
  options.tif_centre = parse_tif_centre("0.5,0.5");
  expect_input_error([&] { load_removal_function(options, inputs); },
                     {"spot.npy", "x_offset = 3", "`tif centre` middle or centroid"});
}

// As from an interferometer: the surface after 4 s, tilted, off its middle, and longer towards +x than towards -x.
TEST(LoadRemovalFunction, CalibratesTheSurfaceThatASpotLeft) {
  const TemporaryFolder folder;
  HeightMap after(Grid{81, 101, 0.1, 0.1, {3.0, -2.0}});
  const auto rate = [](double dx, double dy) {
    const double lead = dx > 0.0 ? 1.1 : 0.6;
    return 5.0 * std::exp(-0.5 * (dx * dx / (lead * lead) + dy * dy / (0.7 * 0.7)));
  };
  for (Index i = 0; i < after.grid.size(); ++i) {
    const Point p = after.grid.centre(i);
    after.values[static_cast<std::size_t>(i)] = 7.0 + 2.0 * p.x - p.y - 4.0 * rate(p.x - 7.8, p.y - 2.3);
  }
  write_map(folder.path() / "after.csv", after);
  JobOptions options;
  options.tif = (folder.path() / "after.csv").string();
  std::vector<InputFile> inputs;
  expect_input_error([&] { load_removal_function(options, inputs); }, {"after.csv", "`tif dwell time`"});
  options.tif_dwell_time_s = 4.0;
  options.tif_centre = parse_tif_centre("7.8,2.3");
  const RemovalFunction tif = load_removal_function(options, inputs);
  EXPECT_NEAR(tif.peak, 5.0, 0.05);
  EXPECT_NEAR(tif.volume, 5.0 * 2.0 * std::numbers::pi * 0.5 * (1.1 + 0.6) * 0.7, 0.3);
  ASSERT_EQ(inputs.size(), 1U);
  EXPECT_EQ(inputs[0].role, "tif");
  const Grid& g = tif.samples.grid;
  const auto at = [&](double x, double y) {
    return tif.samples.at(std::lround((y - g.origin.y) / g.pitch_y), std::lround((x - g.origin.x) / g.pitch_x));
  };
  EXPECT_NEAR(at(1.2, 0.0), rate(1.2, 0.0), 0.1);
  EXPECT_NEAR(at(-1.2, 0.0), rate(-1.2, 0.0), 0.1);
  EXPECT_NEAR(at(0.5, 0.9), rate(0.5, 0.9), 0.1);
  options.tif_dwell_time_s = 8.0;
  EXPECT_NEAR(load_removal_function(options, inputs).peak, 0.5 * tif.peak, 1e-9);
  options.tif_unit = "um/s";
  expect_input_error([&] { load_removal_function(options, inputs); }, {"um/s", "nm, um, mm, m"});
  options.tif_unit = "nm/s";
  options.tif_centre = parse_tif_centre("middle");
  expect_input_error([&] { load_removal_function(options, inputs); }, {"--tif-centre middle", "centroid"});
  options.tif_centre = parse_tif_centre("auto");
  options.tif_dwell_time_s.reset();
  options.tif_unit = "nm";
  expect_input_error([&] { load_removal_function(options, inputs); }, {"after.csv", "'nm'", "nm/s, um/s"});
  options.tif = "gaussian:peak=8,fwhm=2";
  options.tif_dwell_time_s = 4.0;
  expect_input_error([&] { load_removal_function(options, inputs); }, {"--tif-dwell-time 4", "gaussian:peak=8"});
}

TEST(LoadRemovalFunction, RefusesASpotThatRemovesNothing) {
  const TemporaryFolder folder;
  JobOptions options;
  options.tif_pixel_mm = square_pitch(0.5);
  std::vector<InputFile> inputs;
  for (const char* rates : {"0,0\n0,0\n", "-1,-2\n-3,-1\n", "1,-2\n-3,nan\n"}) {
    options.tif = folder.file("spot.csv", rates).string();
    expect_input_error([&] { load_removal_function(options, inputs); }, {"spot.csv", "must be > 0"});
  }
}

TEST(CheckToolFits, RefusesOnlyWhatNoToolForThePartIs) {
  const RemovalFunction tif = gaussian_removal(1.0, 2.0, 3.0);
  EXPECT_NO_THROW(check_tool_fits(tif, Grid{4, 40, 0.5, 0.5, {}}));
  EXPECT_NO_THROW(check_tool_fits(tif, Grid{11, 9, 0.5, 0.5, {}}));
  expect_input_error(
      [&] {
        check_tool_fits(gaussian_removal(1.0, 20.0, 30.0), Grid{9, 12, 0.5, 0.5, {}});
      },
      {"FWHM of 20 mm", "3 times the map of 6 x 4.5 mm", "`tif` (its size)", "`map pixel`"});
}

TEST(WiderThanMap, SaysAToolThatIsLargerBothWays) {
  const RemovalFunction tif = gaussian_removal(1.0, 2.0, 3.0);
  EXPECT_FALSE(wider_than_map(tif, Grid{4, 40, 0.5, 0.5, {}}).has_value());
  EXPECT_FALSE(wider_than_map(tif, Grid{40, 4, 0.5, 0.5, {}}).has_value());
  EXPECT_NE(wider_than_map(tif, Grid{9, 11, 0.5, 0.5, {}}).value().find("6 mm in diameter"), std::string::npos);
}

// A file of rates with an offset, its axis off the middle, and a dead sample.
TEST(LoadRemovalFunction, QuestionsAFileAndTakesTheAnswers) {
  const TemporaryFolder folder;
  HeightMap rates = test::measured_tool({0.9, -0.4});
  for (double& v : rates.values) v += 0.4;
  rates.at(23, 32) = std::nan("");
  write_map(folder.path() / "tool.csv", rates);
  JobOptions options;
  options.tif = (folder.path() / "tool.csv").string();
  std::vector<InputFile> inputs;
  expect_input_error([&] { load_removal_function(options, inputs); },
                     {"tool.csv", "1 sample without data", "`tif steps`", "`tif pedestal`", "`tif centre`"});
  options.tif_steps = "fill:harmonic";
  options.tif_pedestal = TifPedestal::Subtract;
  options.tif_centre = parse_tif_centre("peak");
  const RemovalFunction tif = load_removal_function(options, inputs);
  ASSERT_TRUE(tif.file.has_value());
  EXPECT_NEAR(tif.file->axis.x, 40.9, 0.15);
  EXPECT_NEAR(tif.file->axis.y, -30.4, 0.02);
  EXPECT_NEAR(tif.file->rim, 0.4, 0.01);
  EXPECT_NEAR(tif.file->peak, 4.4, 0.02);
  EXPECT_NEAR(tif.peak, 4.0, 0.02);
  ASSERT_EQ(tif.notes.size(), 1U);
  EXPECT_NE(tif.notes[0].find("taken off"), std::string::npos);
  ASSERT_EQ(tif.samples.history.size(), 2U);
  EXPECT_NE(tif.samples.history[0].find("fill:how=harmonic (1 hole of 1 pixel filled)"), std::string::npos);
  EXPECT_NE(tif.samples.history[1].find("pedestal subtract"), std::string::npos);
  options.tif_angle_deg = 30.0;
  const RemovalFunction turned = load_removal_function(options, inputs);
  EXPECT_TRUE(turned.file.has_value());
  EXPECT_EQ(turned.notes, tif.notes);
  options.tif_angle_deg = 0.0;
  options.tif = "gaussian:peak=8,fwhm=2";
  expect_input_error([&] { load_removal_function(options, inputs); }, {"--tif-steps fill:harmonic", "formula"});
  options.tif_steps.clear();
  expect_input_error([&] { load_removal_function(options, inputs); }, {"--tif-pedestal subtract", "formula"});
}

// What dwell tif wrote says its axis; nobody is asked again.
TEST(LoadRemovalFunction, AsksNotForTheAxisOfAFileOfDwellTif) {
  const TemporaryFolder folder;
  HeightMap rates = test::measured_tool({0.9, -0.4});
  rates.grid.origin = rates.grid.origin - Point{40.2, -30.7};
  rates.history.emplace_back(kToolAxisAtOrigin);
  write_map(folder.path() / "tool.csv", rates);
  JobOptions options;
  options.tif = (folder.path() / "tool.csv").string();
  std::vector<InputFile> inputs;
  const RemovalFunction tif = load_removal_function(options, inputs);
  EXPECT_NEAR(tif.file->axis.x, 0.0, 1e-12);
  EXPECT_TRUE(tif.notes.empty());
}

}  // namespace
}  // namespace dwell
