#include "tests/architecture/public_face.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace dwell::architecture {
namespace {

constexpr const char* kList = "cmake/public_headers.txt";

bool is_named(const std::string& header, const std::string& entry) {
  if (!entry.ends_with("/*")) return header == entry;
  const std::string folder = entry.substr(0, entry.size() - 1);
  return header.starts_with(folder) && header.find('/', folder.size()) == std::string::npos;
}

/// The entries of the list with their lines.
std::vector<std::pair<std::size_t, std::string>> entries(const std::string& list) {
  std::vector<std::pair<std::size_t, std::string>> found;
  std::istringstream stream(list);
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (!line.empty() && !line.starts_with('#')) found.emplace_back(number, line);
  }
  return found;
}

}  // namespace

std::vector<std::string> public_headers(const std::string& list, const std::vector<SourceFile>& files) {
  std::set<std::string> headers;
  for (const auto& [line, entry] : entries(list)) {
    for (const SourceFile& file : files) {
      if (file.path.ends_with(".h") && is_named(file.path, entry)) headers.insert(file.path);
    }
  }
  return {headers.begin(), headers.end()};
}

std::vector<Violation> check_public_face(const std::string& list, const std::vector<SourceFile>& files) {
  std::vector<Violation> violations;
  for (const auto& [line, entry] : entries(list)) {
    const bool any = std::any_of(files.begin(), files.end(), [&, name = entry](const SourceFile& f) {
      return f.path.ends_with(".h") && is_named(f.path, name);
    });
    if (!any) violations.push_back({kList, line, fmt::format("no header is named \"{}\"", entry)});
  }
  const std::vector<std::string> names = public_headers(list, files);
  const std::set<std::string> is_public(names.begin(), names.end());
  for (const SourceFile& file : files) {
    if (!is_public.contains(file.path)) continue;
    for (const Include& include : includes_of(file.text)) {
      if (!include.quoted || is_public.contains(include.target)) continue;
      violations.push_back(
          {file.path, include.line,
           fmt::format("a public header includes \"{}\", which {} does not name", include.target, kList)});
    }
  }
  return violations;
}

}  // namespace dwell::architecture
