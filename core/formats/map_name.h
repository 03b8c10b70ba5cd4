#pragma once

#include <filesystem>
#include <string>

namespace dwell {

/// A map as a user names it: a file and, where one file holds several arrays (HDF5), the path of one of them in it.
struct MapName {
  std::filesystem::path file;
  std::string inside;  // "/before/heights"; empty = the file has but one
};

/// `run.h5:/before/heights` is a file and a path in it: split at the first ":/". A file of the whole name, if there is
/// one, is that file.
MapName split_map_name(const std::filesystem::path& name);

}  // namespace dwell
