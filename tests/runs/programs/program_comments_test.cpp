#include "runs/programs/program_comments.h"

#include <gtest/gtest.h>

#include "runs/programs/gcode.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/program_formats.h"
#include "runs/reports/program_record.h"
#include "tests/runs/programs/program_cases.h"

namespace dwell {
namespace {

using program_cases::expect_contains;
using program_cases::replaced;
using program_cases::TestFile;

const std::string kHash = "2c26b46b68ffc68ff99b453c1d30413413422d706483bfa0f98a5e886266e7ae";
const std::string kOther = "fcde2b2edba56bf408601fb721fe9b5c338d10ee429ea04fae5511b68fbf8fb9";

/// A plan with names and options as long and odd as a user's.
FeedTable table_with(const std::string& map, const std::string& steps) {
  const ToolPath path{"file", {{0, 0}, {2, 0}, {2, 4}}, {1, 0, 0}};
  FeedTable table = feed_table_of(path, {1.0, 3.0, 5.0}, Motion::Moving, 3000.0);
  table.version = "0.3.0";
  table.inputs = {{"map " + map, kHash}, {"tif spot in um.csv", kOther}, {"machine m.toml", kHash}};
  table.options = {{"map_steps", steps}, {"remove", "piston"}};
  return table;
}

std::string long_name() {
  std::string name = "/home/J\xC3\xBCrgen/";
  while (name.size() < 300) name += "messung (alt)\x01/";
  return name + "sp\xC3\xA4t sha256=0.csv";
}

std::string program_of_comments(const FeedTable& table) {
  return written_programs({table, {}}, {GcodeDialect::G93PerMinute, 10.0, program_comments(table), {}}).at(1).bytes;
}

void expect_lines_that_controllers_take(const std::string& text) {
  std::size_t from = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; from = end + 1, end = text.find('\n', from)) {
    const std::string line = text.substr(from, end - from);
    EXPECT_LE(line.size(), 80u) << line;
    for (const char c : line) EXPECT_TRUE(c >= 0x20 && c < 0x7f) << line;
  }
  EXPECT_EQ(from, text.size());
}

TEST(ProgramComments, AreLinesThatControllersTake) {
  const FeedTable table = table_with(long_name(), "polygon:" + std::string(500, '9') + "\xC3\xA4 " + long_name());
  const std::string text = program_of_comments(table);
  expect_lines_that_controllers_take(text);
  expect_contains(text, "(input: map ...");
  expect_contains(text, "sp?t?sha256=0.csv sha256=" + kHash.substr(0, 24) + ")\n");
  expect_contains(text, "(option+: map_steps = ");
  EXPECT_EQ(read_gcode(text, "program.nc", {}).steps.size(), 5u);  // "in um" is of a name
}

TEST(ProgramComments, AreReadBackWhole) {
  for (const std::string& steps :
       {std::string("crop:data"), "fill " + std::string(200, 'a') + " b " + long_name(), std::string(61, 'x')}) {
    const FeedTable table = table_with(long_name(), steps);
    const TestFile program("program.nc", program_of_comments(table)), feed("feed.csv", feed_table_text(table));
    const ProgramRecord record = read_program_record(program.path()), whole = read_program_record(feed.path());
    ASSERT_EQ(record.inputs.size(), 3u);
    EXPECT_EQ(whole.inputs.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(record.inputs[k].role, whole.inputs[k].role);
      EXPECT_TRUE(is_same_hash(record.inputs[k].sha256, whole.inputs[k].sha256));
    }
    EXPECT_FALSE(is_same_hash(record.inputs[0].sha256, kOther));
    EXPECT_EQ(record.options.at("map_steps"), comment_text(steps));
    EXPECT_EQ(record.options.at("remove"), "piston");
    EXPECT_EQ(record.stated_hash.size(), 64u);
    std::vector<std::pair<std::string, std::string>> inputs;
    for (const InputFile& input : record.inputs) inputs.emplace_back(input.role, input.sha256);
    EXPECT_EQ(record_hash(inputs, record.options), record.stated_hash);
  }
}

TEST(ProgramComments, HaveAHashThatEveryInputAndOptionChanges) {
  const auto hash_of = [](const FeedTable& table) { return program_comments(table).back(); };
  const FeedTable table = table_with("mirror.csv", "crop:data");
  FeedTable renamed = table_with("other.csv", "crop:data"), changed = table, without = table, option = table;
  changed.inputs[1].second = kHash;
  without.options.pop_back();
  option.options[1].second = "piston,tilt";
  EXPECT_TRUE(hash_of(table).starts_with("record: "));
  EXPECT_EQ(hash_of(renamed), hash_of(table));  // the file is the same
  for (const FeedTable* other : {&changed, &without, &option}) EXPECT_NE(hash_of(*other), hash_of(table));
}

TEST(ProgramComments, ShowWhatWasChangedInThem) {
  const std::string text = program_of_comments(table_with("mirror.csv", "crop:data"));
  const auto differences = [](const std::string& program) {
    const TestFile file("program.nc", program);
    const ProgramRecord record = read_program_record(file.path());
    Job job;
    job.options.map_steps = "crop:data";
    job.options.remove = {true, false};
    for (const InputFile& input : record.inputs) job.inputs.push_back(input);
    return differences_from_record(record, "program.nc", job, {true, true}, false);
  };
  EXPECT_TRUE(differences(text).empty());
  for (const auto& [from, to] : std::initializer_list<std::pair<std::string, std::string>>{
           {"(option: remove = piston)\n", ""}, {"sha256=2c26", "sha256=2c27"}, {"crop:data", "crop:datb"}}) {
    const std::vector<std::string> said = differences(replaced(text, from, to));
    ASSERT_FALSE(said.empty()) << from;
    expect_contains(said.front(), "the comments of the program that say how it was made have changed since");
  }
}

TEST(ProgramComments, CompareHashesByTheDigitsThatTheyHave) {
  EXPECT_TRUE(is_same_hash(kHash, kHash));
  EXPECT_TRUE(is_same_hash(kHash.substr(0, 24), kHash));
  EXPECT_FALSE(is_same_hash(kHash.substr(0, 23), kHash));  // too few to tell
  EXPECT_FALSE(is_same_hash(kHash, kOther));
  EXPECT_FALSE(is_same_hash("", kHash));
}

}  // namespace
}  // namespace dwell
