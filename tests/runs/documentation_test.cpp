#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "core/base/whole_file.h"
#include "core/tif/models/removal_models.h"
#include "paths/path_catalogue.h"
#include "runs/job/job_options.h"
#include "runs/programs/gcode_codes.h"
#include "runs/reports/plan_files.h"
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

TEST(Documentation, NamesEveryPlannerModelAndFileOfAPlan) {
  const std::string paths = read_whole_file(DWELL_SOURCE_DIR "/docs/paths.md");
  for (const PathRecord& record : path_catalogue()) {
    const std::string row = "| `" + record.name + "` | " + record.about + " |\n";
    EXPECT_NE(paths.find(row), std::string::npos) << "docs/paths.md lacks the line\n" << row;
  }
  const std::string models = read_whole_file(DWELL_SOURCE_DIR "/docs/removal_functions.md");
  for (const RemovalModel& model : removal_models()) {
    EXPECT_NE(models.find("`" + model.name), std::string::npos) << "docs/removal_functions.md lacks " << model.name;
  }
  const std::string formats = read_whole_file(DWELL_SOURCE_DIR "/docs/formats.md");
  for (const std::string_view file : plan_files().others) {
    EXPECT_NE(formats.find("`" + std::string(file) + "`"), std::string::npos) << "docs/formats.md lacks " << file;
  }
}

// docs/adding.md says what to do by real examples: its files and rows must exist.
TEST(Documentation, AddingNamesFilesThatExist) {
  const std::string text = read_whole_file(DWELL_SOURCE_DIR "/docs/adding.md");
  const std::filesystem::path root = DWELL_SOURCE_DIR;
  std::size_t files = 0;
  for (std::size_t from = text.find('`'); from != std::string::npos; from = text.find('`', from + 1)) {
    const std::size_t end = text.find('`', from + 1);
    ASSERT_NE(end, std::string::npos);
    const std::string word = text.substr(from + 1, end - from - 1);
    from = end;
    if (word.find('/') == std::string::npos || word.find_first_of(" :()*{}") != std::string::npos) continue;
    EXPECT_TRUE(std::filesystem::exists(root / word)) << word;
    ++files;
  }
  EXPECT_GT(files, 20u);
}

// A word of G-code that is accepted stands in the table of them, its number as it is written.
TEST(Documentation, ListsEveryCodeThatAProgramMayHold) {
  const std::string text = read_whole_file(DWELL_SOURCE_DIR "/docs/formats.md");
  const std::size_t from = text.find("### Programs that can be read"), to = text.find("\n## ", from);
  std::string table = text.substr(from, to - from);
  std::replace(table.begin(), table.end(), '`', ' ');
  std::replace(table.begin(), table.end(), ',', ' ');
  for (const GcodeCode& code : gcode_codes()) {
    if (code.effect == GcodeEffect::Refused) continue;
    const std::string word = fmt::format(" {}{} ", code.letter, code.tenths / 10.0);
    EXPECT_NE(table.find(word), std::string::npos) << "docs/formats.md lacks" << word;
  }
}

}  // namespace
}  // namespace dwell
