#pragma once

#include <filesystem>

namespace dwell::cli {

/// Whether two names are those of one file, also by another name: links, "./", a case-insensitive file system.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Whether a file lies in a folder or in one within it, whatever links lead there. Either may be missing.
bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace dwell::cli
