#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/json_documentation.h"
#include "tests/cli/small_inputs.h"

namespace dwell::test {

/// Whether a leaf that is null or an empty list stands for keys that are documented.
inline bool stands_for_documented(const std::string& leaf, const JsonDocumentation::Keys& keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const auto& key) {
    return key.first.starts_with(leaf + ".") || key.first.starts_with(leaf + "[]");
  });
}

/// A key as docs/json.md has it, where the keys of a block are those of options.
inline std::string documented_key(const std::string& key) {
  for (const std::string block : {"options.", "content.map_options."}) {
    if (key.starts_with(block)) return block + "*";
  }
  return key;
}

/// Runs of a command print, between them, every key that is documented and no others.
inline void expect_documented(const SmallInputs& inputs, const std::string& command,
                              const JsonDocumentation::Keys& keys, const std::vector<Words>& runs) {
  std::set<std::string> printed_once;
  for (const Words& words : runs) {
    const ProgramResult result = inputs.run(with(words, {"--json"}));
    ASSERT_TRUE(result.exit_code == 0 || result.exit_code == 3) << command << ": " << result.err;
    const nlohmann::json printed = nlohmann::json::parse(result.out);
    EXPECT_EQ(printed["schema"], 2) << command;
    EXPECT_EQ(printed["command"], command);
    EXPECT_EQ(result.exit_code == 3, printed.contains("limits") && !printed["limits"].empty()) << command;
    PrintedKeys found;
    found.collect(printed);
    for (const std::string& key : found.leaves) {
      const std::string known = documented_key(key);
      EXPECT_TRUE(keys.contains(known) || (found.empty.contains(key) && stands_for_documented(key, keys)))
          << "docs/json.md, dwell " << command << ", lacks " << key;
      printed_once.insert(known);
    }
    for (const auto& [key, optional] : keys) {
      if (optional || key.ends_with(".*") || found.stand_for(key)) continue;
      EXPECT_TRUE(found.leaves.contains(key)) << "dwell " << command << " does not print " << key;
    }
  }
  for (const auto& [key, optional] : keys)
    EXPECT_TRUE(printed_once.contains(key)) << "no run of dwell " << command << " prints " << key;
}

/// The words of a line, as a shell takes them: blanks within single quotes do not part them.
inline Words words_in(const std::string& line) {
  Words words;
  bool open = false, any = false;
  std::string word;
  for (const char c : line + " ") {
    if (c == '\'') {
      open = !open, any = true;
    } else if (c == ' ' && !open) {
      if (any) words.push_back(word);
      word.clear(), any = false;
    } else {
      word += c, any = true;
    }
  }
  return words;
}

/// The examples of a command's help: lines after "Example:" that begin with two blanks, lines that end in a backslash
/// joined.
inline std::vector<std::string> examples_in(const std::string& help) {
  std::vector<std::string> examples;
  bool within = false, open = false;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Example:"))
      within = true;
    else if (within && !line.starts_with("  "))
      within = false;
    if (!within || line.starts_with("Example:")) continue;
    if (!open) examples.emplace_back();
    open = line.ends_with('\\');
    examples.back() += line.substr(0, line.size() - (open ? 1 : 0));
  }
  return examples;
}

/// An example of a command's help parses if it fails, if at all, for the files that are not there: the words themselves
/// are accepted.
inline void expect_examples(const std::string& command) {
  const auto examples = examples_in(SmallInputs().run(with(words_in(command), {"--help"})).out);
  ASSERT_FALSE(examples.empty()) << command;
  for (const std::string& example : examples) {
    Words words = words_in(example);
    ASSERT_EQ(words.at(0), "dwell") << example;
    words.erase(words.begin());
    const SmallInputs inputs;  // a new one each, so that none finds what the one before made
    const ProgramResult result = inputs.run(words);
    EXPECT_EQ(result.err.find(" --help'"), std::string::npos) << example << "\n" << result.err;
    if (result.exit_code == 2) {
      EXPECT_NE(result.err.find("No such file"), std::string::npos) << example << "\n" << result.err;
    } else {
      EXPECT_EQ(result.exit_code, 0) << example << "\n" << result.err;
    }
  }
}

}  // namespace dwell::test
