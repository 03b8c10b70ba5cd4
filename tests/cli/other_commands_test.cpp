#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/version.h"
#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"
#include "tests/core/map/same_map.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;

TEST(Help, OfEverySubcommandShowsAnExampleAndItsUnits) {
  const test::TemporaryFolder folder;
  for (const char* command : {"plan", "paths", "pareto", "simulate", "map", "profile", "tif", "example"}) {
    const ProgramResult result = test::run_program(folder.path(), {command, "--help"});
    EXPECT_EQ(result.exit_code, 0) << command;
    expect_has(result.out, "Example:\n  dwell " + std::string(command));
    expect_has(result.out, " mm");
    EXPECT_EQ(result.err, "") << command;
    expect_has(test::run_program(folder.path(), {"--help"}).out, command);
  }
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(Version, IsPrinted) {
  const test::TemporaryFolder folder;
  const ProgramResult result = test::run_program(folder.path(), {"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, std::string("dwell ") + version() + "\n");
}

TEST(Usage, WithoutOrWithAnUnknownCommandIsAnError) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(test::run_program(folder.path(), {}).exit_code, 2);
  EXPECT_EQ(test::run_program(folder.path(), {"plam"}).exit_code, 2);
}

TEST(MapCommand, PrintsSizePitchPvAndRms) {
  const SmallInputs inputs;
  inputs.folder.file("flat.csv", "1,1,nan\n1,5,1\n");
  const ProgramResult result = inputs.run({"map", "flat.csv", "--map-pixel", "0.5", "--remove", "piston"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_has(result.out, "flat.csv (sha256 " + sha256_of_file(inputs / "flat.csv") + ")");
  expect_has(result.out, "2 rows (y) x 3 columns (x), 1.5 mm in x, 1 mm in y");
  expect_has(result.out, "0.5 mm in x, 0.5 mm in y");
  expect_has(result.out, "5 of 6 pixels");
  expect_has(result.out, "4 nm (piston removed)");
  expect_has(result.out, "1.6 nm (piston removed)");  // sqrt((4 * 0.8^2 + 3.2^2) / 5)
}

TEST(MapCommand, ConvertsBetweenAllFormatsWithoutLoss) {
  const SmallInputs inputs;
  HeightMap map(Grid{3, 4, 0.25, 0.3, {-1.5, 2.0}});
  for (std::size_t i = 0; i < 12; ++i) map.values[i] = i == 5 ? std::nan("") : std::sin(static_cast<double>(i)) / 3.0;
  write_map(inputs / "a.csv", map);
  for (const auto& [from, to] : std::initializer_list<std::pair<const char*, const char*>>{
           {"a.csv", "b.xyz"}, {"b.xyz", "c.npy"}, {"c.npy", "d.sdf"}, {"d.sdf", "e.txt"}, {"e.txt", "f.csv"}}) {
    const ProgramResult result = inputs.run({"map", from, "--write", to});
    ASSERT_EQ(result.exit_code, 0) << from << ": " << result.err;
  }
  test::expect_same_map(read_map(inputs / "f.csv"), map);
  test::expect_same_map(read_map(inputs / "c.npy"), map);
}

TEST(MapCommand, WritesAHeightImage) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run({"map", "map.csv", "--map-pixel", "0.5", "--write-image", "map.png"}).exit_code, 0);
  const std::string png = read_whole_file(inputs / "map.png");
  EXPECT_EQ(png.substr(1, 3), "PNG");
  expect_has(png, "nm_per_level");
}

TEST(MapCommand, TellsFormSpectraAndProfile) {
  const SmallInputs inputs;
  const ProgramResult result = inputs.run(
      {"map", "map.csv", "--map-pixel", "0.5", "--form", "zernike-noll:1-6", "--psd", "--bands", "5,2", "--profile",
       "y=3", "--json=map.json", "--psd-png", "psd.png", "--profile-png", "profile.png", "--remove", "legendre:1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"PVr  ", "urad RMS in x, ", "Z4 defocus", "PSD rad", "band mid", "5 - 2 mm",
                           "profile   y = 3 mm", "(legendre:1 removed)"}) {
    expect_has(result.out, part);
  }
  const json report = json::parse(read_whole_file(inputs / "map.json"));
  EXPECT_EQ(report["form"]["terms"].size(), 6u);
  EXPECT_EQ(report["spectrum"]["bands"].size(), 3u);
  EXPECT_EQ(read_whole_file(inputs / "psd.png").substr(1, 3), "PNG");
  EXPECT_EQ(read_whole_file(inputs / "profile.png").substr(1, 3), "PNG");
}

TEST(MapCommand, EndsWithALimitReachedWhereASpectrumIsAboveItsLine) {
  const SmallInputs inputs;
  const ProgramResult above = inputs.run({"map", "map.csv", "--map-pixel", "0.5", "--limit", "1e-9,2"});
  EXPECT_EQ(above.exit_code, 3);
  expect_has(above.out, "EXCEEDED");
  EXPECT_EQ(inputs.run({"map", "map.csv", "--map-pixel", "0.5", "--limit", "1e9,2"}).exit_code, 0);
}

TEST(MapCommand, RefusesWrongOptionsBeforeItWritesAnything) {
  const SmallInputs inputs;
  const std::size_t before = inputs.folder.entries();
  for (const auto& [flag, value, word] : std::initializer_list<std::tuple<const char*, const char*, const char*>>{
           {"--form", "zernike:1-4", "ordering"},
           {"--remove", "coma", "coma"},
           {"--bands", "1,2", "descending"},
           {"--limit", "x", "radial:A,B"},
           {"--window", "kaiser", "tukey:R"},
           {"--profile", "y=99", "does not lie on the map"},
           {"--profile-png", "p.png", "--profile"}}) {
    const ProgramResult result =
        inputs.run({"map", "map.csv", "--map-pixel", "0.5", "--png", "map.png", "--json=map.json", flag, value});
    EXPECT_EQ(result.exit_code, 2) << flag;
    expect_has(result.err, word);
  }
  EXPECT_EQ(inputs.folder.entries(), before);
}

TEST(MapCommand, DrawsAPicture) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run({"map", "map.csv", "--map-pixel", "0.5", "--png", "map.png"}).exit_code, 0);
  EXPECT_EQ(read_whole_file(inputs / "map.png").substr(1, 3), "PNG");
}

TEST(MapCommand, DoesStepsInOrderAndContinuesTheHistory) {
  const SmallInputs inputs;
  const ProgramResult first = inputs.run({"map", "map.csv", "--map-pixel", "0.5", "--step", "decimate:2", "--step",
                                          "crop:rect:0,0,9,9;flip:x", "--write", "a.csv"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  expect_has(first.out, "made      decimate:factor=2 (11 x 15 pixels, 165 with data of 1 x 1 mm)\n");
  const ProgramResult second =
      inputs.run({"map", "a.csv", "--map-steps", "rotate:90", "--aperture", "circle:4.5,4.5,3", "--write", "b.xyz"});
  ASSERT_EQ(second.exit_code, 0) << second.err;
  const HeightMap map = read_map(inputs / "b.xyz");
  ASSERT_EQ(map.history.size(), 5u);
  EXPECT_EQ(map.history[1].substr(0, 18), "crop:rect:0,0,9,9 ");
  EXPECT_EQ(map.history[2].substr(0, 12), "flip:axis=x ");
  EXPECT_EQ(map.history[3].substr(0, 17), "rotate:degrees=90");
  EXPECT_EQ(map.history[4], "aperture circle:4.5,4.5,3");
  EXPECT_EQ(map.grid.rows, 9);
}

TEST(MapCommand, TakesOutMarksAndIndicesAsAsked) {
  const SmallInputs inputs;
  inputs.folder.file("bad.csv", ",0,1,2\n0,4,-9999,2\n1,3,5,8\n2,7,7,1\n");
  const ProgramResult result = inputs.run(
      {"map", "bad.csv", "--map-table", "mm", "--map-no-data", "-9999", "--map-unit", "um", "--write", "a.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_has(result.out, "made      no data: 1 pixel of -9999, as asked\n");
  const HeightMap map = read_map(inputs / "a.csv");
  EXPECT_EQ(map.grid, (Grid{3, 3, 1.0, 1.0, {}}));
  EXPECT_TRUE(std::isnan(map.at(0, 1)));
  EXPECT_EQ(map.at(1, 2), 8e3);
}

TEST(MapCommand, ListsTheStepsAndRefusesOthers) {
  const SmallInputs inputs;
  const ProgramResult listed = inputs.run({"map", "--steps"});
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  expect_has(listed.out, "--step 'resample:pitch=0.2'");
  expect_has(listed.out, "default 5)");
  for (const auto& [step, word] : {std::pair{"polish:1", "unknown step"}, {"", "empty"}, {"fill:smooth", "harmonic"}}) {
    const ProgramResult result =
        inputs.run({"map", "map.csv", "--map-pixel", "0.5", "--step", step, "--write", "out.csv"});
    EXPECT_EQ(result.exit_code, 2);
    expect_has(result.err, word);
    EXPECT_FALSE(std::filesystem::exists(inputs / "out.csv"));
  }
}

TEST(SimulateCommand, AgreesWithThePlanForTheTableAndForTheProgram) {
  for (const char* gcode : {"g94", "g93-per-minute", "g93-seconds"}) {
    const SmallInputs inputs;
    ASSERT_EQ(inputs.run(SmallInputs::plan({"--gcode", gcode})).exit_code, 0);
    const json plan = json::parse(read_whole_file(inputs / "plan/summary.json"));
    const double expected = plan["program"]["residual_rms_nm"], before = plan["map"]["rms_nm"];
    for (const auto& [program, tolerance] : {std::pair{"plan/program.nc", 1e-12}, {"plan/feed.csv", 1e-5}}) {
      const ProgramResult result =
          inputs.run({"simulate", "--program", program, "--map", "map.csv", "--map-pixel", "0.5", "--tif", "tif.csv",
                      "--tif-pixel", "0.5", "--threads", "1", "--json", "--residual", "left.npy"});
      ASSERT_EQ(result.exit_code, 0) << result.err;
      const json s = json::parse(result.out);
      EXPECT_NEAR(s["program"]["residual_rms_nm"].get<double>(), expected, tolerance * expected)
          << gcode << " " << program;
      EXPECT_NEAR(s["map"]["rms_nm"].get<double>(), before, 1e-12 * before);
      EXPECT_EQ(s["inputs"].size(), 3u);
    }
    const HeightMap left = read_map(inputs / "left.npy"), planned = read_map(inputs / "plan/residual.npy");
    EXPECT_EQ(left.grid, planned.grid);
    for (std::size_t i = 0; i < left.values.size(); ++i) EXPECT_NEAR(left.values[i], planned.values[i], 1e-3);
  }
}

TEST(SimulateCommand, PrintsBeforeAndAfterWithUnits) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  const ProgramResult result =
      inputs.run({"simulate", "--program", "plan/program.nc", "--map", "map.csv", "--map-pixel", "0.5", "--tif",
                  "tif.csv", "--tif-pixel", "0.5", "--png", "left.png"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"program   plan/program.nc", "before    RMS ", "after     RMS ", " nm", " s\n"})
    expect_has(result.out, part);
  EXPECT_EQ(read_whole_file(inputs / "left.png").substr(1, 3), "PNG");
}

TEST(SimulateCommand, StatesTheExactFigureAndHowItWasFound) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  const auto simulate = [&](const std::string& tif, std::vector<std::string> more) {
    std::vector<std::string> words{"simulate",    "--program", "plan/program.nc", "--map", "map.csv",
                                   "--map-pixel", "0.5",       "--tif",           tif,     "--other-tif"};
    words.insert(words.end(), more.begin(), more.end());
    return inputs.run(words);
  };
  const std::string disc = "disc:slope=1,radius=2";
  const ProgramResult told = simulate(disc, {"--exact"});
  ASSERT_EQ(told.exit_code, 0) << told.err;
  expect_has(told.out, "exact     from the removal function itself at all ");
  expect_has(told.out, "ripple    RMS ");
  const json exact = json::parse(simulate(disc, {"--exact", "--json"}).out),
             fast = json::parse(simulate(disc, {"--json"}).out);
  EXPECT_EQ(exact["program"]["pixels_checked"], exact["map"]["valid_pixels"]);
  EXPECT_EQ(exact["program"]["residual_rms_standard_error_nm"], 0.0);
  EXPECT_GT(exact["program"]["ripple_within_pixels_rms_nm"], 0.0);
  const double rms = exact["program"]["residual_rms_nm"];
  EXPECT_NEAR(fast["program"]["residual_rms_nm"], rms, 0.03 * rms);
}

// RMS and PV are about the same figure, whatever form is removed, and both commands say which.
TEST(SimulateCommand, MeasuresAsThePlanDoes) {
  const SmallInputs inputs;
  for (const char* removed : {"none", "piston", "piston,tilt"}) {
    ASSERT_EQ(inputs.run(SmallInputs::plan({"--remove", removed})).exit_code, 0);
    const json plan = json::parse(read_whole_file(inputs / "plan/summary.json"));
    const std::vector<std::string> words{
        "simulate", "--program", "plan/program.nc", "--map", "map.csv",  "--map-pixel", "0.5",
        "--tif",    "tif.csv",   "--tif-pixel",     "0.5",   "--remove", removed};
    const json s = json::parse(inputs.run(test::with(words, {"--json"})).out);
    for (const char* key : {"removed", "residual_rms_nm", "residual_pv_nm", "residual_mean_nm"})
      EXPECT_EQ(s["program"][key], plan["program"][key]) << key;
    EXPECT_EQ(s["program"]["removed"], removed);
    EXPECT_LE(s["program"]["residual_rms_nm"].get<double>(), 0.5 * s["program"]["residual_pv_nm"].get<double>());
    EXPECT_LE(s["map"]["rms_nm"].get<double>(), 0.5 * s["map"]["pv_nm"].get<double>());
    expect_has(inputs.run(words).out, std::string(" (") + removed + " removed)\n");
  }
}

TEST(SimulateCommand, AsksForTheUnitOfAHaltAndSaysWhatWasLeftOpen) {
  const SmallInputs inputs;
  inputs.folder.file("a.nc", "G90 G94\nG0 Z5\nG0 X3 Y4\nG1 Z0 F600\nG4 P500\nG1 X4 F60\nM2\n");
  const auto simulate = [&](const test::Words& more) {
    return inputs.run(test::with({"simulate", "--program", "a.nc", "--map", "map.csv", "--map-pixel", "0.5", "--tif",
                                  "tif.csv", "--tif-pixel", "0.5"},
                                 more));
  };
  const ProgramResult refused = simulate({});
  EXPECT_EQ(refused.exit_code, 2);
  expect_has(refused.err, "a.nc, line 5: G4 P500: a whole number is seconds on some controllers");
  const ProgramResult read = simulate({"--g4", "ms"});
  ASSERT_EQ(read.exit_code, 0) << read.err;
  expect_has(read.out, "2.00 s\n          the program names no unit (G21): read as millimetres\n");
  EXPECT_EQ(json::parse(simulate({"--g4", "s", "--json"}).out)["program"]["total_s"], 501.5);
  EXPECT_EQ(simulate({"--g4", "min"}).exit_code, 2);
}

// Names of files may hold any byte: they are read, and shown escaped where text must be UTF-8.
TEST(FileNames, MayBeNoUtf8) {
  const SmallInputs inputs;
  const std::string map = "m\xE9tal.csv", out = "r\xE9sultat";
  std::filesystem::rename(inputs / "map.csv", inputs / map);
  const ProgramResult looked = inputs.run(
      {"map", map, "--map-pixel", "0.5", "--json", "--step", "flip:x", "--png", "\xE9.svg", "--write", "\xE9.npy"});
  ASSERT_EQ(looked.exit_code, 0) << looked.err;
  EXPECT_EQ(json::parse(looked.out)["map"]["file"], "m\\xE9tal.csv");
  EXPECT_TRUE(std::filesystem::exists(inputs / "\xE9.npy.json"));
  const ProgramResult planned = inputs.run(SmallInputs::plan({"--map", map, "--out", out, "--json"}));
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  EXPECT_EQ(json::parse(planned.out)["options"]["map"], "m\\xE9tal.csv");
  EXPECT_EQ(json::parse(read_whole_file(inputs / (out + "/summary.json"))), json::parse(planned.out));
  expect_has(read_whole_file(inputs / (out + "/feed.csv")), "m\\xE9tal.csv");
  expect_has(read_whole_file(inputs / (out + "/program.nc")), "m?tal.csv");  // controllers read ASCII alone
  const ProgramResult simulated = inputs.run({"simulate", "--program", out + "/program.nc", "--map", map, "--map-pixel",
                                              "0.5", "--tif", "tif.csv", "--tif-pixel", "0.5", "--json"});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  EXPECT_EQ(json::parse(simulated.out)["program"]["file"], "r\\xE9sultat/program.nc");
  const ProgramResult job = inputs.run(SmallInputs::plan({"--map", map, "--write-job"}));
  EXPECT_EQ(job.exit_code, 2);
  expect_has(job.err, "--map 'm\\xE9tal.csv': a job file is UTF-8");
}

TEST(ExampleCommand, MakesAJobThatPlans) {
  const SmallInputs inputs;
  const ProgramResult made =
      inputs.run({"example", "--out", "demo", "--width", "30", "--shape", "rectangle", "--height", "24"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ProgramResult planned =
      inputs.run({"plan", "--job", "demo/demo.toml", "--smoothness", "1", "--out", "plan", "--json"});
  EXPECT_EQ(planned.exit_code, 0) << planned.err;
  EXPECT_LT(json::parse(planned.out)["residual"]["rms_nm"], json::parse(planned.out)["map"]["rms_nm"]);
}

TEST(ExampleCommand, ReplacesAnEarlierExampleAndNoOtherFolder) {
  const SmallInputs inputs;
  const auto make = [&](const char* out, const char* seed) {
    return inputs.run({"example", "--out", out, "--width", "20", "--seed", seed});
  };
  ASSERT_EQ(make("demo", "1").exit_code, 0);
  const std::string first = read_whole_file(inputs / "demo/mirror.csv");
  ASSERT_EQ(make("demo", "2").exit_code, 0);
  EXPECT_NE(read_whole_file(inputs / "demo/mirror.csv"), first);
  std::filesystem::create_directory(inputs / "mine");
  inputs.folder.file("mine/holiday.jpg", "x");
  const ProgramResult refused = make("mine", "1");
  EXPECT_EQ(refused.exit_code, 2);
  expect_has(refused.err, "not an earlier example");
  EXPECT_FALSE(std::filesystem::exists(inputs / "mine/mirror.csv"));
}

TEST(MapCommand, SaysOnStandardErrorWhichLimitWasReached) {
  const SmallInputs inputs;
  const ProgramResult above = inputs.run({"map", "map.csv", "--map-pixel", "0.5", "--limit", "1e-9,2", "--json"});
  EXPECT_EQ(above.exit_code, 3);
  expect_has(above.err, "dwell: limit reached: the x spectrum is up to ");
  const json limits = json::parse(above.out)["limits"];
  EXPECT_EQ(limits.size(), 2u);
  expect_has(above.err, limits[0]);
}

// The demo is the example: its job file says what every option is, and must not say what it was.
TEST(ExampleCommand, IsTheDemoOfTheSources) {
  const std::filesystem::path demo = DWELL_SOURCE_DIR "/data";
  if (!std::filesystem::is_directory(demo)) GTEST_SKIP() << "no folder data beside the sources";
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run({"example", "--out", "demo"}).exit_code, 0);
  for (const char* file : {"demo.toml", "mirror.csv", "tif.csv"}) {
    EXPECT_TRUE(read_whole_file(inputs / "demo" / file) == read_whole_file(demo / file)) << file;
  }
}

}  // namespace
}  // namespace dwell
