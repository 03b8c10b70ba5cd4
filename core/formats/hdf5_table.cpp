#include "core/formats/hdf5_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/formats/hdf5_file.h"
#include "core/formats/hdf5_map.h"
#include "core/formats/isolated_reader.h"

namespace dwell {
namespace {

std::string table_path(const Hdf5File& file, const std::string& path, const std::string& where) {
  if (!path.empty()) return path.starts_with('/') ? path : "/" + path;
  const std::vector<std::string> paths = file.matrices();
  if (paths.size() == 1) return paths.front();
  if (paths.empty()) {
    throw InputError(
        fmt::format("{}: the HDF5 file holds no two-dimensional data set of numbers, which is required: a row a "
                    "sample, a column a quantity",
                    where));
  }
  throw InputError(
      fmt::format("{}: the HDF5 file holds {} two-dimensional data sets; add the path of one to the file's name, as "
                  "FILE:{}: {}",
                  where, paths.size(), paths.front(), fmt::join(paths, ", ")));
}

std::vector<std::string> column_names(const Hdf5File& file, const std::string& path, const std::string& where) {
  for (const char* name : {"columns", "names"}) {
    if (!file.has_attribute(path, name)) continue;
    const auto value = file.attribute(path, name);
    if (!value || value->texts.empty()) {
      throw InputError(
          fmt::format("{}: attribute {} of HDF5 data set '{}'; a text for each column is required", where, name, path));
    }
    if (value->texts.size() > 1) return value->texts;
    std::vector<std::string> names;
    for (const std::string_view part : split(value->texts.front(), ',')) names.emplace_back(trim(part));
    return names;
  }
  return {};
}

/// The names go through the process's pipe as the history of a map does.
MapSource read_table(std::string_view bytes, const std::string& path, const std::string& where) {
  const Hdf5File file(bytes, where);
  const std::string found = table_path(file, path, where);
  Hdf5Matrix matrix = file.matrix(found);
  MapSource source;
  source.header.history = column_names(file, found, where);
  source.rows = static_cast<Index>(matrix.rows);
  source.cols = static_cast<Index>(matrix.cols);
  source.values = std::move(matrix.values);
  return source;
}

}  // namespace

NumberTable parse_hdf5_table(std::string_view bytes, const std::string& path, const std::string& where) {
  if (!is_hdf5(bytes)) throw InputError(fmt::format("{}: not an HDF5 file; it must begin with \\x89HDF", where));
  MapSource source =
      read_isolated([&] { return read_table(bytes, path, where); }, bytes.size(), "the HDF5 file", where);
  NumberTable table{std::move(source.header.history), static_cast<std::size_t>(source.rows),
                    static_cast<std::size_t>(source.cols), std::move(source.values)};
  if (!table.names.empty() && table.names.size() != table.cols) {
    throw InputError(fmt::format("{}: the HDF5 data set names {} columns and has {}; they must agree", where,
                                 table.names.size(), table.cols));
  }
  return table;
}

}  // namespace dwell
