#pragma once

#include <filesystem>
#include <string>

#include "bench/scratch_folder.h"

namespace dwell::bench {

/// A map file as instruments write them, of `size` x `size` pixels of noise, a fifth of them without data: "dat" (Zygo
/// MetroPro, with an intensity frame), "datx" (HDF5, fringes) or "npy" (64-bit floating point).
class MapFile {
 public:
  MapFile(const std::string& format, long size);

  /// Reads it as a user does: the file to a checked map. The file is in the system's cache, as it is after a copy.
  void read_map() const;
  /// Only reads its bytes into memory, which takes less time than any reader can.
  void read_bytes() const;

 private:
  ScratchFolder folder_;
  std::filesystem::path file_;
};

}  // namespace dwell::bench
