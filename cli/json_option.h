#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "cli/output_files.h"

namespace dwell::cli {

/// The flag --json, the same in every command: alone it prints the result as JSON on standard output, which then holds
/// nothing else; --json=FILE.json writes a file beside the text for people.
class JsonOption {
 public:
  JsonOption() = default;
  JsonOption(const JsonOption&) = delete;  // the command line holds a reference to it
  JsonOption& operator=(const JsonOption&) = delete;

  void add_to(CLI::App& command);

  /// Whether standard output holds the JSON and nothing else.
  bool printed() const;
  /// Empty unless a file is asked for.
  std::string file() const;
  /// The file, for check_output_files.
  OutputFile output() const { return {OutputFile::Kind::Json, "--json", file()}; }

  /// Refuses, before any work, a file that cannot be written, that is read, or that lies in the folder of results,
  /// which is replaced whole (`out`; empty: there is none). Throws InputError.
  void check(const std::vector<ReadFile>& read, const std::string& out) const;

  /// Writes the file, if one is asked for, and prints either the JSON or the text for people. Throws InputError.
  void deliver(const std::string& json, const std::string& text) const;

 private:
  std::string value_;
};

/// Refuses what the command line's parser would take for something else: a file after --json without the equals sign,
/// which would be an input; an empty file name; and --json with a flag that prints something else and stops. Call
/// before the words are parsed. Throws InputError.
void check_json_words(const std::vector<std::string>& words);

}  // namespace dwell::cli
