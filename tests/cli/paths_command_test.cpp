#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;

std::vector<std::string> paths(const std::vector<std::string>& more) {
  std::vector<std::string> words = SmallInputs::plan(more);
  words[0] = "paths";
  const auto path = std::find(words.begin(), words.end(), "--path");
  if (std::find(more.begin(), more.end(), "--path") == more.end()) words.erase(path, path + 2);
  return words;
}

TEST(PathsCommand, PrintsATableAndWritesAPlanAFolder) {
  const SmallInputs inputs;
  const ProgramResult result = inputs.run(paths({"--paths", "raster,raster:angle=90,pitch=2", "--pitch", "1"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"residual[nm]", "total[s]", "length[mm]", "raster-2", "* on the Pareto front",
                           "pitch 1 mm where a path says none (given)", "written   plan"}) {
    expect_has(result.out, part);
  }
  for (const char* file : {"paths.csv", "paths.json", "paths.png", "psd.png", "raster/program.nc", "raster/path.png",
                           "raster-2/feed.csv", "raster-2/residual.npy"}) {
    EXPECT_TRUE(std::filesystem::exists(inputs / ("plan/" + std::string(file)))) << file;
  }
  const ProgramResult again = inputs.run(paths({"--paths", "raster", "--json"}));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, read_whole_file(inputs / "plan/paths.json"));
  EXPECT_FALSE(std::filesystem::exists(inputs / "plan/raster-2"));
}

TEST(PathsCommand, ListsTheKinds) {
  const SmallInputs inputs;
  const ProgramResult result = inputs.run({"paths", "--kinds"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* part : {"raster:pitch=MM", "nearest:cell=MM", "file:PATH.csv"}) expect_has(result.out, part);
}

TEST(PathsCommand, RefusesWhatIsWrongAndLeavesNothing) {
  const SmallInputs inputs;
  const auto refused = [&](const std::vector<std::string>& more, const std::vector<std::string>& parts) {
    const ProgramResult result = inputs.run(paths(more));
    EXPECT_EQ(result.exit_code, 2);
    for (const std::string& part : parts) expect_has(result.err, part);
    EXPECT_FALSE(std::filesystem::exists(inputs / "plan"));
  };
  refused({}, {"--paths: required", "--kinds"});
  refused({"--paths", "raster,zigzag"}, {"unknown kind \"zigzag\"", "accepted: raster"});
  refused({"--paths", "raster", "--pitch", "-1"}, {"--pitch", "-1", "from 1e-06"});
  refused({"--paths", "raster", "--path", "raster"}, {"unknown option --path"});
  refused({"--paths", "raster", "--map", "absent.csv"}, {"absent.csv"});
}

}  // namespace
}  // namespace dwell
