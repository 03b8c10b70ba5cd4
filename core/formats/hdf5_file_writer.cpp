#include <fmt/format.h>

#include <atomic>
#include <stdexcept>

#include "core/formats/hdf5_file.h"
#include "core/formats/hdf5_handle.h"

namespace dwell {
namespace {

using namespace hdf5;

void require(bool done, const char* what) {
  if (!done) throw std::runtime_error(fmt::format("the HDF5 library cannot {}", what));
}

Type text_type() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  require(type >= 0 && H5Tset_size(type, H5T_VARIABLE) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0, "make a type");
  return Type(type);
}

void write_attribute(hid_t set, const std::string& name, hid_t type, hid_t space, const void* values) {
  const Attribute attribute(H5Acreate2(set, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
  require(attribute && H5Awrite(attribute.id(), type, values) >= 0, "write an attribute");
}

Space line_of(std::size_t count) {
  const hsize_t size = count;
  return Space(H5Screate_simple(1, &size, nullptr));
}

void write_attributes(hid_t set, const Hdf5Content& content) {
  for (const auto& [name, values] : content.numbers) {
    write_attribute(set, name, H5T_NATIVE_DOUBLE, line_of(values.size()).id(), values.data());
  }
  const Type text = text_type();
  for (const auto& [name, value] : content.texts) {
    const Space one(H5Screate(H5S_SCALAR));
    const char* bytes = value.c_str();
    write_attribute(set, name, text.id(), one.id(), &bytes);
  }
  for (const auto& [name, list] : content.lists) {
    if (list.empty()) continue;
    std::vector<const char*> lines;
    for (const std::string& line : list) lines.push_back(line.c_str());
    write_attribute(set, name, text.id(), line_of(lines.size()).id(), lines.data());
  }
}

void write_matrix(hid_t file, const Hdf5Content& content) {
  const hsize_t sizes[2] = {content.rows, content.cols};
  const Space space(H5Screate_simple(2, sizes, nullptr));
  const Properties creation(H5Pcreate(H5P_DATASET_CREATE)), links(H5Pcreate(H5P_LINK_CREATE));
  require(space && creation && links && H5Pset_create_intermediate_group(links.id(), 1) >= 0 &&
              H5Pset_obj_track_times(creation.id(), false) >= 0,
          "describe a data set");
  const DataSet set(
      H5Dcreate2(file, content.path.c_str(), H5T_IEEE_F64LE, space.id(), links.id(), creation.id(), H5P_DEFAULT));
  require(set && H5Dwrite(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, content.values.data()) >= 0,
          "write a data set");
  write_attributes(set.id(), content);
}

}  // namespace

std::string hdf5_bytes(const Hdf5Content& content) {
  constexpr std::size_t kIncrement = std::size_t{1} << 20;
  const Properties access(H5Pcreate(H5P_FILE_ACCESS));
  // In memory only: nothing is kept on disk under the name. Two files open at a time must not share one.
  static std::atomic<unsigned> count{0};
  require(access && H5Pset_fapl_core(access.id(), kIncrement, false) >= 0, "work in memory");
  const File file(H5Fcreate(fmt::format("dwell-{}", count++).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()));
  require(static_cast<bool>(file), "make a file");
  write_matrix(file.id(), content);
  require(H5Fflush(file.id(), H5F_SCOPE_GLOBAL) >= 0, "finish a file");
  const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
  require(size > 0, "measure a file");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  require(H5Fget_file_image(file.id(), bytes.data(), bytes.size()) == size, "hand out a file");
  return bytes;
}

}  // namespace dwell
