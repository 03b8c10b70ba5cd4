#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dwell {

/// The bytes of a file. Throws InputError naming the file if it cannot be read or is not a regular file: pipes and
/// devices are refused, for they may never end.
std::string read_whole_file(const std::filesystem::path& file);

/// Writes bytes to a temporary file beside `file` and renames it: the file appears whole or not at all.
/// Throws InputError naming the file and the system's reason.
void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

/// SHA-256 of bytes, 64 lower-case hexadecimal digits.
std::string sha256_of(std::string_view bytes);

/// SHA-256 of a file's bytes, 64 lower-case hexadecimal digits.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace dwell
