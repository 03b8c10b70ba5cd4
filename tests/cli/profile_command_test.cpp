#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

#include "core/base/whole_file.h"
#include "core/profile/ellipse_mirror.h"
#include "tests/cli/program_run.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::TemporaryFolder;

/// A NOM's file of an elliptical mirror, slopes of the other sign, pole at x = 90 mm, 0.5 urad of ripple.
std::string nom_text() {
  std::string text = "#measuring device: NOM\r\n#residual slope [urad]: 0.5\r\n#x-position [mm]; y-slope [urad]\r\n";
  for (int i = 0; i < 401; ++i) {
    const double x = 0.5 * i;
    const double slope = 1e6 * ellipse_at({7500.0, 2500.0, 0.6 * std::acos(-1.0) / 180.0}, x - 90.0).slope;
    text += fmt::format("{:.2f}\t{:.7f}\r\n", x, -(slope + 0.5 * std::sqrt(2.0) * std::sin(0.2 * x) + 31.0));
  }
  return text;
}

const std::string kEllipse = "ellipse:p=7500,q=2500,angle=0.6";

TEST(ProfileCommand, TakesTheEllipseOutAndWritesWhatItReadsBack) {
  const TemporaryFolder folder;
  folder.file("nom.dat", nom_text());
  const ProgramResult result =
      test::run_program(folder.path(), {"profile", "nom.dat", "--columns", "x,slope", "--unit", "mm,-urad", "--remove",
                                        kEllipse, "--write", "rest.csv", "--png", "rest.png", "--json=rest.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_has(result.out, "0.5 mm apart");
  expect_has(result.out, "(fitted)");
  const json printed = json::parse(read_whole_file(folder.path() / "rest.json"));
  EXPECT_EQ(printed["profile"]["places"], 401);
  EXPECT_EQ(printed["profile"]["value_unit"], "-urad");
  EXPECT_NEAR(printed["removed"]["pole_mm"].get<double>(), 90.0, 2.0);
  EXPECT_NEAR(printed["after"]["slope_rms_urad"].get<double>(), 0.5, 0.01);
  EXPECT_GT(printed["before"]["slope_rms_urad"].get<double>(), 100.0);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "rest.png"));
  const ProgramResult again = test::run_program(folder.path(), {"profile", "rest.csv", "--remove", "none", "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(json::parse(again.out)["after"], printed["after"]);
}

TEST(ProfileCommand, WritesAStripThatAPlanCorrects) {
  const TemporaryFolder folder;
  folder.file("nom.dat", nom_text());
  const ProgramResult made = test::run_program(folder.path(), {"profile", "nom.dat", "--unit", "mm,-urad", "--remove",
                                                               kEllipse, "--write-map", "line.npy", "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  std::string track = "x_mm,y_mm\n";
  for (int i = -10; i <= 210; ++i) track += fmt::format("{},0\n", i);
  folder.file("track.csv", track);
  const ProgramResult planned =
      test::run_program(folder.path(), {"plan", "--map", "line.npy", "--tif", "gaussian:peak=1,fwhm=8,radius=12",
                                        "--path", "file:track.csv", "--time-price", "0", "--out", "plan", "--json"});
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  const json plan = json::parse(planned.out);
  EXPECT_EQ(plan["map"]["rows"], 1);
  EXPECT_EQ(plan["map"]["columns"], 401);
  const auto slope = [&plan](const char* when) {
    return plan["surface"][when]["slope_rms_urad"]["total"].get<double>();
  };
  // From pixel to pixel, of a ripple of 31 mm: the slope of the profile.
  EXPECT_NEAR(slope("before"), json::parse(made.out)["after"]["slope_rms_urad"].get<double>(), 0.01);
  EXPECT_LT(slope("after"), 0.3 * slope("before"));
}

TEST(ProfileCommand, IsPlannedOnWithoutAMapInBetween) {
  const TemporaryFolder folder;
  folder.file("nom.dat", nom_text());
  const std::vector<std::string> profile{"--line-profile", "nom.dat",          "--profile-unit",
                                         "mm,-urad",       "--profile-remove", kEllipse};
  const std::vector<std::string> tool{"--tif", "gaussian:peak=1,fwhm=8,radius=12"};
  const auto run = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    for (const auto* part : {&profile, &tool, &more}) words.insert(words.end(), part->begin(), part->end());
    return test::run_program(folder.path(), words);
  };
  const ProgramResult planned = run({"plan"}, {"--path", "line:step=2", "--out", "plan", "--accept", "slope<=1urad"});
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  expect_has(planned.out, "accept    slope ");
  const json plan = json::parse(read_whole_file(folder.path() / "plan/summary.json"));
  EXPECT_EQ(plan["map"]["file"], "nom.dat");
  EXPECT_EQ(plan["map"]["rows"], 1);
  expect_has(plan["map"]["history"][0].get<std::string>(), "pole at x = ");
  EXPECT_NEAR(plan["surface"]["before"]["slope_rms_urad"]["total"].get<double>(), 0.5, 0.01);
  EXPECT_EQ(plan["inputs"][0]["role"], "profile");

  const ProgramResult again = test::run_program(folder.path(), {"simulate", "plan", "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(json::parse(again.out)["map"]["file"], "nom.dat");
  EXPECT_NEAR(json::parse(again.out)["program"]["residual_rms_nm"].get<double>(),
              plan["program"]["residual_rms_nm"].get<double>(), 1e-6);
  const ProgramResult alone = run({"simulate", "--program", "plan/program.nc"}, {});
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(alone.out.find("differs"), std::string::npos) << alone.out;
  // Another file in the profile's place must be meant, and a map may take it.
  folder.file("nom.dat", nom_text() + "\n");
  const ProgramResult changed = test::run_program(folder.path(), {"simulate", "plan"});
  EXPECT_EQ(changed.exit_code, 2);
  expect_has(changed.err, "--line-profile");
  ASSERT_EQ(test::run_program(folder.path(), {"profile", "nom.dat", "--unit", "mm,-urad", "--remove", kEllipse,
                                              "--write-map", "line.npy"})
                .exit_code,
            0);
  const ProgramResult on_map = test::run_program(folder.path(), {"simulate", "plan", "--map", "line.npy"});
  EXPECT_EQ(on_map.exit_code, 0) << on_map.err;
  expect_has(on_map.out, "differs   map given instead of the plan's: line.npy; the plan's is none");
}

TEST(ProfileCommand, HintsAtAFormThatIsStillInTheHeights) {
  const TemporaryFolder folder;
  folder.file("nom.dat", nom_text());
  const ProgramResult raw = test::run_program(folder.path(), {"profile", "nom.dat", "--unit", "mm,-urad"});
  ASSERT_EQ(raw.exit_code, 0) << raw.err;
  expect_has(raw.out, "hint      the heights span 14.03 um");
  const ProgramResult formless =
      test::run_program(folder.path(), {"profile", "nom.dat", "--unit", "mm,-urad", "--remove", kEllipse});
  EXPECT_EQ(formless.out.find("hint "), std::string::npos) << formless.out;
}

TEST(ProfileCommand, SaysTheOtherSignAndRefusesWithFlags) {
  const TemporaryFolder folder;
  folder.file("nom.dat", nom_text());
  const auto refused = [&folder](const std::vector<std::string>& more, const std::string& word) {
    std::vector<std::string> words{"profile", "nom.dat"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = test::run_program(folder.path(), words);
    EXPECT_EQ(result.exit_code, 2) << word;
    expect_has(result.err, word);
  };
  refused({"--remove", kEllipse}, "the other sign of the values would leave");
  refused({"--remove", "ellipse:p=7500"}, "--remove: form \"ellipse:p=7500\"");
  refused({"--unit", "mm,mrad"}, "--unit says 'mrad'");
  refused({"--columns", "x,phase"}, "--columns: no column is named 'phase'");
  refused({"--write", "nom.dat"}, "--write");
  refused({"--write", "a.xyz"}, ".csv");
  refused({"--line-width", "5"}, "--line-width: of --write-map");
  refused({"--write-map", "a.npy", "--line-width", "5.2"}, "--line-width = 5.2 mm; required a multiple of the 0.5 mm");
  EXPECT_EQ(test::run_program(folder.path(), {"profile", "none.dat"}).exit_code, 2);
}

}  // namespace
}  // namespace dwell
