#include "tests/architecture/house_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace dwell::architecture {
namespace {

const std::map<std::string, int>& ranks() {
  static const std::map<std::string, int> kRanks{{"core", 0}, {"paths", 1}, {"solvers", 1}, {"runs", 2}, {"cli", 3}};
  return kRanks;
}

std::optional<int> rank_of(const std::string& folder) {
  const auto found = ranks().find(folder);
  return found == ranks().end() ? std::nullopt : std::optional(found->second);
}

std::string first_component(const std::string& path) { return path.substr(0, path.find('/')); }

struct Include {
  std::size_t line = 0;
  std::string target;
  bool quoted = false;
};

bool is_fftw(const Include& include) { return include.target.starts_with("fftw3"); }

std::size_t count_lines(const std::string& text) {
  const auto newlines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  return newlines + (!text.empty() && text.back() != '\n' ? 1 : 0);
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

std::optional<std::string> rank_fault(const std::string& folder, const Include& include) {
  const std::string target_folder = first_component(include.target);
  const bool has_folder = target_folder != include.target;
  const std::optional<int> target_rank = has_folder ? rank_of(target_folder) : std::nullopt;
  if (include.target.empty()) return "include by macro; write the name of the header";
  if (!target_rank) {
    if (!include.quoted) return std::nullopt;  // the system's
    return fmt::format(
        "\"{}\" is in no folder that has a rank; write project headers as \"folder/file.h\", others in <>",
        include.target);
  }
  if (target_folder == folder || *target_rank < ranks().at(folder)) return std::nullopt;
  return fmt::format("{} (rank {}) may not include {} (rank {}): \"{}\"", folder, ranks().at(folder), target_folder,
                     *target_rank, include.target);
}

std::optional<std::string> third_party_fault(const std::string& path, const Include& include) {
  if (include.target.starts_with("ceres/") && !path.starts_with("solvers/fits/") &&
      !path.starts_with("solvers/peers/")) {
    return fmt::format("only solvers/fits and solvers/peers may include Ceres: <{}>", include.target);
  }
  if (include.target.starts_with("nlopt") && !path.starts_with("solvers/weights/") &&
      !path.starts_with("solvers/peers/")) {
    return fmt::format("only solvers/weights and solvers/peers may include NLopt: <{}>", include.target);
  }
  if (include.target.starts_with("hdf5") && !path.starts_with("core/formats/hdf5_")) {
    return fmt::format("only core/formats/hdf5_* may include HDF5: <{}>", include.target);
  }
  if (include.target.starts_with("fitsio") && !path.starts_with("core/formats/fits_")) {
    return fmt::format("only core/formats/fits_* may include CFITSIO: <{}>", include.target);
  }
  if (include.target.starts_with("cairo") && !path.starts_with("runs/drawing/")) {
    return fmt::format("only runs/drawing may include Cairo: <{}>", include.target);
  }
  if (is_fftw(include) && !path.starts_with("core/numerics/")) {
    return fmt::format("only core/numerics may include FFTW: <{}>", include.target);
  }
  return std::nullopt;
}

std::optional<std::string> mathematics_fault(const std::string& folder, const Include& include) {
  static const std::set<std::string> kMathematics{"cmath", "math.h", "complex", "valarray", "tgmath.h", "numbers"};
  if (folder != "cli") return std::nullopt;
  const bool eigen = include.target.starts_with("Eigen/") || include.target.starts_with("unsupported/Eigen/");
  if (!eigen && !kMathematics.contains(include.target)) return std::nullopt;
  return fmt::format("cli does no mathematics; move what needs <{}> to runs or below", include.target);
}

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

// A concept too long for one source may take a second that extends its name: feed_table_reader.cpp, feed_table.h.
bool has_header(const std::string& source, const std::set<std::string>& paths) {
  const std::size_t name_begin = source.rfind('/') + 1;
  std::size_t end = source.size() - std::string_view(".cpp").size();
  while (end != std::string::npos && end > name_begin) {
    if (paths.contains(source.substr(0, end) + ".h")) return true;
    end = source.rfind('_', end - 1);
  }
  return false;
}

void check_headers_beside_sources(const std::vector<SourceFile>& files, std::vector<Violation>& violations) {
  std::set<std::string> paths;
  for (const SourceFile& file : files) paths.insert(file.path);
  for (const SourceFile& file : files) {
    if (!file.path.ends_with(".cpp") || file.path.starts_with("cli/")) continue;
    if (!has_header(file.path, paths)) violations.push_back({file.path, 0, "no header beside it has its name"});
  }
}

void check_one_user_of_fftw(const std::vector<SourceFile>& files, std::vector<Violation>& violations) {
  std::vector<Violation> users;
  for (const SourceFile& file : files) {
    const std::vector<Include> includes = includes_of(file.text);
    const auto use = std::find_if(includes.begin(), includes.end(), is_fftw);
    if (use != includes.end()) users.push_back({file.path, use->line, "exactly one file may include FFTW"});
  }
  if (users.empty()) violations.push_back({"core", 0, "no file includes FFTW; exactly one does"});
  if (users.size() > 1) violations.insert(violations.end(), users.begin(), users.end());
}

void check_no_folder_empty(const std::vector<SourceFile>& files, std::vector<Violation>& violations) {
  for (const std::string& folder : ranked_folders()) {
    const bool empty = std::none_of(files.begin(), files.end(),
                                    [&](const SourceFile& f) { return first_component(f.path) == folder; });
    if (empty) violations.push_back({folder, 0, "no source file; did the folder move?"});
  }
}

}  // namespace

std::string Violation::to_string() const {
  return line == 0 ? fmt::format("{}: {}", path, message) : fmt::format("{}:{}: {}", path, line, message);
}

const std::vector<std::string>& ranked_folders() {
  static const std::vector<std::string> kFolders{"core", "paths", "solvers", "runs", "cli"};
  return kFolders;
}

std::vector<SourceFile> read_house(const std::filesystem::path& root) {
  std::vector<SourceFile> files;
  for (const std::string& folder : ranked_folders()) {
    if (!std::filesystem::is_directory(root / folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file() || !is_cpp_file(entry.path())) continue;
      files.push_back({entry.path().lexically_relative(root).generic_string(), read_text(entry.path())});
    }
  }
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

std::vector<Violation> check_file(const SourceFile& file) {
  const std::string folder = first_component(file.path);
  if (!rank_of(folder)) throw std::invalid_argument(file.path + " is in no folder that has a rank");
  std::vector<Violation> violations;
  if (!file.path.ends_with(".h") && !file.path.ends_with(".cpp")) {
    violations.push_back({file.path, 0, "a source is named .cpp, a header .h"});
  }
  for (const Include& include : includes_of(file.text)) {
    for (const auto& fault : std::array{rank_fault(folder, include), third_party_fault(file.path, include),
                                        mathematics_fault(folder, include)}) {
      if (fault) violations.push_back({file.path, include.line, *fault});
    }
  }
  const std::size_t lines = count_lines(file.text);
  if (lines > kMaxLines) {
    violations.push_back(
        {file.path, kMaxLines + 1, fmt::format("{} lines; at most {}: it holds two concepts", lines, kMaxLines)});
  }
  return violations;
}

std::vector<Violation> check_house(const std::vector<SourceFile>& files) {
  std::vector<Violation> violations;
  for (const SourceFile& file : files) {
    const std::vector<Violation> found = check_file(file);
    violations.insert(violations.end(), found.begin(), found.end());
  }
  check_headers_beside_sources(files, violations);
  check_one_user_of_fftw(files, violations);
  check_no_folder_empty(files, violations);
  return violations;
}

}  // namespace dwell::architecture
