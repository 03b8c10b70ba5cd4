#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/architecture/source_file.h"

namespace dwell::architecture {

inline constexpr std::size_t kMaxLines = 400;

/// The folders that have a rank: core 0, paths and solvers 1, runs 2, cli 3, bench 4.
const std::vector<std::string>& ranked_folders();

/// Every C++ file under the ranked folders of `root`, sorted by path.
std::vector<SourceFile> read_house(const std::filesystem::path& root);

/// Checks one file by itself:
///  - it includes project headers as "folder/file.h", from its own folder or one of lower rank;
///  - of its own folder it includes only its own room, rooms of lower rank and no door (rooms.h);
///  - headers of other people only where they belong (rooms.h); no mathematics in cli/;
///  - it is a .h or a .cpp of at most kMaxLines lines.
std::vector<Violation> check_file(const SourceFile& file);

/// Checks all files together: each by itself; beside every .cpp outside cli/ (whose commands share a header) a .h of
/// its name or of the beginning of it (a_b.cpp: a_b.h or a.h); exactly one file of the library that includes fftw3.h;
/// no ranked folder empty; no circle of concepts (concepts.h); every type name once over all headers (type_names.h).
std::vector<Violation> check_house(const std::vector<SourceFile>& files);

}  // namespace dwell::architecture
