#pragma once

#include <string>
#include <vector>

#include "core/formats/hdf5_file.h"
#include "core/formats/map_fields.h"

namespace dwell {

/// What the file says of the map in a data set: by its attributes, by the end of its name (heights_um), by small data
/// sets beside it (pitch, unit), and, where all these are silent, by the attributes of the groups that it is in, the
/// nearest first. Attributes of CF for packed values (core/formats/hdf5_packing.h) are left to their reader. Throws
/// InputError that begins with `where`.
SaidOfMap said_of_data_set(const Hdf5File& file, const std::string& path, const std::string& where);

/// The attributes of one data set as fields, but for those of CF and of the library itself.
std::vector<MapField> fields_of_data_set(const Hdf5File& file, const std::string& path);

/// "/run/a" -> "/run", "/a" -> "/".
std::string group_of(const std::string& path);

/// "/run/a" -> "a".
std::string last_name(const std::string& path);

/// The unit of length that the name of an array of heights or coordinates ends with, as "heights_um" or "x_mm"; empty
/// if none.
std::string unit_of_array_name(const std::string& name);

}  // namespace dwell
