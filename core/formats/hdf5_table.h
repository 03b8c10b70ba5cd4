#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dwell {

/// A table of numbers, row-major, which may name its columns.
struct NumberTable {
  std::vector<std::string> names;  // one a column, or none
  std::size_t rows = 0, cols = 0;
  std::vector<double> values;
};

/// Reads a table from an HDF5 file: the two-dimensional data set at `path`, or the only one where that is empty. Names
/// of its columns are the texts of its attribute `columns` or `names`, one a column or one text with commas. Reading is
/// done in a process of its own (core/formats/isolated_reader.h). Throws InputError beginning with `where`; of several
/// data sets it lists the paths.
NumberTable parse_hdf5_table(std::string_view bytes, const std::string& path, const std::string& where);

}  // namespace dwell
