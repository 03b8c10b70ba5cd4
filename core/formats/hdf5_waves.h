#pragma once

#include <string>

#include "core/formats/hdf5_file.h"
#include "core/formats/map_source.h"

namespace dwell {

/// Whether a data set is a measurement as 4D Technology's programs write it: `data` in a group with the attributes
/// `wavelength` and `xpix`, /measurement0/genraw/data.
bool is_measurement_in_waves(const Hdf5File& file, const std::string& path);

/// Reads it: values in waves of the attribute `wavelength` ("632.8 nm"), those of 1e38 and more no data, the first row
/// on top, pitch `xpix` and `ypix` ("0.12 mm"; one of them alone is taken for both). As public readers of such files do
/// (times the wavelength, rows turned over); the format itself is not published. Throws InputError.
MapSource read_measurement_in_waves(const Hdf5File& file, const std::string& path, const std::string& where,
                                    const PixelLimit& limit);

}  // namespace dwell
