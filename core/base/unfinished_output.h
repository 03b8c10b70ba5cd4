#pragma once

#include <filesystem>
#include <functional>

namespace dwell {

/// A temporary file or folder that becomes a result by being renamed. Known to the whole process while it exists, so
/// that give_up_outputs() can remove it from another thread when the one that works does not come to it.
class UnfinishedOutput {
 public:
  enum class Kind {
    All,        // a file, or a folder with all that is in it
    EmptyOnly,  // a folder that was made for another output: removed only if nothing is in it
  };

  /// Makes the file or folder by calling `make`, which throws if it cannot.
  UnfinishedOutput(std::filesystem::path path, const std::function<void()>& make, Kind kind = Kind::All);
  /// Removes it, unless it has been put in place.
  ~UnfinishedOutput();
  UnfinishedOutput(const UnfinishedOutput&) = delete;
  UnfinishedOutput& operator=(const UnfinishedOutput&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Calls `rename`, which puts the output under its own name in one step, and throws if it cannot. A result is on disk
  /// then, unless `target` itself lies in an unfinished folder. What `rename` leaves under the temporary name (an
  /// earlier result that was exchanged) is removed by the destructor as before.
  void put_in_place(const std::filesystem::path& target, const std::function<void()>& rename) const;

 private:
  void remove() const;

  std::filesystem::path path_;
  Kind kind_;

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
