// A clear aperture, weights, slopes and an absolute removal, from the command line to what is printed and written.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "core/base/whole_file.h"
#include "core/form/map_statistics.h"
#include "core/map/aperture.h"
#include "tests/cli/small_inputs.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;
using test::with;
using test::Words;

json printed_json(const SmallInputs& inputs, const Words& words) {
  const ProgramResult result = inputs.run(with(words, {"--json"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

TEST(CountedPixelsOfACommand, AreThoseInTheClearApertureWhileAllAreShown) {
  const SmallInputs inputs;
  const Words plan = SmallInputs::plan({"--clear-aperture", "circle:6,5,4", "--weight", "centre=3"});
  const json made = printed_json(inputs, plan);
  EXPECT_EQ(made["counted"]["measured_pixels"], 660);
  EXPECT_EQ(made["counted"]["clear_aperture"], "circle:6,5,4");
  const HeightMap shown = read_map(inputs / "plan/residual.npy");
  EXPECT_EQ(shown.valid_pixels(), 660);
  const HeightMap inside = within(shown, parse_aperture("circle:6,5,4"));
  EXPECT_EQ(inside.valid_pixels(), made["counted"]["counted_pixels"].get<Index>());
  const MapStatistics counted = map_statistics(inside, {true, true});
  EXPECT_NEAR(counted.rms, made["program"]["residual_rms_nm"].get<double>(), 1e-3 * counted.rms);
  EXPECT_LT(made["program"]["residual_rms_nm"].get<double>(), 0.5 * map_statistics(shown, {true, true}).rms);
  EXPECT_LT(made["counted"]["weighted_rms_after_nm"].get<double>(),
            made["counted"]["weighted_rms_before_nm"].get<double>());
  // A simulation of the folder knows all of it.
  const json again = printed_json(inputs, {"simulate", "plan"});
  EXPECT_EQ(again["counted"], made["counted"]);
  EXPECT_EQ(again["program"]["residual_rms_nm"], made["program"]["residual_rms_nm"]);
  const ProgramResult text = inputs.run(plan);
  expect_has(text.out, "of 660 pixels, clear aperture circle:6,5,4, weight centre=3; the others are shown");
  // Of the program alone it is asked about where it is another.
  const json alone =
      printed_json(inputs, {"simulate", "--program", "plan/program.nc", "--map", "map.csv", "--map-pixel", "0.5",
                            "--tif", "tif.csv", "--tif-pixel", "0.5", "--weight", "centre=3"});
  EXPECT_EQ(alone["differences"],
            (json{"--clear-aperture is not given, but was circle:6,5,4 when the program was made"}));
}

TEST(CountedPixelsOfACommand, HaveTheWeightsOfAFileThatGoesWithThePlan) {
  const SmallInputs inputs;
  std::string rows;
  for (int r = 0; r < 22; ++r) {
    for (int c = 0; c < 30; ++c) rows += (c < 6 ? "0" : r < 11 ? "0.5" : "1.5") + std::string(c < 29 ? "," : "\n");
  }
  inputs.folder.file("w.csv", rows);
  const json made = printed_json(inputs, SmallInputs::plan({"--weight", "w.csv"}));
  EXPECT_EQ(made["counted"]["counted_pixels"], 22 * 24);
  EXPECT_EQ(made["counted"]["least_weight"], 0.5);
  EXPECT_EQ(made["counted"]["largest_weight"], 1.5);
  EXPECT_EQ(printed_json(inputs, {"simulate", "plan"})["counted"], made["counted"]);
  rows[rows.size() - 2] = '7';
  inputs.folder.file("w.csv", rows);
  const ProgramResult changed = inputs.run({"simulate", "plan"});
  EXPECT_EQ(changed.exit_code, 2);
  expect_has(changed.err, "w.csv: has changed since");
  expect_has(changed.err, "--weight w.csv");
}

TEST(ObjectiveOfACommand, SaysWhatTheFitMadeSmall) {
  const SmallInputs inputs;
  const json height = printed_json(inputs, SmallInputs::plan()),
             slope = printed_json(inputs, SmallInputs::plan({"--objective", "slope"}));
  EXPECT_FALSE(height.contains("objective"));
  EXPECT_EQ(slope["objective"]["of"], "slope");
  const auto left = [](const json& plan) { return plan["surface"]["after"]["slope_rms_urad"]["total"].get<double>(); };
  EXPECT_LT(left(slope), left(height));
  const double length = slope["objective"]["slope_length_mm"].get<double>();
  EXPECT_NEAR(slope["objective"]["left_rms_nm"].get<double>(), length * left(slope), 0.1 * length * left(slope));
  expect_has(inputs.run(SmallInputs::plan({"--objective", "slope"})).out, "objective slope: slopes count times");
}

TEST(AbsoluteRemovalOfACommand, TakesAFileOfDepths) {
  const SmallInputs inputs;
  Words words = SmallInputs::plan({"--piston", "30"});
  *std::find(words.begin(), words.end(), "--map") = "--removal";
  const json made = printed_json(inputs, words);
  EXPECT_EQ(made["map"]["file"], "map.csv");
  EXPECT_EQ(made["map"]["removed"], "none");
  EXPECT_NEAR(made["residual"]["mean_nm"].get<double>(), 0.0, 0.5);
  EXPECT_EQ(printed_json(inputs, {"simulate", "plan"})["program"]["residual_rms_nm"],
            made["program"]["residual_rms_nm"]);
  // Over the map of a job file, it takes its place; of both on one command line none does.
  inputs.folder.file("job.toml", "map = 'map.csv'\nremove = 'tilt'\n");
  const json over = printed_json(inputs, with(words, {"--job", "job.toml"}));
  EXPECT_EQ(over["map"]["removed"], "tilt");
  const ProgramResult both = inputs.run(with(words, {"--map", "map.csv"}));
  EXPECT_EQ(both.exit_code, 2);
  expect_has(both.err, "--removal map.csv together with --map map.csv");
  const ProgramResult low = inputs.run(with(words, {"--piston", "0"}));
  EXPECT_EQ(low.exit_code, 2);  // given twice
  words[static_cast<std::size_t>(std::find(words.begin(), words.end(), "--piston") - words.begin()) + 1] = "0";
  expect_has(inputs.run(words).out, "the depth to remove is below 0 at ");
}

TEST(AbsoluteRemovalOfACommand, IsNotForARunFromMapToMap) {
  const SmallInputs inputs;
  inputs.folder.file("job.toml",
                     "map = 'map.csv'\nmap_pixel_mm = 0.5\ntif = 'tif.csv'\ntif_pixel_mm = 0.5\n"
                     "path = 'raster:pitch=1,overrun=2'\nremove = 'tilt'\npiston_nm = 3\n");
  const ProgramResult result = inputs.run({"figure", "new", "run", "--job", "job.toml"});
  EXPECT_EQ(result.exit_code, 2);
  expect_has(result.err, "--removal, --piston: a run goes from one measured map to the next");
}

}  // namespace
}  // namespace dwell
