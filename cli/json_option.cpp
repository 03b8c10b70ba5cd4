#include "cli/json_option.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/places.h"
#include "cli/standard_streams.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/whole_file.h"

namespace dwell::cli {
namespace {

/// What CLI11 stores for a flag that is given alone. It cannot be the name of a file, which would end in .json.
constexpr const char* kPrinted = "true";

}  // namespace

void JsonOption::add_to(CLI::App& command) {
  command
      .add_flag("--json", value_,
                "print the result as JSON on standard output, and nothing else there; with =FILE.json write it to a "
                "file and print as usual")
      ->option_text("[=FILE.json]");
}

bool JsonOption::printed() const { return value_ == kPrinted; }

std::string JsonOption::file() const { return printed() ? "" : value_; }

void JsonOption::check(const std::vector<ReadFile>& read, const std::string& out) const {
  if (!file().empty() && !out.empty() && lies_in(file(), out)) {
    throw InputError(fmt::format(
        "--json '{}': lies in the folder of --out, which is replaced whole; a file elsewhere is required", file()));
  }
  check_output_files({output()}, read);
}

void JsonOption::deliver(const std::string& json, const std::string& text) const {
  if (!file().empty()) write_whole_file(file(), json);
  print(printed() ? json : text);
}

void check_json_words(const std::vector<std::string>& words) {
  const auto flag = std::find_if(words.begin(), words.end(),
                                 [](const std::string& w) { return w == "--json" || w.starts_with("--json="); });
  if (flag == words.end()) return;
  for (auto word = flag; word != words.end(); ++word) {
    if (*word == "--json=") throw InputError("--json=: empty; accepted: --json, or --json=FILE.json");
    const bool alone = *word == "--json" && word + 1 != words.end();
    if (alone && !word[1].starts_with("-") && lower_case(word[1]).ends_with(".json")) {
      throw InputError(fmt::format(
          "--json {0}: a file is given with an equals sign: --json={0}; --json alone prints to standard output",
          word[1]));
    }
  }
  for (const char* other : {"--steps", "--kinds", "--write-job"}) {
    if (std::find(words.begin(), words.end(), other) == words.end()) continue;
    throw InputError(fmt::format("--json: not with {}, which prints something else and stops", other));
  }
}

}  // namespace dwell::cli
