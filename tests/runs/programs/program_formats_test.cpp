#include "runs/programs/program_formats.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "core/base/errors.h"
#include "core/base/units.h"
#include "runs/reports/plan_files.h"

namespace dwell {
namespace {

FeedTable small_table() {
  const ToolPath path{"file", {{0, 0}, {2, 0}, {2, 4}, {9, 1}, {9, 3}}, {1, 0, 0, 1, 0}};
  return feed_table_of(path, {1.0, 3.0, 5.0, 1.0, 1.0}, Motion::Moving, 3000.0);
}

TEST(ProgramFormats, EveryFormatOfEveryPlanReadsBackWhatItWrote) {
  const FeedTable table = small_table();
  const std::vector<WrittenProgram> written = written_programs({table, {}}, {});
  ASSERT_EQ(written.size(), 2U);
  for (std::size_t k = 0; k < written.size(); ++k) {
    const ProgramFormat& format = program_formats()[k];
    EXPECT_EQ(written[k].file, format.file);
    EXPECT_TRUE(written[k].word.empty());
    ASSERT_EQ(program_format_of("\n " + written[k].bytes), &format) << format.name;
    const Program read = format.read(written[k].bytes, "there", {}, {});
    EXPECT_TRUE(same_removing_steps(read, program_of(table), units::mm_per_s(3000.0))) << format.name;
    EXPECT_EQ(read.file, "there");
  }
}

TEST(ProgramFormats, AreWrittenOnlyWhereTheyAreAskedFor) {
  EXPECT_EQ(exports_text(parse_exports("pmac, xps-trj,pmac")), "xps-trj,pmac");
  EXPECT_TRUE(parse_exports("none").empty());
  EXPECT_THROW(parse_exports("pvt-csv,svg"), InputError);
  EXPECT_THROW(parse_exports("none,pmac"), InputError);
  EXPECT_EQ(export_that_needs_motion(parse_exports("pvt-json,pmac")), "pvt-json");
  EXPECT_EQ(export_that_needs_motion({}), "");
  EXPECT_THROW(written_programs({small_table(), {}}, {}, {"pvt-csv"}), std::logic_error);
  std::set<std::string> files, words;
  for (const ProgramFormat& format : program_formats()) {
    EXPECT_FALSE(format.name.empty() || format.about.empty() || format.fuzz.empty());
    EXPECT_EQ(format.file.empty(), format.write == nullptr) << format.name;
    EXPECT_TRUE(format.file.empty() || files.insert(format.file).second) << format.file;
    EXPECT_TRUE(format.word.empty() || words.insert(format.word).second) << format.word;
  }
}

TEST(ProgramFormats, ArePartOfEveryPlan) {
  for (const ProgramFormat& format : program_formats())
    EXPECT_TRUE(format.file.empty() || plan_files().has(format.file)) << format.file;
  for (const char* name :
       {"program_001.trj", "program_12345.pmc", "program_002.nc", "program_parts.csv", "program_by_template.mpf"})
    EXPECT_TRUE(plan_files().has(name)) << name;
  for (const char* name : {"program_.trj", "program_1a.trj", "program_001.txt", "other_001.trj", "program_by_template",
                           "program_by_template."})
    EXPECT_FALSE(plan_files().has(name)) << name;
  EXPECT_EQ(program_format_of("<xml>"), nullptr);
  EXPECT_EQ(program_format_of(" \n"), nullptr);
}

}  // namespace
}  // namespace dwell
