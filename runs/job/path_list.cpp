#include "runs/job/path_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/spec_text.h"
#include "paths/path_catalogue.h"

namespace dwell {
namespace {

bool begins_a_path(std::string_view word) {
  const std::size_t equals = word.find('=');
  return equals == std::string_view::npos || word.find(':') < equals;
}

std::vector<std::string> cut(const std::string& list) {
  std::vector<std::string> texts;
  if (list.find(';') != std::string::npos) {
    for (const std::string_view text : split(list, ';')) texts.emplace_back(trim(text));
    return texts;
  }
  for (const std::string_view word : split(list, ',')) {
    if (texts.empty() || begins_a_path(word)) {
      texts.emplace_back(trim(word));
    } else {
      texts.back() += "," + std::string(trim(word));
    }
  }
  return texts;
}

std::string with_pitch(const std::string& text, double pitch) {
  const std::string kind = split_kind(text).first;
  const auto known =
      std::find_if(path_catalogue().begin(), path_catalogue().end(), [&](const auto& k) { return k.name == kind; });
  if (known == path_catalogue().end() || known->spacing.empty()) return text;
  const SpecText spec = parse_spec_text(text, "path");
  if (spec.has(known->spacing)) return text;
  return fmt::format("{}{}{}={:.6g}", text, spec.entries.empty() ? (text.back() == ':' ? "" : ":") : ",",
                     known->spacing, pitch);
}

}  // namespace

std::vector<ListedPath> parse_path_list(const std::string& list, double pitch) {
  std::vector<ListedPath> paths;
  std::map<std::string, int> seen;
  for (const std::string& text : cut(list)) {
    if (text.empty()) {
      throw InputError(
          fmt::format("--paths: '{}' has an empty entry; required a list like raster,spiral:pitch=2", list));
    }
    const std::string whole = with_pitch(text, pitch);
    parse_path_spec(whole);
    const std::string kind = split_kind(whole).first;
    const int number = ++seen[kind];
    paths.push_back({whole, number == 1 ? kind : fmt::format("{}-{}", kind, number)});
  }
  return paths;
}

}  // namespace dwell
