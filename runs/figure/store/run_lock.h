#pragma once

#include <filesystem>
#include <string>

#include "core/base/descriptor.h"

namespace dwell {

/// Holds a figure run for this process: of all processes that change a run there is one at a time. The lock is the
/// system's, on the file `lock` in the run's folder, and ends with the process however that ends; the file says which
/// process holds it.
class RunLock {
 public:
  /// Throws InputError naming the run with the number and the host of the process that holds it, and for a folder that
  /// cannot be written.
  explicit RunLock(const std::filesystem::path& run);
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;
  ~RunLock();

  /// A sentence where an earlier process ended without giving the lock back; else empty.
  const std::string& note() const { return note_; }

 private:
  Descriptor file_;
  std::string note_;
};

}  // namespace dwell
