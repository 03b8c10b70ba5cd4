#pragma once

#include <optional>
#include <string>

#include "core/formats/hdf5_file.h"
#include "core/formats/map_fields.h"

namespace dwell {

/// What the coordinates of an array's rows or columns say.
struct Hdf5Axis {
  std::string path;             // of the data set that holds them; empty if there are none
  bool descending = false;      // the first has the largest coordinate
  bool counts = false;          // they are 0, 1, 2, ... or 1, 2, 3, ... without a unit: numbers of pixels
  std::optional<double> pitch;  // [mm], where they name a unit of length; of a single one there is none
  double smallest = 0.0;        // [mm], with a unit
  bool in_mm = false;           // whether they name a unit of length
  std::string misfit;           // of a data set that has the name but another length; empty if there is none
};

struct Hdf5Axes {
  Hdf5Axis rows, cols;
};

/// The coordinates of a matrix: the scales attached to it, as netCDF-4 has them, or data sets x and y beside it, either
/// as long as its columns and rows or of its size (a mesh). Throws InputError, beginning with `where`, for coordinates
/// that are not regular to 0.05 of a pitch, are not as many as the matrix has rows or columns, or name x for the rows.
Hdf5Axes axes_of_data_set(const Hdf5File& file, const std::string& path, const Hdf5Matrix& matrix,
                          const std::string& where);

/// Turns the matrix so that both coordinates ascend, and adds what they say of pitch and origin, which must agree with
/// what else was said. Throws InputError as above.
void apply_axes(const Hdf5Axes& axes, Hdf5Matrix& matrix, SaidOfMap& said, const std::string& where);

}  // namespace dwell
