#pragma once

#include <string>
#include <vector>

#include "core/formats/hdf5_file.h"
#include "core/formats/packed_values.h"

namespace dwell {

/// What the attributes of CF and netCDF (scale_factor, add_offset, _FillValue, missing_value, valid_min, valid_max,
/// valid_range, _Unsigned), the fill value that was chosen for the data set (but not 0, which is a height), and
/// `no_data`, markers under other names, say of its values. A valid range of the type of scale_factor, wider than that
/// of the numbers, is one of heights, else of stored values. Throws InputError that begins with `where`.
PackedValues packing_of_data_set(const Hdf5File& file, const std::string& path, const Hdf5Numbers& numbers,
                                 const std::vector<double>& no_data, const std::string& where);

}  // namespace dwell
