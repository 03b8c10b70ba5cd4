#include <gtest/gtest.h>

#include "core/base/whole_file.h"
#include "runs/job/job_options.h"

namespace dwell {
namespace {

// One table of options, no twins kept by hand: what the documents say must follow it.
TEST(Documentation, FormatsDescribesEveryOptionWithItsHelpAndDefault) {
  const std::string text = read_whole_file(DWELL_SOURCE_DIR "/docs/formats.md");
  const JobOptions defaults;
  for (const JobOptionRecord& record : job_option_table()) {
    std::string row = "| `" + record.key + "` | `--" + record.flag + "` | " + record.help;
    if (!record.get(defaults).empty()) row += "; default `" + record.get(defaults) + "`";
    EXPECT_NE(text.find(row + " |\n"), std::string::npos) << "docs/formats.md lacks the line\n" << row << " |";
  }
}

}  // namespace
}  // namespace dwell
