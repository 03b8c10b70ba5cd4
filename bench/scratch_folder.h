#pragma once

#include <filesystem>

namespace dwell::bench {

/// A new folder among the temporary files, removed with all it holds. Throws std::runtime_error if it cannot be made.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace dwell::bench
