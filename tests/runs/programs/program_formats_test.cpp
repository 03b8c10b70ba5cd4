#include "runs/programs/program_formats.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/units.h"
#include "runs/reports/plan_files.h"

namespace dwell {
namespace {

FeedTable small_table() {
  const ToolPath path{"file", {{0, 0}, {2, 0}, {2, 4}, {9, 1}, {9, 3}}, {1, 0, 0, 1, 0}};
  return feed_table_of(path, {1.0, 3.0, 5.0, 1.0, 1.0}, Motion::Moving, 3000.0);
}

TEST(ProgramFormats, EveryFormatReadsBackWhatItWrote) {
  const FeedTable table = small_table();
  const std::vector<WrittenProgram> written = written_programs(table, {});
  ASSERT_EQ(written.size(), program_formats().size());
  std::set<std::string> files;
  for (std::size_t k = 0; k < written.size(); ++k) {
    const ProgramFormat& format = program_formats()[k];
    EXPECT_EQ(written[k].file, format.file);
    EXPECT_TRUE(files.insert(format.file).second) << format.file;
    EXPECT_FALSE(format.name.empty() || format.about.empty());
    ASSERT_EQ(program_format_of("\n " + written[k].bytes), &format) << format.name;
    const Program read = format.read(written[k].bytes, "there", {}, {});
    EXPECT_TRUE(same_removing_steps(read, program_of(table), units::mm_per_s(3000.0))) << format.name;
    EXPECT_EQ(read.file, "there");
  }
}

TEST(ProgramFormats, ArePartOfEveryPlan) {
  for (const ProgramFormat& format : program_formats()) EXPECT_TRUE(plan_files().has(format.file)) << format.file;
  EXPECT_EQ(program_format_of("<xml>"), nullptr);
  EXPECT_EQ(program_format_of(" \n"), nullptr);
}

}  // namespace
}  // namespace dwell
