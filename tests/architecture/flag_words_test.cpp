// Core, paths and solvers know no flag of the command line: a message of theirs names an option by its plain name
// between backquotes (core/base/errors.h).

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "tests/architecture/house_rules.h"

namespace dwell::architecture {
namespace {

/// The string literals of a line of C++ outside comments, one after the other. Raw strings are not told apart: none of
/// the house holds a quote.
std::string literals(const std::string& line) {
  std::string found;
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (!inside && line.compare(i, 2, "//") == 0) break;
    if (!inside && line.compare(i, 3, "'\"'") == 0) {
      i += 2;
    } else if (line[i] == '"') {
      inside = !inside;
      found += ' ';
    } else if (inside) {
      if (line[i] == '\\') ++i;
      if (i < line.size()) found += line[i];
    }
  }
  return found;
}

bool holds_a_flag(const std::string& line) {
  const std::string text = literals(line);
  for (std::size_t i = text.find("--"); i != std::string::npos; i = text.find("--", i + 1)) {
    const auto next = static_cast<unsigned char>(i + 2 < text.size() ? text[i + 2] : ' ');
    if (std::isalpha(next) != 0 || next == '{') return true;
  }
  return false;
}

TEST(FlagWords, AreFoundInLiteralsOnly) {
  EXPECT_TRUE(holds_a_flag("  throw InputError(\"--radius = 1\");"));
  EXPECT_TRUE(holds_a_flag("  \"give --at\""));
  EXPECT_TRUE(holds_a_flag("  fmt::format(\"--{}-pixel\", name)"));
  EXPECT_FALSE(holds_a_flag("  // the option --radius"));
  EXPECT_FALSE(holds_a_flag("  if (c == '\"') --rest;"));
  EXPECT_FALSE(holds_a_flag("  \"a -- b\"; --radius;"));
}

TEST(FlagWords, AreUnknownBelowRuns) {
  std::size_t files = 0;
  for (const SourceFile& file : read_house(DWELL_SOURCE_DIR)) {
    if (file.path.starts_with("runs/") || file.path.starts_with("cli/") || file.path.starts_with("bench/")) continue;
    ++files;
    std::size_t number = 0, from = 0;
    while (from < file.text.size()) {
      const std::size_t end = std::min(file.text.find('\n', from), file.text.size());
      ++number;
      EXPECT_FALSE(holds_a_flag(file.text.substr(from, end - from))) << file.path << ":" << number;
      from = end + 1;
    }
  }
  EXPECT_GT(files, 100u);
}

}  // namespace
}  // namespace dwell::architecture
