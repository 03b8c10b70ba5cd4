#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dwell::architecture {

/// A file of the house: its path from the root with forward slashes ("core/map/height_map.h"), and its text.
struct SourceFile {
  std::string path;
  std::string text;
};

/// A broken rule. line is 1-based; 0 means the file or the folder as a whole.
struct Violation {
  std::string path;
  std::size_t line = 0;
  std::string message;

  std::string to_string() const;  // "core/grid.h:3: core may not include ..."
  friend bool operator==(const Violation&, const Violation&) = default;
};

/// An include directive.
struct Include {
  std::size_t line = 0;  // 1-based
  std::string target;    // empty if it is a macro rather than a literal name
  bool quoted = false;
};

std::vector<Include> includes_of(const std::string& text);

/// "core" of "core/map/height_map.h".
std::string top_folder(const std::string& path);

/// "map" of "core/map/height_map.h", "tif/models" of "core/tif/models/disc.h"; empty for a file directly in a top
/// folder.
std::string room(const std::string& path);

/// Every C++ file under the named folders of `root`, sorted by path.
std::vector<SourceFile> read_sources(const std::filesystem::path& root, const std::vector<std::string>& folders);

}  // namespace dwell::architecture
