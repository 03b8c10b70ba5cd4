#pragma once

#include <string>
#include <vector>

#include "core/map/height_map.h"

namespace dwell::cli {

/// A file that a command is asked to write.
struct OutputFile {
  enum class Kind { Png, Figure, Json, Map, Machine, Table } kind;
  std::string option;  // "--png"
  std::string file;    // empty: not asked for
};

/// A file that a command reads.
struct ReadFile {
  std::string name;  // "the input", "--before": as messages call it
  std::string file;  // may be no file (a model of a removal function, or empty), or HDF5 with a path inside
};

/// Refuses, before any work, outputs that could not be written or would destroy something: another extension than the
/// kind's, a missing folder or one that cannot be written, a name that is no regular file's, the same file twice, or a
/// file that is read; or a file of an earlier result, or one beside its files, which could then no longer be replaced.
/// An NPY map counts with its sidecar, on both sides. Throws InputError naming option, value and what is accepted.
void check_output_files(const std::vector<OutputFile>& outputs, const std::vector<ReadFile>& read);

/// What a command writes when all of it has been computed: the map, if any, and the bytes of the other files. All or
/// none of it.
class PendingFiles {
 public:
  /// Files of an empty name are not asked for. The map must live until write().
  void add_map(const std::string& file, const HeightMap& map);
  template <class Bytes>
  void add(const std::string& file, Bytes bytes) {
    if (!file.empty()) others_.push_back({file, bytes()});
  }
  /// The bytes of the map are made here. Throws InputError.
  void write() const;

 private:
  struct Other {
    std::string file, bytes;
  };
  std::string map_file_;
  const HeightMap* map_ = nullptr;
  std::vector<Other> others_;
};

}  // namespace dwell::cli
