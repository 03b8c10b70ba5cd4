#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"
#include "tests/core/tif/calibration/spot_truth.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;

/// The folder of a user with two spots of 4 s on a tilted part.
struct SpotInputs : SmallInputs {
  SpotInputs() {
    const Grid grid{90, 140, 0.15, 0.15, {-10.0, -7.0}};
    write_map(*this / "after.csv", test::after_spots(grid, {{-4.52, -0.31}, {5.01, 0.77}}, 4.0, 0.1, 2));
  }
};

TEST(TifCommand, FromSpotsToAPlan) {
  const SpotInputs inputs;
  const ProgramResult made = inputs.run({"tif", "--spot", "after.csv", "--dwell-time", "4", "--fit", "gaussian,mrf",
                                         "--write", "spot.csv", "--json=spot.json", "--png", "spot.png", "--fit-png",
                                         "fit.png", "--mtf-png", "mtf.png", "--threads", "1"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  for (const char* part : {"spots     2", "peak ", " nm/s", "FWHM", " mm along x", "fit       ", "+-"})
    expect_has(made.out, part);
  for (const char* picture : {"spot.png", "fit.png", "mtf.png"})
    EXPECT_EQ(read_whole_file(inputs / picture).substr(1, 3), "PNG");
  const json j = json::parse(read_whole_file(inputs / "spot.json"));
  EXPECT_EQ(j["spots"]["each"].size(), 2u);
  const ProgramResult planned =
      inputs.run(SmallInputs::plan({"--tif", "spot.csv", "--tif-pixel", "0.15", "--tif-centre", "0,0", "--json"}));
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  EXPECT_NEAR(json::parse(planned.out)["tif"]["peak_nm_per_s"].get<double>(), j["tif"]["peak_nm_per_s"].get<double>(),
              1e-9);
  const ProgramResult again = inputs.run({"tif", "spot.csv", "--tif-centre", "0,0"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(inputs.run({"map", "spot.csv"}).exit_code, 2);
}

TEST(TifCommand, LooksAtAModelAndPlansWithIt) {
  const SmallInputs inputs;
  const std::string model = "planetary:radius=1,eccentricity=0.8,ratio=-1,peak=20";
  const ProgramResult shown = inputs.run({"tif", model, "--write", "p.xyz"});
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  expect_has(shown.out, "planetary: ");
  const ProgramResult planned = inputs.run(SmallInputs::plan({"--tif", model, "--json"}));
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  EXPECT_EQ(json::parse(planned.out)["tif"]["kind"], "planetary");
  const ProgramResult disc = inputs.run({"tif", "disc:slope=1,radius=1.5"});
  for (const char* part : {"peak      1.5 nm/s; the largest sample at (", "centroid  (0, 0) mm from the tool axis",
                           "FWHM      3 mm along x, 3 mm along y, 2.598 mm of equal area", "asymmetry 0 "})
    expect_has(disc.out, part);
  const ProgramResult turned =
      inputs.run(SmallInputs::plan({"--tif", "mrf:lead=2,trail=0.8,width=2,peak=9", "--tif-angle", "45", "--json"}));
  EXPECT_EQ(turned.exit_code, 0) << turned.err;
}

TEST(TifCommand, PreparesTheMapsOfSpotsBySteps) {
  const SpotInputs inputs;
  const auto places = [&](const char* steps) {
    const ProgramResult result = inputs.run(
        {"tif", "--spot", "after.csv", "--dwell-time", "4", "--threads", "1", "--map-steps", steps, "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const json printed = json::parse(result.out);
    std::vector<double> x;
    for (const json& spot : printed["spots"]["each"]) x.push_back(spot["x_mm"]);
    std::sort(x.begin(), x.end());
    return x;
  };
  // The map reaches from -10 to 10.85 mm: what was at x is at 0.85 - x.
  const std::vector<double> before = places("flip:y"), after = places("flip:x");
  ASSERT_EQ(before.size(), 2u);
  ASSERT_EQ(after.size(), 2u);
  EXPECT_NEAR(after[0], 0.85 - before[1], 0.01);
  EXPECT_NEAR(after[1], 0.85 - before[0], 0.01);
}

TEST(TifCommand, NamesWhatIsWrong) {
  const SpotInputs inputs;
  struct Case {
    std::vector<std::string> words;
    std::vector<std::string> message;
  };
  const std::vector<Case> cases{
      {{}, {"one of", "--spot"}},
      {{"--spot", "after.csv"}, {"--dwell-time", "required"}},
      {{"--spot", "after.csv", "--dwell-time", "0"}, {"--dwell-time: '0'; required a number from 1e-09", "from 1e-09"}},
      {{"--spot", "after.csv", "--dwell-time", "nan"}, {"--dwell-time"}},
      {{"--spot", "after.csv", "--dwell-time", "4", "--before", "map.csv"}, {"map.csv", "--map-pixel"}},
      {{"--spot", "after.csv", "--dwell-time", "4", "--at", "0,0"}, {"--at 0,0", "no spot there"}},
      {{"--spot", "after.csv", "--dwell-time", "4", "--fit-png", "f.png"}, {"--fit-png", "--fit"}},
      {{"--trench", "after.csv"}, {"--feed", "required"}},
      {{"tif.csv", "--tif-pixel", "0.5", "--map-steps", "flip:x"}, {"--map-steps", "--spot or --trench"}},
      {{"planetary:radius=1,peak=2"}, {"eccentricity", "missing"}},
      {{"planatary:radius=1,peak=2"}, {"'planatary'", "accepted", "planetary"}},
      {{"mrf:lead=1,trail=1,width=1,peak=1", "--tif-angle", "1e9"}, {"--tif-angle", "-360 to 360"}},
      {{"tif.csv", "--tif-pixel", "0.5", "--tif-flip", "z"}, {"--tif-flip", "'z'", "none, x, y"}},
  };
  for (const Case& c : cases) {
    std::vector<std::string> words{"tif"};
    words.insert(words.end(), c.words.begin(), c.words.end());
    const ProgramResult result = inputs.run(words);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    for (const std::string& part : c.message) expect_has(result.err, part);
  }
  EXPECT_FALSE(std::filesystem::exists(inputs / "f.png"));
}

}  // namespace
}  // namespace dwell
