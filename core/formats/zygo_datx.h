#pragma once

#include <string>

#include "core/formats/hdf5_file.h"
#include "core/formats/map_source.h"

namespace dwell {

/// The path of the surface in a Zygo .datx file: by the links of its table `MetaData` (Root -> Measurement -> Surface
/// -> Path), or the only data set of the group /Data/Surface. Empty if the file is no .datx. Throws InputError if there
/// are several surfaces and no link.
std::string datx_surface_path(const Hdf5File& file, const std::string& where);

/// Whether a data set has what makes the surface of a .datx: the attribute `Z Converter`.
bool is_datx_surface(const Hdf5File& file, const std::string& path);

/// Reads the surface of a Zygo .datx, in nm: `Unit` (Fringes: times `Interferometric Scale Factor`, `Obliquity Factor`
/// and `Wavelength`, or what `Z Converter` says of them; or a unit of length), `No Data`, the pitch from `X Converter`
/// and `Y Converter` (in m; 0 = left open), the place on the camera from `Coordinates`. The first row is the top of the
/// picture: it becomes the largest y. `where` begins error messages. Throws InputError naming the attribute.
/// Sources: files of Mx 8.3; prysm's io.py; SurfaceTopography's test of its reader.
MapSource read_datx_surface(const Hdf5File& file, const std::string& path, const std::string& where,
                            const PixelLimit& limit = {});

}  // namespace dwell
