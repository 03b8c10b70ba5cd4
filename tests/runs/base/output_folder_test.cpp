#include "runs/base/output_folder.h"

#include <gtest/gtest.h>

#include "core/base/whole_file.h"
#include "runs/reports/plan_files.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

namespace fs = std::filesystem;
using test::expect_input_error;
using test::TemporaryFolder;

void write_result(const fs::path& target, const std::string& summary) {
  OutputFolder folder(target, plan_files());
  folder.write("summary.json", summary);
  folder.write("feed.csv", "feed of " + summary);
  folder.commit();
}

TEST(OutputFolder, AppearsWholeOrNotAtAll) {
  const TemporaryFolder temporary;
  const fs::path target = temporary.path() / "plan";
  {
    OutputFolder folder(target, plan_files());
    folder.write("summary.json", "{}");
    EXPECT_FALSE(fs::exists(target));
    EXPECT_EQ(read_whole_file(folder.path("summary.json")), "{}");
    folder.commit();
    EXPECT_EQ(read_whole_file(target / "summary.json"), "{}");
  }
  EXPECT_EQ(temporary.entries(), 1u);
  {
    OutputFolder abandoned(temporary.path() / "other", plan_files());
    abandoned.write("summary.json", "{}");
  }
  EXPECT_EQ(temporary.entries(), 1u);
}

TEST(OutputFolder, ExchangesAnEarlierResultAndLeavesItWithoutCommit) {
  const TemporaryFolder temporary;
  const fs::path target = temporary.path() / "plan";
  write_result(target, "one");
  {
    OutputFolder abandoned(target, plan_files());
    abandoned.write("summary.json", "two");
  }
  EXPECT_EQ(read_whole_file(target / "summary.json"), "one");
  EXPECT_EQ(read_whole_file(target / "feed.csv"), "feed of one");
  {
    OutputFolder folder(target, plan_files());
    folder.write("summary.json", "three");
    EXPECT_EQ(read_whole_file(target / "summary.json"), "one");
    folder.commit();
  }
  EXPECT_EQ(read_whole_file(target / "summary.json"), "three");
  EXPECT_FALSE(fs::exists(target / "feed.csv"));  // replaced whole: nothing of the earlier result is mixed in
  EXPECT_EQ(temporary.entries(), 1u);
}

TEST(OutputFolder, TakesAnEmptyFolderAndASlashAtTheEnd) {
  const TemporaryFolder temporary;
  fs::create_directory(temporary.path() / "plan");
  write_result(temporary.path() / "plan/", "one");
  EXPECT_EQ(read_whole_file(temporary.path() / "plan/summary.json"), "one");
  EXPECT_EQ(temporary.entries(), 1u);
}

TEST(OutputFolder, MakesParentsAndRemovesThemAgainWithoutCommit) {
  const TemporaryFolder temporary;
  fs::create_directory(temporary.path() / "mine");
  { OutputFolder abandoned(temporary.path() / "mine/a/b/plan", plan_files(), MissingParents::MakeAll); }
  EXPECT_TRUE(fs::exists(temporary.path() / "mine"));
  EXPECT_FALSE(fs::exists(temporary.path() / "mine/a"));
  write_result(temporary.path() / "mine/a/plan", "one");
  EXPECT_EQ(read_whole_file(temporary.path() / "mine/a/plan/summary.json"), "one");
}

TEST(OutputFolder, MakesOneParentUnlessAskedForAll) {
  const TemporaryFolder temporary;
  expect_input_error([&] { OutputFolder folder(temporary.path() / "a/b/plan", plan_files()); },
                     {"`out`: neither '", "/a' nor '", "/a/b' is there", "`parents`"});
  EXPECT_FALSE(fs::exists(temporary.path() / "a"));
  OutputFolder folder(temporary.path() / "a/b/plan", plan_files(), MissingParents::MakeAll);
  folder.commit();
  EXPECT_TRUE(fs::is_directory(temporary.path() / "a/b/plan"));
}

TEST(OutputFolder, RefusesAFolderThatHoldsOtherThings) {
  const TemporaryFolder temporary;
  fs::create_directory(temporary.path() / "photos");
  temporary.file("photos/holiday.jpg", "x");
  expect_input_error([&] { OutputFolder folder(temporary.path() / "photos", plan_files()); },
                     {"`out`", "photos", "holiday.jpg", "empty or a new folder"});
  // A summary.json does not make the other files beside it ours to remove.
  temporary.file("photos/summary.json", "{}");
  expect_input_error([&] { OutputFolder folder(temporary.path() / "photos", plan_files()); }, {"`out`", "holiday.jpg"});
  EXPECT_EQ(read_whole_file(temporary.path() / "photos/holiday.jpg"), "x");
  EXPECT_EQ(temporary.entries(), 1u);
}

TEST(OutputFolder, ReplacesOnlyAResultOfItsOwnKind) {
  const TemporaryFolder temporary;
  const fs::path plan = temporary.path() / "plan", sweep = temporary.path() / "sweep";
  write_result(plan, "one");
  expect_input_error([&] { OutputFolder folder(plan, pareto_files()); },
                     {"`out`", "not an earlier pareto sweep", "it holds '"});
  {
    OutputFolder folder(sweep, pareto_files());
    folder.write("pareto.json", "{}");
    folder.commit();
  }
  EXPECT_NO_THROW(OutputFolder(sweep, pareto_files()));
  expect_input_error([&] { OutputFolder folder(sweep, plan_files()); },
                     {"`out`", "not an earlier plan", "pareto.json"});
  fs::remove(sweep / "pareto.json");
  temporary.file("sweep/pareto.csv", "x");
  expect_input_error([&] { OutputFolder folder(sweep, pareto_files()); }, {"it holds no pareto.json"});
  expect_input_error([] { OutputFolder folder("", pareto_files()); }, {"`out`", "required", "pareto sweep"});
}

TEST(OutputFolder, WritesThroughALinkToAFolder) {
  const TemporaryFolder temporary;
  fs::create_directory(temporary.path() / "real");
  fs::create_directory_symlink(temporary.path() / "real", temporary.path() / "link");
  write_result(temporary.path() / "link", "one");
  EXPECT_TRUE(fs::is_symlink(temporary.path() / "link"));
  EXPECT_EQ(read_whole_file(temporary.path() / "real/summary.json"), "one");
  write_result(temporary.path() / "link", "two");
  EXPECT_EQ(read_whole_file(temporary.path() / "real/summary.json"), "two");
  EXPECT_EQ(temporary.entries(), 2u);
}

TEST(OutputFolder, RefusesWhatCannotBeWrittenBeforeAnyWork) {
  const TemporaryFolder temporary;
  const fs::path file = temporary.file("file", "x");
  expect_input_error([] { OutputFolder folder("", plan_files()); }, {"`out`", "required"});
  expect_input_error([&] { OutputFolder folder(file, plan_files()); }, {"`out`", "file", "a folder is required"});
  expect_input_error([&] { OutputFolder folder(file / "plan", plan_files()); },
                     {"`out`", "cannot write", "Not a directory"});
  expect_input_error([] { OutputFolder folder("/proc/plan", plan_files()); }, {"`out`", "cannot write '/proc/plan'"});
  EXPECT_EQ(temporary.entries(), 1u);
}

TEST(OutputFolder, IsRefusedInsideAnEarlierResult) {
  const TemporaryFolder temporary;
  const fs::path plan = temporary.path() / "p", sweep = temporary.path() / "s";
  write_result(plan, "one");
  fs::create_directories(sweep);
  write_whole_file(sweep / "pareto.json", "{}");
  const auto check = [&](const fs::path& target, const ResultFiles& files) {
    refuse_inside_result(target, files, {&plan_files(), &pareto_files()});
  };
  expect_input_error([&] { check(plan / "inner", plan_files()); },
                     {"`out`", (plan / "inner").string(), "lies in '" + plan.string() + "'", "an earlier plan"});
  expect_input_error([&] { check(plan / "a" / "b", pareto_files()); }, {"lies in '" + plan.string() + "'"});
  expect_input_error([&] { check(sweep / "inner", plan_files()); }, {"an earlier pareto sweep"});
  EXPECT_NO_THROW(check(plan, plan_files()));
  EXPECT_NO_THROW(check(temporary.path() / "q" / "inner", plan_files()));
  const ResultFiles many{"collection", "all.json", {}, {}, &plan_files()};  // holds plans, each in its folder
  const fs::path all = temporary.path() / "all";
  fs::create_directories(all);
  write_whole_file(all / "all.json", "{}");
  write_result(all / "one", "1");
  EXPECT_NO_THROW(refuse_inside_result(all / "one", plan_files(), {&many, &plan_files()}));
  expect_input_error(
      [&] {
        refuse_inside_result(all / "one" / "two", plan_files(), {&many, &plan_files()});
      },
      {"lies in '" + (all / "one").string() + "'"});
  expect_input_error(
      [&] {
        refuse_inside_result(all / "sweep", pareto_files(), {&many, &plan_files()});
      },
      {"an earlier collection"});
}

}  // namespace
}  // namespace dwell
