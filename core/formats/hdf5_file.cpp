#include "core/formats/hdf5_file.h"

#include <fmt/format.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/formats/hdf5_handle.h"
#include "core/formats/unpacked_size.h"

namespace dwell {
namespace {

using namespace hdf5;

std::vector<hsize_t> sizes_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> sizes(rank > 0 ? static_cast<std::size_t>(rank) : 0);
  if (rank > 0) H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  return sizes;
}

bool is_number(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

double number_at(hid_t native, const unsigned char* bytes) {
  std::array<unsigned char, 64> room{};  // H5Tconvert works in place
  const std::size_t size = H5Tget_size(native);
  if (size == 0 || size > room.size()) return std::numeric_limits<double>::quiet_NaN();
  std::memcpy(room.data(), bytes, size);
  if (H5Tconvert(native, H5T_NATIVE_DOUBLE, 1, room.data(), nullptr, H5P_DEFAULT) < 0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double value = 0.0;
  std::memcpy(&value, room.data(), sizeof value);
  return value;
}

std::string text_at(hid_t native, const unsigned char* bytes) {
  if (H5Tis_variable_str(native) > 0) {
    const char* text = nullptr;
    std::memcpy(&text, bytes, sizeof text);
    return text ? text : "";
  }
  const auto* begin = reinterpret_cast<const char*>(bytes);
  std::string text(begin, strnlen(begin, H5Tget_size(native)));
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

/// Appends what one element of a native type holds. False for types without an Hdf5Value.
bool append(hid_t native, const unsigned char* bytes, Hdf5Value& value) {
  switch (H5Tget_class(native)) {
    case H5T_INTEGER:
    case H5T_FLOAT:
      value.numbers.push_back(number_at(native, bytes));
      return true;
    case H5T_ENUM: {
      const Type base(H5Tget_super(native));
      if (!base || !is_number(base.id())) return false;
      value.numbers.push_back(number_at(base.id(), bytes));
      value.enumerated = true;
      return true;
    }
    case H5T_STRING:
      value.texts.push_back(text_at(native, bytes));
      return true;
    case H5T_VLEN: {
      const Type element(H5Tget_super(native));
      hvl_t list{};
      std::memcpy(&list, bytes, sizeof list);
      if (!element || !is_number(element.id()) || (list.len > 0 && !list.p)) return false;
      const auto* at = static_cast<const unsigned char*>(list.p);
      const std::size_t size = H5Tget_size(element.id());
      for (std::size_t i = 0; i < list.len; ++i) value.numbers.push_back(number_at(element.id(), at + i * size));
      return true;
    }
    case H5T_COMPOUND: {
      const int count = H5Tget_nmembers(native);
      for (int i = 0; i < count; ++i) {
        const auto index = static_cast<unsigned>(i);
        char* name = H5Tget_member_name(native, index);
        if (!name) return false;
        const std::string key = name;
        H5free_memory(name);
        if (!value.member(key)) value.members.push_back({key, {}});
        const auto known = std::find_if(value.members.begin(), value.members.end(),
                                        [&](const auto& member) { return member.name == key; });
        const Type type(H5Tget_member_type(native, index));
        if (!type) return false;
        append(type.id(), bytes + H5Tget_member_offset(native, index), known->value);
      }
      return true;
    }
    default:
      return false;
  }
}

/// Reads all elements by `read`(native type, buffer).
template <class Read>
std::optional<Hdf5Value> small_value(hid_t type, hid_t space, Read read) {
  constexpr hssize_t kMost = 65536;
  const Type native(H5Tget_native_type(type, H5T_DIR_ASCEND));
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (!native || count < 0 || count > kMost) return std::nullopt;
  const std::size_t size = H5Tget_size(native.id()), elements = static_cast<std::size_t>(count);
  constexpr std::size_t kMostBytes = std::size_t{1} << 26;
  if (size == 0 || size > kMostBytes / std::max<std::size_t>(elements, 1)) return std::nullopt;
  std::vector<unsigned char> buffer(size * elements);
  Hdf5Value value;
  if (elements == 0) return value;
  if (read(native.id(), buffer.data()) < 0) return std::nullopt;
  if (H5Tget_class(type) == H5T_FLOAT) value.floating_bytes = H5Tget_size(type);
  bool known = true;
  for (std::size_t i = 0; i < elements && known; ++i) known = append(native.id(), buffer.data() + i * size, value);
  H5Dvlen_reclaim(native.id(), space, H5P_DEFAULT, buffer.data());
  if (!known) return std::nullopt;
  return value;
}

struct Visit {
  std::vector<std::string> paths;
};

herr_t visit_object(hid_t root, const char* name, const H5O_info_t* info, void* data) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const DataSet set(H5Dopen2(root, name, H5P_DEFAULT));
  if (!set) return 0;
  const Space space(H5Dget_space(set.id()));
  const Type type(H5Dget_type(set.id()));
  if (space && type && sizes_of(space.id()).size() == 2 && is_number(type.id())) {
    static_cast<Visit*>(data)->paths.push_back(std::string("/") + name);
  }
  return 0;
}

herr_t visit_link(hid_t group, const char* name, const H5L_info_t*, void* data) {
  const Object object(H5Oopen(group, name, H5P_DEFAULT));
  if (object && H5Iget_type(object.id()) == H5I_DATASET) static_cast<Visit*>(data)->paths.emplace_back(name);
  return 0;
}

herr_t visit_attribute(hid_t, const char* name, const H5A_info_t*, void* data) {
  static_cast<Visit*>(data)->paths.emplace_back(name);
  return 0;
}

herr_t visit_scale(hid_t, unsigned, hid_t scale, void* data) {
  const ssize_t size = H5Iget_name(scale, nullptr, 0);
  if (size <= 0) return 0;
  std::string path(static_cast<std::size_t>(size) + 1, '\0');
  H5Iget_name(scale, path.data(), path.size());
  path.resize(static_cast<std::size_t>(size));
  static_cast<Visit*>(data)->paths.push_back(path);
  return 0;
}

/// The fill value that whoever made the data set chose.
std::optional<double> chosen_fill(hid_t layout) {
  H5D_fill_value_t status = H5D_FILL_VALUE_ERROR;
  double fill = 0.0;
  if (H5Pfill_value_defined(layout, &status) < 0 || status != H5D_FILL_VALUE_USER_DEFINED) return std::nullopt;
  if (H5Pget_fill_value(layout, H5T_NATIVE_DOUBLE, &fill) < 0) return std::nullopt;
  return fill;
}

void make_library_safe() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
  H5Lunregister(H5L_TYPE_EXTERNAL);
}

}  // namespace

const Hdf5Value* Hdf5Value::member(std::string_view name) const {
  for (const Hdf5Member& known : members) {
    if (known.name == name) return &known.value;
  }
  return nullptr;
}

struct Hdf5File::Impl {
  std::string where;
  std::size_t size = 0;  // of the file
  File file;

  Impl(std::string_view bytes, std::string place)
      : where(std::move(place)),
        size(bytes.size()),
        // The library asks for bytes that it may write, but does not: the file is open for reading.
        file(H5LTopen_file_image(const_cast<char*>(bytes.data()), bytes.size(),
                                 H5LT_FILE_IMAGE_DONT_COPY | H5LT_FILE_IMAGE_DONT_RELEASE)) {}

  [[noreturn]] void refuse(const std::string& path, const std::string& what) const {
    throw InputError(fmt::format("{}: HDF5 data set '{}' {}", where, path, what));
  }

  /// Throws unless the file can hold the data: packed by deflate, a byte stands for 1032 at most.
  void check_size(const std::string& path, hid_t layout, const std::vector<hsize_t>& sizes, hid_t type,
                  const PixelLimit& limit) const {
    constexpr double kDeflate = 1032.0;
    const double file_bytes = static_cast<double>(size), element = static_cast<double>(H5Tget_size(type));
    const double rows = static_cast<double>(sizes[0]), cols = static_cast<double>(sizes[1]);
    const double most = kDeflate * file_bytes;
    if (!(rows * cols >= 1.0 && rows * cols * element <= most)) {
      refuse(path, fmt::format("of {} x {} numbers of {} bytes; at least one, and no more than a file of {} bytes can "
                               "hold (1032 bytes for each) are accepted",
                               sizes[0], sizes[1], element, size));
    }
    check_unpacked(rows, cols, file_bytes, limit, fmt::format("{}: HDF5 data set '{}'", where, path));
    if (H5Pget_layout(layout) == H5D_CHUNKED) check_chunk(path, layout, element, most);
  }

  void check_chunk(const std::string& path, hid_t layout, double element, double most) const {
    std::array<hsize_t, 2> chunk{};
    const bool known = H5Pget_chunk(layout, 2, chunk.data()) == 2;
    const double bytes = static_cast<double>(chunk[0]) * static_cast<double>(chunk[1]) * element;
    if (!known || !(bytes <= most)) {
      refuse(path,
             fmt::format("in chunks of {} x {} numbers; a file of {} bytes cannot hold one", chunk[0], chunk[1], size));
    }
  }

  /// Throws unless every number is in this file.
  void check_place(const std::string& path, hid_t layout) const {
    if (H5Pget_layout(layout) == H5D_VIRTUAL || H5Pget_external_count(layout) != 0) {
      refuse(path, "is kept in other files; one with all its numbers is required");
    }
  }

  /// Throws, with its name, for a filter that is not built in.
  void check_filters(const std::string& path, hid_t layout) const {
    const int count = H5Pget_nfilters(layout);
    for (int i = 0; i < count; ++i) {
      unsigned flags = 0, configuration = 0;
      std::size_t values = 0;
      std::array<char, 80> name{};
      const H5Z_filter_t filter = H5Pget_filter2(layout, static_cast<unsigned>(i), &flags, &values, nullptr,
                                                 name.size(), name.data(), &configuration);
      if (filter < 0 || H5Zfilter_avail(filter) > 0) continue;
      name.back() = '\0';
      refuse(path,
             fmt::format("is packed by the filter {} (number {}), which is not built into the HDF5 library; write "
                         "it with gzip (deflate), shuffle, or unpacked",
                         name.front() == '\0' ? "without a name" : in_quotes(name.data()), filter));
    }
  }
};

Hdf5File::Hdf5File(std::string_view bytes, std::string where) {
  make_library_safe();
  impl_ = std::make_unique<Impl>(bytes, std::move(where));
  if (!impl_->file) {
    throw InputError(
        fmt::format("{}: not a readable HDF5 file: its {} bytes are truncated or corrupt (superblock, from "
                    "byte 0, or what it points to)",
                    impl_->where, bytes.size()));
  }
}

Hdf5File::~Hdf5File() = default;

std::vector<std::string> Hdf5File::data_sets_in(const std::string& group) const {
  const Group opened(H5Gopen2(impl_->file.id(), group.c_str(), H5P_DEFAULT));
  if (!opened) return {};
  Visit visit;
  H5Literate(opened.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, visit_link, &visit);
  for (std::string& path : visit.paths) path.insert(0, group == "/" ? group : group + "/");
  return visit.paths;
}

std::vector<std::string> Hdf5File::matrices() const {
  Visit visit;
#if H5_VERSION_GE(1, 12, 0)
  const herr_t end = H5Ovisit3(impl_->file.id(), H5_INDEX_NAME, H5_ITER_INC, visit_object, &visit, H5O_INFO_BASIC);
#else
  const herr_t end = H5Ovisit2(impl_->file.id(), H5_INDEX_NAME, H5_ITER_INC, visit_object, &visit, H5O_INFO_BASIC);
#endif
  if (end < 0) {
    throw InputError(fmt::format("{}: the groups of the HDF5 file cannot be read; it is corrupt", impl_->where));
  }
  return visit.paths;
}

std::vector<std::string> Hdf5File::scales_of(const std::string& path, unsigned axis) const {
  const DataSet set(H5Dopen2(impl_->file.id(), path.c_str(), H5P_DEFAULT));
  Visit visit;
  if (set) H5DSiterate_scales(set.id(), axis, nullptr, visit_scale, &visit);
  return visit.paths;
}

std::vector<std::string> Hdf5File::attributes(const std::string& path) const {
  const Object object(H5Oopen(impl_->file.id(), path.c_str(), H5P_DEFAULT));
  Visit visit;
  if (object) H5Aiterate2(object.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, visit_attribute, &visit);
  return visit.paths;
}

bool Hdf5File::has_attribute(const std::string& path, const std::string& name) const {
  return H5Aexists_by_name(impl_->file.id(), path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::optional<Hdf5Value> Hdf5File::attribute(const std::string& path, const std::string& name) const {
  const Attribute opened(H5Aopen_by_name(impl_->file.id(), path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
  if (!opened) return std::nullopt;
  const Type type(H5Aget_type(opened.id()));
  const Space space(H5Aget_space(opened.id()));
  if (!type || !space) return std::nullopt;
  return small_value(type.id(), space.id(),
                     [&](hid_t native, void* buffer) { return H5Aread(opened.id(), native, buffer); });
}

std::optional<Hdf5Value> Hdf5File::table(const std::string& path) const {
  const DataSet set(H5Dopen2(impl_->file.id(), path.c_str(), H5P_DEFAULT));
  if (!set) return std::nullopt;
  const Type type(H5Dget_type(set.id()));
  const Space space(H5Dget_space(set.id()));
  if (!type || !space) return std::nullopt;
  return small_value(type.id(), space.id(), [&](hid_t native, void* buffer) {
    return H5Dread(set.id(), native, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer);
  });
}

Hdf5Matrix Hdf5File::matrix(const std::string& path, const PixelLimit& limit) const {
  const DataSet set(H5Dopen2(impl_->file.id(), path.c_str(), H5P_DEFAULT));
  if (!set) impl_->refuse(path, "is not there, or is no data set");
  const Space space(H5Dget_space(set.id()));
  const Type type(H5Dget_type(set.id()));
  const Properties layout(H5Dget_create_plist(set.id()));
  if (!space || !type || !layout) impl_->refuse(path, "has no readable type, size or layout");
  const std::vector<hsize_t> sizes = sizes_of(space.id());
  if (sizes.size() != 2) impl_->refuse(path, fmt::format("of {} dimensions; two are required", sizes.size()));
  if (!is_number(type.id())) impl_->refuse(path, "holds no integers or floating-point numbers, which are required");
  impl_->check_place(path, layout.id());
  impl_->check_filters(path, layout.id());
  impl_->check_size(path, layout.id(), sizes, type.id(), limit);
  const bool floating = H5Tget_class(type.id()) == H5T_FLOAT;
  const Hdf5Numbers numbers{floating, floating || H5Tget_sign(type.id()) == H5T_SGN_2, H5Tget_size(type.id()),
                            chosen_fill(layout.id())};
  Hdf5Matrix matrix{static_cast<std::size_t>(sizes[0]), static_cast<std::size_t>(sizes[1]), numbers, {}};
  matrix.values.resize(matrix.rows * matrix.cols);
  if (H5Dread(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, matrix.values.data()) < 0) {
    impl_->refuse(
        path, fmt::format("of {} x {} numbers cannot be read; the file is truncated or corrupt", sizes[0], sizes[1]));
  }
  return matrix;
}

}  // namespace dwell
