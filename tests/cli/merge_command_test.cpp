/// A sweep done in shards and merged is, byte for byte, the sweep done at once.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>

#include "core/base/whole_file.h"
#include "tests/cli/documented_runs.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;
using test::with;
using test::Words;

/// Does a command in shards, each into parts-NAME/K, and gives the words that merge them, the last part first.
Words merge_of_shards(const SmallInputs& inputs, const std::string& name, const Words& command, int shards) {
  Words merge{"merge"};
  for (int k = shards; k >= 1; --k) {
    const std::string out = "parts-" + name + "/" + std::to_string(k);
    const ProgramResult part = inputs.run(with(command, {"--shard", fmt::format("{}/{}", k, shards), "--out", out}));
    EXPECT_EQ(part.exit_code, 0) << part.err;
    expect_has(part.out, fmt::format("part      {}/{} of dwell ", k, shards));
    merge.push_back(out);
  }
  return merge;
}

/// A text with the seconds that tasks took where they ran, which no two runs have alike, masked: "wall_s" of JSON, and
/// those of the solves that dwell pareto prints.
std::string without_wall_seconds(std::string text) {
  static const std::regex kOfJson(R"re("wall_s": [-+.0-9e]+)re"), kPrinted(R"(applications?, [.0-9]+ s)");
  text = std::regex_replace(text, kOfJson, "\"wall_s\": *");
  return std::regex_replace(text, kPrinted, "applications, * s");
}

/// All files below a folder; tables and JSON without wall seconds, all others as they are.
std::map<std::string, std::string> files_below(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::string bytes = read_whole_file(entry.path());
    if (entry.path().extension() == ".json") bytes = without_wall_seconds(std::move(bytes));
    files[std::filesystem::relative(entry.path(), folder).string()] = std::move(bytes);
  }
  return files;
}

/// The command done at once into whole/, then in shards and merged into the same folder: everything is the same.
void expect_merged_as_at_once(const SmallInputs& inputs, const Words& command, int shards, int exit_code,
                              std::size_t least_files) {
  const ProgramResult at_once = inputs.run(with(command, {"--out", "whole", "--json=at-once.json"}));
  EXPECT_EQ(at_once.exit_code, exit_code) << at_once.err;
  const auto files = files_below(inputs / "whole");
  EXPECT_GE(files.size(), least_files);
  std::filesystem::remove_all(inputs / "whole");
  const Words merge = with(merge_of_shards(inputs, command[0], command, shards), {"--out", "whole"});
  EXPECT_FALSE(std::filesystem::exists(inputs / "whole"));
  const ProgramResult merged = inputs.run(with(merge, {"--json=merged.json"}));
  EXPECT_EQ(merged.exit_code, exit_code);
  EXPECT_EQ(without_wall_seconds(merged.out), without_wall_seconds(at_once.out));
  const auto limits = [](const std::string& said) { return said.substr(std::min(said.find("dwell: "), said.size())); };
  EXPECT_EQ(limits(merged.err), limits(at_once.err));
  const auto again = files_below(inputs / "whole");
  ASSERT_EQ(again.size(), files.size());
  for (const auto& [name, bytes] : files) EXPECT_TRUE(again.at(name) == bytes) << name;
  EXPECT_EQ(without_wall_seconds(read_whole_file(inputs / "merged.json")),
            without_wall_seconds(read_whole_file(inputs / "at-once.json")));
}

struct RunToSimulate : SmallInputs {
  RunToSimulate() {
    EXPECT_EQ(run({"figure", "new", "run", "--map", "map.csv", "--map-pixel", "0.5", "--tif", "tif.csv", "--tif-pixel",
                   "0.5", "--threads", "1", "--path", "raster:pitch=1,overrun=2", "--time-price", "0"})
                  .exit_code,
              0);
  }
  static Words simulate(const Words& more, const std::string& samples = "4", const std::string& runs = "2") {
    return with({"figure", "simulate", "run", "--runs", runs, "--samples", samples, "--uncertainty",
                 "tif-rate=12.3%,offset=0.1mm,metrology=0.3nm"},
                more);
  }
};

TEST(MergeCommand, PrintsWhatTheCampaignsPrintAtOnce) {
  const RunToSimulate inputs;
  const Words merge = merge_of_shards(inputs, "s", RunToSimulate::simulate({}), 3);
  const ProgramResult whole = inputs.run(RunToSimulate::simulate({"--json=whole.json"}));
  const ProgramResult merged = inputs.run(with(merge, {"--json=merged.json"}));
  EXPECT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(merged.out, whole.out);
  EXPECT_EQ(read_whole_file(inputs / "merged.json"), read_whole_file(inputs / "whole.json"));
  EXPECT_EQ(inputs.run(with(merge, {"--json"})).out, read_whole_file(inputs / "whole.json"));
}

TEST(MergeCommand, WritesTheSweepOfWeightsThatAtOnceIsWritten) {
  const SmallInputs inputs;
  const Words pareto{"pareto",
                     "--map",
                     "map.csv",
                     "--map-pixel",
                     "0.5",
                     "--tif",
                     "tif.csv",
                     "--tif-pixel",
                     "0.5",
                     "--threads",
                     "1",
                     "--path",
                     "raster:pitch=1,overrun=2",
                     "--figures",
                     "png,svg,pdf"};
  expect_merged_as_at_once(inputs, with(pareto, {"--smoothnesses", "0.1"}), 3, 0, 5);
}

// Each of its solves ends at its time, so that all limits of a sweep are said by the merge.
TEST(MergeCommand, SaysTheLimitsOfASweepOfWeights) {
  const SmallInputs inputs;
  expect_merged_as_at_once(
      inputs,
      {"pareto", "--map", "map.csv", "--map-pixel", "0.5", "--tif", "tif.csv", "--tif-pixel", "0.5", "--threads", "1",
       "--path", "raster:pitch=1", "--smoothnesses", "0.1", "--max-solve", "1e-9"},
      2, 3, 3);
}

// A solver that takes a start gives the same answers in any order: every solve begins at the least dwell.
TEST(MergeCommand, WritesTheSameWithASolverThatTakesAStart) {
  const SmallInputs inputs;
  expect_merged_as_at_once(
      inputs,
      {"pareto", "--map", "map.csv", "--map-pixel", "0.5", "--tif", "tif.csv", "--tif-pixel", "0.5", "--threads", "1",
       "--path", "raster:pitch=1", "--smoothnesses", "0.1,1", "--time-prices", "0,1e-3", "--solver", "projected-cg"},
      3, 0, 3);
}

Words usual_paths() {
  return {"paths", "--map",     "map.csv", "--map-pixel",  "0.5", "--tif",     "tif.csv", "--tif-pixel",
          "0.5",   "--threads", "1",       "--time-price", "0",   "--figures", "png,svg", "--paths"};
}

TEST(MergeCommand, WritesThePathsThatAComparisonAtOnceWrites) {
  const SmallInputs inputs;
  expect_merged_as_at_once(inputs, with(usual_paths(), {"raster:pitch=2;nearest:critical=1e9;spiral:pitch=2"}), 2, 3,
                           25);
  // A plan that was merged names its inputs from where it lies now, and can be simulated there.
  EXPECT_EQ(inputs.run({"simulate", "whole/raster"}).exit_code, 0);
}

TEST(MergeCommand, RefusesPlansThatWereChangedAndCommandsOfNoFolder) {
  const SmallInputs inputs;
  const Words merge = merge_of_shards(inputs, "s", with(usual_paths(), {"raster:pitch=3"}), 1);
  const auto refused = [&](const Words& more, const std::string& part) {
    const ProgramResult result = inputs.run(with(merge, more));
    EXPECT_EQ(result.exit_code, 2) << result.out;
    expect_has(result.err, part);
    EXPECT_FALSE(std::filesystem::exists(inputs / "x"));
  };
  refused({}, "--out: required");
  refused({"--out", "parts-s/1"}, "is not an earlier path comparison");
  std::ofstream(inputs / "parts-s/1/raster/program.nc", std::ios::app) << "G1 X0\n";
  refused({"--out", "x"}, "parts-s/1/raster/program.nc': is another than when it was written");
  std::filesystem::remove(inputs / "parts-s/1/raster/program.nc");
  refused({"--out", "x"}, "program.nc");
}

TEST(MergeCommand, SaysThatNoPathCouldBePlannedAsAtOnce) {
  const SmallInputs inputs;
  const Words command = with(usual_paths(), {"nearest:critical=1e9;nearest:critical=1e8"});
  const ProgramResult at_once = inputs.run(with(command, {"--out", "whole"}));
  EXPECT_EQ(at_once.exit_code, 2);
  const ProgramResult merged = inputs.run(with(merge_of_shards(inputs, "s", command, 2), {"--out", "whole"}));
  EXPECT_EQ(merged.exit_code, 2);
  expect_has(at_once.err, merged.err.substr(merged.err.find("dwell: --paths: none can be planned")));
  EXPECT_FALSE(std::filesystem::exists(inputs / "whole"));
}

TEST(MergeCommand, RefusesPartsThatDoNotMakeOneSweep) {
  const RunToSimulate inputs;
  const Words merge = merge_of_shards(inputs, "s", RunToSimulate::simulate({}, "2", "1"), 2);
  const auto refused = [&](const Words& words, const Words& parts) {
    const ProgramResult result = inputs.run(words);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    EXPECT_EQ(result.out, "");
    for (const std::string& part : parts) expect_has(result.err, part);
  };
  refused({"merge", "parts-s/2"}, {"1 of 2 shards missing: 1/2"});
  refused({"merge", "parts-s/2", "parts-s/1", "parts-s/2/part.json"}, {"shard 2/2 comes twice", "parts-s/2/part.json"});
  refused({"merge", "parts-s/1", "map.csv"}, {"'map.csv'", "is no part of a sweep"});
  refused({"merge", "parts-s/1", "nothing"}, {"nothing"});
  refused(with(merge, {"--out", "x"}), {"--out 'x'", "prints its result"});
  refused(with(merge, {"--json=parts-s/2/part.json"}), {"--json", "part of a sweep"});
  refused({"merge"}, {"parts", "required"});
  // Another seed, and another map under the same name.
  const Words other = RunToSimulate::simulate({"--shard", "1/2"}, "2", "1");
  EXPECT_EQ(inputs.run(with(other, {"--seed", "2", "--out", "seeded"})).exit_code, 0);
  refused({"merge", "parts-s/2", "seeded"}, {"part 'seeded' (1/2): asked.seed = 2", "'parts-s/2' (2/2) is 1"});
  std::string part = read_whole_file(inputs / "parts-s/1/part.json");
  inputs.folder.file("parts-s/1/part.json", part.replace(part.find("\"seed\": 1"), 9, "\"seed\": 2"));
  refused(merge, {"parts-s/1/part.json", "is another than when it was written"});
}

TEST(MergeCommand, ShardsAreRefusedWhereTheyCouldNotBeMerged) {
  const RunToSimulate inputs;
  const auto refused = [&](const Words& more, const Words& parts) {
    const ProgramResult result = inputs.run(RunToSimulate::simulate(more));
    EXPECT_EQ(result.exit_code, 2) << result.out;
    for (const std::string& part : parts) expect_has(result.err, part);
  };
  refused({"--shard", "3/2", "--out", "p"}, {"--shard = '3/2'", "K from 1 to N"});
  refused({"--shard", "", "--out", "p"}, {"--shard = ''"});
  refused({"--shard", "1/2"}, {"--shard, --out"});
  refused({"--out", "p"}, {"--shard, --out"});
  refused({"--shard", "1/2", "--out", "run/p"}, {"--out 'run/p'", "in the run"});
  EXPECT_FALSE(std::filesystem::exists(inputs / "p"));
  EXPECT_EQ(inputs.run(RunToSimulate::simulate({"--shard", "2/2", "--out", "p"}, "1")).exit_code, 0);
  refused({"--shard", "1/2", "--out", "p"}, {"'p' holds the part of shard 2/2", "1/2"});
  refused({"--shard", "2/2", "--out", "p", "--json=p/x.json"}, {"--json 'p/x.json'"});
}

TEST(MergeCommand, HasExamplesWhoseWordsAreAccepted) { test::expect_examples("merge"); }

TEST(MergeCommand, PartsHaveTheKeysThatAreDocumented) {
  const RunToSimulate inputs;
  const Words shard = RunToSimulate::simulate({"--shard", "1/1", "--out", "p", "--json"}, "1", "1");
  const ProgramResult part = inputs.run(shard);
  ASSERT_EQ(part.exit_code, 0) << part.err;
  EXPECT_EQ(part.out, read_whole_file(inputs / "p/part.json"));
  const std::string document = read_whole_file(DWELL_SOURCE_DIR "/docs/json.md");
  const std::size_t begin = document.find("## Parts of a sweep");
  const std::string section = document.substr(begin, document.find("\n## ", begin) - begin);
  const nlohmann::json keys = nlohmann::json::parse(part.out);
  for (const auto& [key, value] : keys.items()) {
    if (key == "results" || key == "schema" || key == "version" || key == "command") continue;  // of the head, or below
    expect_has(section, "| `" + key + "` |");
  }
  for (const auto& [key, value] : keys["results"][0].items()) expect_has(section, "| `results[]." + key + "` |");
}

// ./dev real runs the scripts of docs/scale.md; here the words of their commands are accepted, if for no files.
TEST(MergeCommand, IsDocumentedByCommandsWhoseWordsAreAccepted) {
  std::istringstream document(read_whole_file(DWELL_SOURCE_DIR "/docs/scale.md"));
  std::size_t commands = 0;
  for (std::string line; std::getline(document, line);) {
    const std::size_t begin = line.find("dwell ");
    if (!line.starts_with("    dwell ") && !line.starts_with("    exec dwell ")) continue;
    Words words = test::words_in(line.substr(begin + 6));
    std::erase(words, "\"$@\"");
    const ProgramResult result = SmallInputs().run(words);
    EXPECT_EQ(result.exit_code, 2) << line;
    expect_has(result.err, "No such file");
    ++commands;
  }
  EXPECT_EQ(commands, 4U);
}

}  // namespace
}  // namespace dwell
