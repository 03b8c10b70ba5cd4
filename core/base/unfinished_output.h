#pragma once

#include <filesystem>
#include <functional>

namespace dwell {

/// A temporary file or folder that becomes a result by being renamed. Known to the whole process while it exists, so
/// that give_up_outputs() can remove it from another thread when the one that works does not come to it.
class UnfinishedOutput {
 public:
  enum class Kind {
    File,
    Folder,       // with all that is in it
    EmptyFolder,  // made to hold another output: removed only if nothing is in it
  };

  /// `make` makes the file or folder and gives its path; it throws if it cannot.
  UnfinishedOutput(Kind kind, const std::function<std::filesystem::path()>& make);
  /// Removes what is there of it, unless it was put in place.
  ~UnfinishedOutput();
  UnfinishedOutput(const UnfinishedOutput&) = delete;
  UnfinishedOutput& operator=(const UnfinishedOutput&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Calls `rename`, which puts the output under its own name in one step, and throws if it cannot. A result is on disk
  /// then, unless `target` itself lies in an unfinished folder. The temporary name is no longer ours then, but for
  /// a folder's: the earlier result may be under it, exchanged, and is removed by the destructor.
  void put_in_place(const std::filesystem::path& target, const std::function<void()>& rename);

 private:
  void remove() const;

  std::filesystem::path path_;
  Kind kind_;
  bool gone_ = false;  // nothing of ours is under path_ any more

  friend bool give_up_outputs();
};

/// While it lives, outputs are put in place as one: give_up_outputs() waits for all of them. For results of several
/// files that belong together.
class OutputGroup {
 public:
  OutputGroup();
  ~OutputGroup();
  OutputGroup(const OutputGroup&) = delete;
  OutputGroup& operator=(const OutputGroup&) = delete;
};

/// Removes every unfinished output, and lets none be made or put in place from then on: whatever thread tries waits for
/// ever. For a process that is about to end without unwinding. False, and nothing done, if a result is already in
/// place: then it is too late to say that nothing was written.
bool give_up_outputs();

}  // namespace dwell
