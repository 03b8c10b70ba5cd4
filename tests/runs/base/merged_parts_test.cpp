#include "runs/base/merged_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

using SweepJson = nlohmann::ordered_json;

/// A sweep of seven tasks, of which task n comes to n / 3.
SweepPart made_up_part(const Shard& shard) {
  SweepPart part{"made up", shard, 7, {{"options", {{"a", "1"}, {"b", "2"}}}, {"inputs", {{{"sha256", "x"}}}}}};
  for (const std::size_t task : shard.tasks_of(7)) part.results.push_back(static_cast<double>(task) / 3.0);
  return part;
}

ReadSweepPart read(const std::string& place, const SweepPart& part) { return {place, place, part}; }

std::string refusal(std::vector<ReadSweepPart> parts) {
  try {
    merge_parts(std::move(parts));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MergedParts, HoldEveryTaskInItsPlaceWhateverTheOrderOfTheParts) {
  for (std::size_t count = 1; count <= 9; ++count) {
    std::vector<ReadSweepPart> parts;
    for (std::size_t k = count; k >= 1; --k) parts.push_back(read("p" + std::to_string(k), made_up_part({k, count})));
    const MergedParts merged = merge_parts(std::move(parts));
    ASSERT_EQ(merged.results.size(), 7U);
    for (std::size_t task = 1; task <= 7; ++task) {
      EXPECT_EQ(merged.results[task - 1], static_cast<double>(task) / 3.0);
      EXPECT_EQ(merged.folders[task - 1], "p" + std::to_string((task - 1) % count + 1));
    }
  }
}

TEST(MergedParts, NameThePartAndTheFieldThatDiffers) {
  SweepPart other = made_up_part({2, 2});
  other.asked["options"]["b"] = "3";
  std::string said = refusal({read("one", made_up_part({1, 2})), read("two", other)});
  for (const char* part : {"'two' (2/2)", "asked.options.b = \"3\"", "'one' (1/2) is \"2\""})
    EXPECT_THAT(said, testing::HasSubstr(part));
  other = made_up_part({2, 2});
  other.asked["inputs"][0]["sha256"] = "y";
  EXPECT_THAT(refusal({read("one", made_up_part({1, 2})), read("two", other)}),
              testing::HasSubstr("asked.inputs[0].sha256 = \"y\""));
  other = made_up_part({2, 2});
  other.asked["options"].erase("a");
  EXPECT_THAT(refusal({read("one", made_up_part({1, 2})), read("two", other)}),
              testing::HasSubstr("asked.options.a = not given"));
  EXPECT_THAT(refusal({read("one", made_up_part({1, 2})), read("two", made_up_part({2, 3}))}),
              testing::HasSubstr("shards = 3"));
  other = made_up_part({2, 2});
  other.command = "another";
  EXPECT_THAT(refusal({read("one", made_up_part({1, 2})), read("two", other)}),
              testing::HasSubstr("command = \"another\""));
}

TEST(MergedParts, NameTheShardsThatAreMissingOrComeTwice) {
  const auto part = [](std::size_t k) { return read("p" + std::to_string(k), made_up_part({k, 5})); };
  EXPECT_THAT(refusal({part(1), part(3), part(5)}), testing::HasSubstr("2 of 5 shards missing: 2/5, 4/5"));
  EXPECT_THAT(refusal({part(1), part(3), part(3)}), testing::HasSubstr("shard 3/5 comes twice, in 'p3'"));
  EXPECT_NE(refusal({}), "");
}

TEST(SweepPart, ReadsBackTheSame) {
  SweepPart part{"made up", {1, 1}, 1, {{"name", "a \xE9"}, {"number", 0.1 + 0.2}}, {5e-324}};
  const SweepPart back = parse_sweep_part(sweep_part_text(part), "f");
  EXPECT_EQ(back.asked["name"], "a \\xE9");
  EXPECT_EQ(back.asked["number"].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(back.results[0].get<double>(), 5e-324);
}

TEST(SweepPart, RefusesWhatIsNotAsItWasWritten) {
  const std::string text = sweep_part_text(made_up_part({2, 3}));
  EXPECT_EQ(parse_sweep_part(text, "f").shard, (Shard{2, 3}));
  const auto said_of = [](const std::string& changed) -> std::string {
    try {
      parse_sweep_part(changed, "f.json");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto replaced = [&text](const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_THAT(said_of(replaced("\"a\": \"1\"", "\"a\": \"9\"")), testing::HasSubstr("SHA-256"));
  EXPECT_THAT(said_of(replaced("0.666", "0.667")), testing::HasSubstr("SHA-256"));
  EXPECT_THAT(said_of(replaced("\"version\": \"", "\"version\": \"9")), testing::HasSubstr("made by dwell \"9"));
  EXPECT_THAT(said_of(replaced("\"sha256\"", "\"sha\"")), testing::HasSubstr("f.json"));
  for (const std::string& none : {std::string(), std::string("{}"), std::string("[1]"), text.substr(0, 200)})
    EXPECT_THAT(said_of(none), testing::HasSubstr("is no part of a sweep"));
  // Parts with a hash that is right, and tasks that are not those of their shard, or no shard at all.
  const auto said_of_forged = [&](const auto& change) {
    SweepJson forged = SweepJson::parse(text);
    forged.erase("sha256");
    change(forged);
    forged["sha256"] = sha256_of(forged.dump(2) + "\n");
    return said_of(forged.dump(2));
  };
  EXPECT_EQ(said_of_forged([](SweepJson&) {}), "");
  EXPECT_THAT(said_of_forged([](SweepJson& part) { part["results"].erase(0); }),
              testing::HasSubstr("does not hold the tasks of shard 2/3 of 7"));
  EXPECT_THAT(said_of_forged([](SweepJson& part) { part["results"].erase(1); }),
              testing::HasSubstr("does not hold the tasks of shard 2/3 of 7"));
  EXPECT_THAT(said_of_forged([](SweepJson& part) { part["tasks"] = 1'000'000'000'000'000'000; }),
              testing::HasSubstr("does not hold the tasks"));
  for (const auto& shards : {SweepJson(0), SweepJson(1), SweepJson(-3), SweepJson(1e300), SweepJson("3")})
    EXPECT_NE(said_of_forged([&shards](SweepJson& part) { part["shards"] = shards; }), "") << shards;
  EXPECT_THAT(said_of_forged([](SweepJson& part) { part.erase("asked"); }),
              testing::HasSubstr("is no part of a sweep"));
}

TEST(SweepPart, IsReadByTheNameOfItsFolderOrOfItsFile) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "one");
  folder.file("one/part.json", sweep_part_text(made_up_part({1, 1})));
  const std::string place = (folder.path() / "one").string();
  for (const std::string& name : {place, place + "/", place + "/part.json"}) {
    const ReadSweepPart part = read_sweep_part(name);
    EXPECT_EQ(part.place, name);
    EXPECT_TRUE(std::filesystem::equivalent(part.folder, place));
    EXPECT_EQ(part.part.results.size(), 7U);
  }
  EXPECT_THROW(read_sweep_part((folder.path() / "nothing").string()), InputError);
}

}  // namespace
}  // namespace dwell
