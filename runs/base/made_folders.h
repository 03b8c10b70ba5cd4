#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>

#include "core/base/unfinished_output.h"

namespace dwell {

/// The folders that were made to hold an output. Those in which nothing is go again with this object, or when the
/// process is interrupted, the innermost first.
class MadeFolders {
 public:
  MadeFolders() = default;
  ~MadeFolders();
  MadeFolders(const MadeFolders&) = delete;
  MadeFolders& operator=(const MadeFolders&) = delete;

  /// Makes the folder and those around it, as far as they are missing. Throws InputError of the option `out` if more
  /// than `most` are missing, or with the system's reason.
  void make(const std::filesystem::path& folder, std::size_t most);

 private:
  std::deque<UnfinishedOutput> folders_;  // outermost first
};

}  // namespace dwell
