/// A sweep done in shards and merged is, byte for byte, the sweep done at once.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

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

}  // namespace
}  // namespace dwell
