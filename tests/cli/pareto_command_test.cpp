#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::names_in;
using test::ProgramResult;
using test::SmallInputs;

std::vector<std::string> pareto(const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = SmallInputs::plan(more);
  words[0] = "pareto";
  const auto price = std::find(words.begin(), words.end(), "--time-price");  // which a sweep does not take
  words.erase(price, price + 2);
  return words;
}

TEST(ParetoCommand, RefusesAJobThatLeavesBlemishesOut) {
  const SmallInputs inputs;
  inputs.folder.file("job.toml", "schema = 2\nblemishes = 'leave-out'\n");
  const ProgramResult result = inputs.run(pareto({"--job", "job.toml", "--out", "sweep"}));
  EXPECT_EQ(result.exit_code, 2);
  for (const char* part : {"blemishes = leave-out", "report or keep", "blemishes:width=MM"})
    expect_has(result.err, part);
}

TEST(ParetoCommand, WritesTableAndPictureAndPrintsTheFront) {
  const SmallInputs inputs;
  const ProgramResult result =
      inputs.run(pareto({"--smoothnesses", "0.01:1:3", "--time-prices", "0,1e-3", "--out", "sweep"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in(inputs / "sweep"), (std::set<std::string>{"pareto.csv", "pareto.png", "pareto.json"}));
  EXPECT_EQ(names_in(inputs.folder.path()), (std::set<std::string>{"map.csv", "tif.csv", "sweep"}));
  for (const char* part : {"solves    6, ", " on the Pareto front", "residual RMS [nm]", "dwell [s]", "run [s]",
                           "residual: exact", "step RMS [s]", "time price [nm^2/s]", "written   sweep\n"}) {
    expect_has(result.out, part);
  }
  const std::string table = read_whole_file(inputs / "sweep/pareto.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7);
  EXPECT_EQ(read_whole_file(inputs / "sweep/pareto.png").substr(1, 3), "PNG");
  const json s = json::parse(read_whole_file(inputs / "sweep/pareto.json"));
  EXPECT_EQ(s["schema"], 2);
  EXPECT_EQ(s["inputs"].size(), 2u);
  EXPECT_EQ(s["inputs"][0]["sha256"], sha256_of_file(inputs / "map.csv"));
  EXPECT_EQ(s["points"].size(), 6u);
}

TEST(ParetoCommand, JsonPrintsTheFileAndReplacesAnEarlierSweep) {
  const SmallInputs inputs;
  const std::vector<std::string> words = pareto({"--smoothnesses", "0.1", "--time-prices", "0", "--json"});
  ASSERT_EQ(inputs.run(words).exit_code, 0);
  const ProgramResult again = inputs.run(words);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, read_whole_file(inputs / "plan/pareto.json"));
}

TEST(ParetoCommand, TakesAJobFileWhateverItsWeights) {
  const SmallInputs inputs;
  inputs.folder.file("job.toml",
                     "map = 'map.csv'\nmap_pixel_mm = 0.5\ntif = 'tif.csv'\ntif_pixel_mm = 0.5\nthreads = 1\n"
                     "path = 'raster:pitch=1,overrun=2'\nsmoothness = 'auto'\nout = 'sweep'\n");
  const ProgramResult result =
      inputs.run({"pareto", "--job", "job.toml", "--smoothnesses", "0.1,1", "--time-prices", "0"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  expect_has(result.out, "solves    2, ");
}

TEST(ParetoCommand, ALimitIsSaidWithExitCode3) {
  const SmallInputs inputs;
  const ProgramResult result = inputs.run(pareto({"--smoothnesses", "0.1", "--max-solve", "1e-9"}));
  EXPECT_EQ(result.exit_code, 3);
  expect_has(result.err, "limit reached: 5 of 5 solves did not converge");
  EXPECT_TRUE(std::filesystem::exists(inputs / "plan/pareto.csv"));
}

TEST(ParetoCommand, WrongInputsAreRefusedNamedAndLeaveNothingBehind) {
  const SmallInputs inputs;
  std::filesystem::create_directory(inputs / "mine");
  inputs.folder.file("mine/holiday.jpg", "x");
  const auto before = names_in(inputs.folder.path());
  const auto refused = [&](const std::vector<std::string>& more, const std::vector<std::string>& parts) {
    const ProgramResult result = inputs.run(pareto(more));
    EXPECT_EQ(result.exit_code, 2) << more[1];
    EXPECT_EQ(result.out, "");
    for (const std::string& part : parts) expect_has(result.err, part);
    EXPECT_EQ(names_in(inputs.folder.path()), before);
  };
  refused({"--smoothnesses", "1:2"}, {"--smoothnesses", "'1:2'", "FROM:TO:COUNT"});
  refused({"--time-prices", "-1"}, {"--time-prices", "'-1'", ">= 0"});
  refused({"--smoothness", "0.1"}, {"unknown option --smoothness", "'dwell pareto --help'"});
  refused({"--map", "absent.csv"}, {"absent.csv", "No such file"});
  refused({"--out", "mine"}, {"--out", "'mine'", "not an earlier pareto sweep", "holiday.jpg"});
}

TEST(ParetoCommand, DoesNotReplaceAPlan) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  const ProgramResult result = inputs.run(pareto());
  EXPECT_EQ(result.exit_code, 2);
  expect_has(result.err, "not an earlier pareto sweep");
  EXPECT_TRUE(std::filesystem::exists(inputs / "plan/program.nc"));
}

}  // namespace
}  // namespace dwell
