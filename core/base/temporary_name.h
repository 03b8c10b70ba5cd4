#pragma once

#include <filesystem>

#include "core/base/descriptor.h"

namespace dwell {

/// A file or folder under a temporary name beside the output that it becomes, ".NAME.HOST-PID-COUNT.tmp". As long as
/// `held` is open the system keeps a lock on it, which ends with the process however that ends: the mark by which
/// another process tells work in progress from what a killed process left.
struct TemporaryName {
  std::filesystem::path path;
  Descriptor held;  // open for writing if it is a file
};

/// Makes an empty file beside `target`, after removing what processes of this machine that are dead left for the same
/// target. Throws std::system_error with the system's reason.
TemporaryName make_temporary_file(const std::filesystem::path& target);

/// Makes an empty folder likewise.
TemporaryName make_temporary_folder(const std::filesystem::path& target);

}  // namespace dwell
