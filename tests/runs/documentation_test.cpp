#include <gtest/gtest.h>

#include "core/base/whole_file.h"
#include "runs/job/job_options.h"
#include "solvers/solver_catalogue.h"

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

TEST(Documentation, MathListsEverySolverOfTheCatalogue) {
  const std::string text = read_whole_file(DWELL_SOURCE_DIR "/docs/math.md");
  for (const SolverRecord& solver : solver_catalogue()) {
    const std::string largest = solver.largest ? std::to_string(*solver.largest) : "any number";
    const std::string row = "| `" + solver.name + "` | " + solver.about + " | " + largest + " |\n";
    EXPECT_NE(text.find(row), std::string::npos) << "docs/math.md lacks the line\n" << row;
  }
}

}  // namespace
}  // namespace dwell
