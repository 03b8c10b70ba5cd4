#pragma once

#include <string>

namespace dwell {

/// A file that a run has read, as the user named it, with what it is and its SHA-256.
struct InputFile {
  std::string role;  // "map", "tif", "path", "program", or the step of a map's preparation that read it
  std::string file;
  std::string sha256;
};

}  // namespace dwell
