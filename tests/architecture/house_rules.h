#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dwell::architecture {

/// A file of the house: its path from the root with forward slashes ("core/grid.h"), and its text.
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

inline constexpr std::size_t kMaxLines = 400;

/// The folders that have a rank: core 0, paths and solvers 1, runs 2, cli 3.
const std::vector<std::string>& ranked_folders();

/// Every C++ file under the ranked folders of `root`, sorted by path.
std::vector<SourceFile> read_house(const std::filesystem::path& root);

/// Checks one file by itself:
///  - it includes project headers as "folder/file.h", from its own folder or one of lower rank;
///  - Ceres, NLopt, FFTW, HDF5 and CFITSIO only where they belong; no mathematics in cli/;
///  - it is a .h or a .cpp of at most kMaxLines lines.
std::vector<Violation> check_file(const SourceFile& file);

/// Checks all files together: each by itself; beside every .cpp outside cli/ (whose commands share a header) a .h of
/// its name or of the beginning of it (a_b.cpp: a_b.h or a.h); exactly one file that includes fftw3.h; no ranked folder
/// empty.
std::vector<Violation> check_house(const std::vector<SourceFile>& files);

}  // namespace dwell::architecture
