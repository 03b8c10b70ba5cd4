#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <string_view>
#include <utility>

#include "core/base/descriptor.h"
#include "core/base/unfinished_output.h"

namespace dwell {

/// Files that belong together: each is written under a temporary name beside its own, and all are renamed when all are
/// written. A full disk leaves nothing of any of them, and no earlier file is harmed.
class StagedFiles {
 public:
  /// Writes bytes for `file`, down to the disk: without that, a power cut after the rename may leave an empty file
  /// under the real name. Throws InputError naming the file and the system's reason.
  void add(const std::filesystem::path& file, std::string_view bytes);
  /// Gives every file its name, in the order in which they were added, at most once. Throws InputError likewise.
  void put_in_place();

 private:
  struct StagedFile {
    /// `make` gives the temporary name and opens `held`.
    StagedFile(std::filesystem::path name, const std::function<std::filesystem::path(Descriptor&)>& make)
        : file(std::move(name)), temporary(UnfinishedOutput::Kind::File, [&] { return make(held); }) {}

    std::filesystem::path file;
    Descriptor held;  // the mark that this is work in progress, until the file is in place
    UnfinishedOutput temporary;
  };
  std::deque<StagedFile> files_;
};

}  // namespace dwell
