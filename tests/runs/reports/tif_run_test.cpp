#include "runs/reports/tif_run.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "runs/job/input_files.h"
#include "runs/job/place_option.h"
#include "runs/job/planned_job.h"
#include "runs/reports/simulation.h"
#include "runs/reports/tif_picture.h"
#include "runs/reports/tif_report.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/core/tif/calibration/spot_truth.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::tool_rate;

const Grid kGrid{100, 130, 0.15, 0.15, {-9.0, -7.0}};
constexpr Point kPlace{1.03, 0.57};

/// A folder with the map after a spot of 5 s, with tilt and noise.
struct SpotFolder {
  test::TemporaryFolder folder;
  TifJob job;

  SpotFolder() {
    job.spot = (folder.path() / "after.csv").string();
    write_map(job.spot, test::after_spots(kGrid, {kPlace}, 5.0, 0.2, 12));
    job.dwell_time_s = 5.0;
    job.at = {"1.03,0.57"};
    job.centre = "at";
  }
  std::string file(const char* name) const { return (folder.path() / name).string(); }
};

TEST(MakeTif, CalibratesASpotAndWritesWhatAPlanTakesWithoutScaling) {
  SpotFolder spot;
  const TifResult result = make_tif(spot.job);
  EXPECT_EQ(result.source, "spot");
  for (const Point d : {Point{0.0, 0.0}, {1.1, -0.1}, {-0.2, 1.2}}) {
    const auto col = std::lround((d.x - result.rates.grid.origin.x) / 0.15),
               row = std::lround((d.y - result.rates.grid.origin.y) / 0.15);
    const Point sample = result.rates.grid.centre(row, col);
    EXPECT_NEAR(result.rates.at(row, col), tool_rate(sample), 0.2) << d.x;  // noise 0.2 nm in 5 s, and the baseline
  }
  write_map(spot.file("tif.csv"), result.rates);
  EXPECT_NE(read_whole_file(spot.file("tif.csv")).find("# unit: nm/s\n"), std::string::npos);
  EXPECT_NE(read_whole_file(spot.file("tif.csv")).find("# made: tif: 1 spot of 5 s"), std::string::npos);
  JobOptions plan;
  plan.tif = spot.file("tif.csv");
  std::vector<InputFile> inputs;
  const RemovalFunction tif = load_removal_function(plan, inputs);
  EXPECT_EQ(tif.samples.values, result.rates.values);
  EXPECT_NEAR(tif.samples.grid.origin.x, result.rates.grid.origin.x, 1e-12);
  EXPECT_NEAR(tif.peak, result.analysis.peak, 1e-12);
  // Neither a map, nor scaled by another unit.
  plan.map = plan.tif;
  expect_input_error([&] { load_map(plan, inputs); }, {"tif.csv", "'nm/s'", "heights are required"});
  plan.tif_unit = "um/s";
  expect_input_error([&] { load_removal_function(plan, inputs); }, {"tif.csv", "unit nm/s", "`tif unit` nm/s"});
  plan.tif = spot.job.spot;
  plan.tif_unit = "nm/s";
  expect_input_error([&] { load_removal_function(plan, inputs); }, {"after.csv", "'nm'", "removal rates are required"});
}

TEST(MakeTif, ReportsFitsAndDrawsThem) {
  SpotFolder spot;
  spot.job.fits = {"gaussian,elliptic-gaussian", "planetary:ratio=-1,eccentricity=0.5"};
  const TifResult result = make_tif(spot.job);
  ASSERT_EQ(result.fits.size(), 3u);
  EXPECT_LE(result.fits[0].bic, result.fits[1].bic);
  const auto told = nlohmann::json::parse(tif_json(result));
  EXPECT_EQ(told["fits"].size(), 3u);
  EXPECT_EQ(told["fits"][0]["model"], result.fits[0].model);
  EXPECT_NEAR(told["tif"]["peak_nm_per_s"].get<double>(), result.analysis.peak, 1e-12);
  EXPECT_EQ(told["inputs"][0]["role"], "after");
  EXPECT_EQ(told["spots"]["each"].size(), 1u);
  const std::string text = tif_text(result);
  for (const char* part :
       {"nm/s", "nm mm^2/s", "FWHM", "asymmetry", "10 % response", "held", "BIC", "--tif elliptic-gaussian:"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  for (const std::string& png :
       {tif_picture(result), section_picture(result), fit_picture(result), transfer_picture(result)})
    EXPECT_EQ(png.substr(1, 3), "PNG");
  // The specification printed is the function fitted.
  const RemovalFit& ellipse = result.fits[0].model == "elliptic-gaussian" ? result.fits[0] : result.fits[1];
  JobOptions options;
  options.tif = ellipse.spec;
  std::vector<InputFile> inputs;
  EXPECT_NEAR(load_removal_function(options, inputs).peak, ellipse.at("peak").value, 1e-5);
}

TEST(MakeTif, TakesAModel) {
  TifJob job;
  job.job.tif = "planetary:radius=5,eccentricity=0.8,ratio=-1,peak=20";
  const TifResult result = make_tif(job);
  EXPECT_EQ(result.source, "planetary");
  EXPECT_NEAR(result.analysis.peak, 20.0, 1e-9);
  EXPECT_TRUE(result.inputs.empty());
}

// An interferometer's path differences of a spot would make a tool twice as fast.
TEST(MakeTif, HalvesPathDifferencesOfASpotAndSaysSoInItsFile) {
  SpotFolder spot;
  const TifResult whole = make_tif(spot.job);
  spot.job.job.wave_scale = 0.5;
  const TifResult half = make_tif(spot.job);
  EXPECT_NEAR(half.rates.at(20, 25), 0.5 * whole.rates.at(20, 25), 1e-9 * std::abs(whole.rates.at(20, 25)) + 1e-12);
  write_map(spot.file("opd_tif.csv"), half.rates);
  EXPECT_NE(read_whole_file(spot.file("opd_tif.csv")).find("# made: wave scale 0.5"), std::string::npos);
  MapReadOptions rates;
  rates.name = "tif";
  rates.quantity = MapQuantity::Rate;
  EXPECT_EQ(read_map(spot.file("opd_tif.csv"), rates).at(20, 25), half.rates.at(20, 25));
}

TEST(MakeTif, RefusesOptionsThatWouldMeanNothing) {
  const auto with = [](auto change) {
    return [change] {
      SpotFolder spot;
      change(spot.job);
      make_tif(spot.job);
    };
  };
  expect_input_error(with([](TifJob& j) { j.job.tif = "gaussian:peak=1,fwhm=2"; }), {"one of"});
  expect_input_error(with([](TifJob& j) { j.spot.clear(); }), {"one of", "--spot", "--trench"});
  expect_input_error(with([](TifJob& j) { j.feed_mm_per_min = 10.0; }), {"--feed", "--trench"});
  expect_input_error(with([](TifJob& j) { j.dwell_time_s.reset(); }), {"--dwell-time", "required"});
  expect_input_error(with([](TifJob& j) { j.dwell_time_s = -3.0; }), {"after.csv", "`dwell time` = -3"});
  expect_input_error(with([](TifJob& j) { j.job.tif_pixel_mm = square_pitch(0.1); }), {"--tif-pixel", "--map-pixel"});
  expect_input_error(with([](TifJob& j) { j.baseline = "none"; }), {"--baseline none", "--before"});
  expect_input_error(with([](TifJob& j) { j.centre = "top"; }), {"--centre", "'top'"});
  expect_input_error(with([](TifJob& j) { j.at = {"1;2"}; }), {"--at", "'1;2'"});
  expect_input_error(with([](TifJob& j) { j.robust = true; }), {"--robust", "--fit"});
  expect_input_error(with([](TifJob& j) { j.fits = {"gauss"}; }), {"--fit", "'gauss'", "gaussian"});
  expect_input_error(with([](TifJob& j) { j.before = j.spot + "x"; }), {"after.csvx"});
  TifJob formula;
  formula.job.tif = "gaussian:peak=1,fwhm=2";
  formula.job.wave_scale = 0.5;
  expect_input_error([&] { make_tif(formula); }, {"--wavelength or --wave-scale", "--spot or --trench"});
  TifJob trench;
  trench.trench = "t.csv";
  trench.feed_mm_per_min = 5.0;
  trench.noise_sigmas = 3.0;
  expect_input_error([&] { make_tif(trench); }, {"--noise-sigmas", "--spot"});
}

// The tool's lobe, to +x as measured, must act to +y when the tool is turned by 90 degrees: a halt at one place.
TEST(TurnedTool, ActsAtTheRightPlaceInASimulation) {
  const test::TemporaryFolder folder;
  HeightMap rates(Grid{61, 61, 0.125, 0.125, {-3.75, -3.75}});
  rates.quantity = MapQuantity::Rate;
  for (Index i = 0; i < rates.grid.size(); ++i)
    rates.values[static_cast<std::size_t>(i)] = tool_rate(rates.grid.centre(i));
  write_map(folder.path() / "tif.csv", rates);
  write_map(folder.path() / "map.csv",
            HeightMap(Grid{80, 100, 0.25, 0.25, {-12.0, -9.0}}, std::vector<double>(8000, 0.0)));
  const auto program = folder.file("p.nc",
                                   "(dwell: gcode=g94, g4=seconds)\nG21 G90 G17 G94\nG0 Z10\nG0 X2 Y1\nG1 Z0 F3000\nG4 "
                                   "P10\nG0 Z10\nM2\n");
  JobOptions options;
  options.map = (folder.path() / "map.csv").string();
  options.tif = (folder.path() / "tif.csv").string();
  options.tif_centre = parse_tif_centre("0,0");
  options.remove = {};
  options.threads = 1;
  for (const auto& [angle, flip] :
       {std::pair{0.0, "none"}, {90.0, "none"}, {90.0, "x"}, {-90.0, "y"}, {30.0, "none"}}) {
    options.tif_angle_deg = angle;
    options.tif_flip = parse_flip(flip);
    const Simulation s = simulate_file(program, {}, options, {});
    const double a = angle * 3.14159265358979323846 / 180.0;
    const HeightMap& left = s.after.surface;  // of nothing
    for (Index i = 0; i < left.grid.size(); ++i) {
      const Point d = left.grid.centre(i) - Point{2.0, 1.0};
      Point q{std::cos(a) * d.x + std::sin(a) * d.y, std::cos(a) * d.y - std::sin(a) * d.x};
      if (std::string(flip) == "x") q.x = -q.x;
      if (std::string(flip) == "y") q.y = -q.y;
      double mean = 0.0;  // over the pixel
      for (const double u : {-1.0, 1.0}) {
        for (const double v : {-1.0, 1.0}) mean += 0.25 * tool_rate(q + (0.125 / std::sqrt(3.0)) * Point{u, v});
      }
      EXPECT_NEAR(-left.values[static_cast<std::size_t>(i)], 10.0 * mean, 0.6) << angle << flip << d.x << "," << d.y;
    }
  }
}

// A plan with the turned tool: its dwell times, summed with the turned formula, take away what its simulation says.
TEST(TurnedTool, PlansWithTheToolThatActs) {
  const test::TemporaryFolder folder;
  HeightMap map(Grid{60, 72, 0.25, 0.25, {-6.0, 2.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    map.values[static_cast<std::size_t>(i)] =
        60.0 * std::exp(-0.1 * std::pow(p.x - 4.0, 2) - 0.2 * std::pow(p.y - 11.0, 2));
  }
  write_map(folder.path() / "map.csv", map);
  JobOptions options;
  options.map = (folder.path() / "map.csv").string();
  options.tif = "mrf:lead=1.8,trail=0.7,width=2,peak=12";
  options.tif_angle_deg = 90.0;
  options.path = parse_path_spec("raster:pitch=0.5,overrun=2");
  options.remove = {};
  options.smoothness = {1e-4};
  options.max_feed_mm_per_min = 1e5;
  options.threads = 1;
  const PlannedJob plan = plan_job(options, {});
  double square = 0.0, before = 0.0;
  for (Index i = 0; i < map.grid.size(); i += 7) {
    const Point x = map.grid.centre(i);
    double removed = 0.0;
    for (std::size_t j = 0; j < plan.laid.path.points.size(); ++j) {
      const Point d = x - plan.laid.path.points[j];  // the ribbon runs to +y: long before (-y), short behind
      const double u = d.y / (d.y < 0.0 ? 1.8 : 0.7), v = d.x;
      removed += plan.dwell.seconds[static_cast<Index>(j)] * 12.0 * std::exp2(-(u * u + v * v));
    }
    square += std::pow(map.values[static_cast<std::size_t>(i)] - removed, 2);
    before += std::pow(map.values[static_cast<std::size_t>(i)], 2);
  }
  EXPECT_LE(std::sqrt(square / before), 0.05);
}

}  // namespace
}  // namespace dwell
