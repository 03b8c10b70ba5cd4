#include "tests/architecture/source_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace dwell::architecture {
namespace {

bool is_cpp_file(const std::filesystem::path& path) {
  static const std::set<std::string> kExtensions{".h",   ".hh",  ".hpp", ".hxx", ".c",   ".cc", ".cpp",
                                                 ".cxx", ".inl", ".ipp", ".tpp", ".ixx", ".cu"};
  return kExtensions.contains(path.extension().string());
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  return text;
}

}  // namespace

std::string Violation::to_string() const {
  return line == 0 ? fmt::format("{}: {}", path, message) : fmt::format("{}:{}: {}", path, line, message);
}

// A target that is no literal name (a macro) comes back empty.
std::vector<Include> includes_of(const std::string& text) {
  static const std::regex kDirective(R"(^\s*#\s*include(_next)?\b\s*(.*)$)");
  static const std::regex kLiteral(R"re((?:"([^"]+)"|<([^>]+)>).*)re");
  std::vector<Include> includes;
  std::istringstream stream(text);
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    std::smatch directive;
    if (!std::regex_match(line, directive, kDirective)) continue;
    const std::string rest = directive[2];
    std::smatch name;
    if (std::regex_match(rest, name, kLiteral)) {
      includes.push_back({number, name[1].matched ? name[1].str() : name[2].str(), name[1].matched});
    } else {
      includes.push_back({number, "", false});
    }
  }
  return includes;
}

std::string top_folder(const std::string& path) { return path.substr(0, path.find('/')); }

std::string room(const std::string& path) {
  const std::size_t begin = path.find('/'), end = path.rfind('/');
  return begin == end ? "" : path.substr(begin + 1, end - begin - 1);
}

std::vector<SourceFile> read_sources(const std::filesystem::path& root, const std::vector<std::string>& folders) {
  std::vector<SourceFile> files;
  for (const std::string& folder : folders) {
    if (!std::filesystem::is_directory(root / folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file() || !is_cpp_file(entry.path())) continue;
      files.push_back({entry.path().lexically_relative(root).generic_string(), read_text(entry.path())});
    }
  }
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace dwell::architecture
