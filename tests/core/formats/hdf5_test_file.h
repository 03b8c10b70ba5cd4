#pragma once

#include <hdf5.h>
#include <hdf5_hl.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dwell::test {

/// Writes HDF5 files for tests by the C API alone, in memory. Sloppy about closing: a test file is small.
class Hdf5TestFile {
 public:
  Hdf5TestFile() {
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_core(access, 4096, false);
    static int count = 0;  // two files open at a time must not share a name
    file_ = H5Fcreate(("test-" + std::to_string(count++)).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    H5Pclose(access);
    links_ = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links_, 1);
  }
  Hdf5TestFile(const Hdf5TestFile&) = delete;
  Hdf5TestFile& operator=(const Hdf5TestFile&) = delete;
  ~Hdf5TestFile() {
    H5Pclose(links_);
    H5Fclose(file_);
  }

  hid_t file() const { return file_; }

  /// A data set of the file's type `stored`, from values of the type `given`; `creation` may ask for chunks and
  /// filters.
  template <class T>
  void data_set(const std::string& path, std::vector<hsize_t> sizes, const std::vector<T>& values, hid_t given,
                hid_t stored, hid_t creation = H5P_DEFAULT) {
    const hid_t space = H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr);
    const hid_t set = H5Dcreate2(file_, path.c_str(), stored, space, links_, creation, H5P_DEFAULT);
    if (!values.empty()) H5Dwrite(set, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(set);
    H5Sclose(space);
  }
  void doubles(const std::string& path, std::vector<hsize_t> sizes, const std::vector<double>& values,
               hid_t creation = H5P_DEFAULT) {
    data_set(path, std::move(sizes), values, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, creation);
  }

  void number(const std::string& path, const std::string& name, const std::vector<double>& values,
              hid_t stored = H5T_NATIVE_DOUBLE) {
    const hsize_t count = values.size();
    const hid_t space = H5Screate_simple(1, &count, nullptr), set = H5Oopen(file_, path.c_str(), H5P_DEFAULT);
    const hid_t made = H5Acreate2(set, name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(made, H5T_NATIVE_DOUBLE, values.data());
    H5Aclose(made);
    H5Oclose(set);
    H5Sclose(space);
  }
  /// One text as a data set of no dimension.
  void text_set(const std::string& path, const std::string& value) {
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, value.size() + 1);
    const hid_t set = H5Dcreate2(file_, path.c_str(), type, space, links_, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.c_str());
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(type);
  }
  /// Attaches a data set as the scale of an axis of another, as netCDF-4 does.
  void scale(const std::string& path, unsigned axis, const std::string& of) {
    const hid_t set = H5Dopen2(file_, of.c_str(), H5P_DEFAULT), scale = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
    H5DSset_scale(scale, path.c_str());
    H5DSattach_scale(set, scale, axis);
    H5Dclose(scale);
    H5Dclose(set);
  }
  /// A string of variable or of fixed length.
  void text(const std::string& path, const std::string& name, const std::string& value, bool fixed = false) {
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    const char* bytes = value.c_str();
    if (fixed) {
      H5Tset_size(type, value.size() + 1);
      attribute(path, name, type, space, bytes);
    } else {
      H5Tset_size(type, H5T_VARIABLE);
      attribute(path, name, type, space, &bytes);
    }
    H5Sclose(space);
    H5Tclose(type);
  }
  /// A compound of category, base unit and parameters, as Mx writes.
  void converter(const std::string& path, const std::string& name, const std::string& unit,
                 std::vector<double> parameters) {
    struct Converter {
      const char *category, *unit;
      hvl_t parameters;
    };
    const Converter value{"LateralCat", unit.c_str(), {parameters.size(), parameters.data()}};
    const hid_t string = H5Tcopy(H5T_C_S1), list = H5Tvlen_create(H5T_NATIVE_DOUBLE);
    H5Tset_size(string, H5T_VARIABLE);
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(Converter));
    H5Tinsert(type, "Category", HOFFSET(Converter, category), string);
    H5Tinsert(type, "BaseUnit", HOFFSET(Converter, unit), string);
    H5Tinsert(type, "Parameters", HOFFSET(Converter, parameters), list);
    const hsize_t one = 1;
    const hid_t space = H5Screate_simple(1, &one, nullptr);
    attribute(path, name, type, space, &value);
    for (const hid_t id : {string, list, type}) H5Tclose(id);
    H5Sclose(space);
  }
  void coordinates(const std::string& path, std::int32_t row, std::int32_t column, std::int32_t width,
                   std::int32_t height) {
    const std::int32_t value[4] = {row, column, width, height};
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof value);
    const char* names[4] = {"RowStart", "ColumnStart", "Width", "Height"};
    for (std::size_t i = 0; i < 4; ++i) H5Tinsert(type, names[i], 4 * i, H5T_NATIVE_INT32);
    const hsize_t one = 1;
    const hid_t space = H5Screate_simple(1, &one, nullptr);
    attribute(path, "Coordinates", type, space, value);
    H5Tclose(type);
    H5Sclose(space);
  }
  /// The table of links of a .datx.
  void meta_data(const std::vector<std::vector<const char*>>& rows) {
    const hid_t string = H5Tcopy(H5T_C_S1);
    H5Tset_size(string, H5T_VARIABLE);
    const hid_t type = H5Tcreate(H5T_COMPOUND, 3 * sizeof(char*));
    const char* names[3] = {"Source", "Link", "Destination"};
    for (std::size_t i = 0; i < 3; ++i) H5Tinsert(type, names[i], i * sizeof(char*), string);
    std::vector<const char*> cells;
    for (const auto& row : rows) cells.insert(cells.end(), row.begin(), row.end());
    data_set("/MetaData", {rows.size()}, cells, type, type);
    H5Tclose(string);
    H5Tclose(type);
  }

  std::string bytes() const {
    H5Fflush(file_, H5F_SCOPE_GLOBAL);
    std::string bytes(static_cast<std::size_t>(H5Fget_file_image(file_, nullptr, 0)), '\0');
    H5Fget_file_image(file_, bytes.data(), bytes.size());
    return bytes;
  }

 private:
  void attribute(const std::string& path, const std::string& name, hid_t type, hid_t space, const void* value) {
    const hid_t set = H5Oopen(file_, path.c_str(), H5P_DEFAULT);
    const hid_t made = H5Acreate2(set, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(made, type, value);
    H5Aclose(made);
    H5Oclose(set);
  }

  hid_t file_ = -1, links_ = -1;
};

}  // namespace dwell::test
