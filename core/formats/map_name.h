#pragma once

#include <filesystem>
#include <string>

namespace dwell {

/// A map as a user names it: a file and, where one file holds several arrays, the path of one of them in it (HDF5), or
/// its name or number (FITS).
struct MapName {
  std::filesystem::path file;
  std::string inside;  // "/before/heights", "OPD" or "2"; empty = the file has but one
};

/// `run.h5:/before/heights` is a file and a path in it: split at the first ":/". `a.fits:OPD` is one if a.fits is a
/// file: split at the first colon behind the name of one. A file of the whole name, if there is one, is that file.
MapName split_map_name(const std::filesystem::path& name);

}  // namespace dwell
