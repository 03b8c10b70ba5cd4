#include "core/formats/npy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "core/base/doubles_of_bytes.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {
namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";

/// A little-endian unsigned integer.
std::size_t little_endian(std::string_view bytes) {
  std::size_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// The dictionary and the data of the file.
struct Parts {
  std::string_view header;
  std::string_view data;
};

Parts split_file(std::string_view bytes, const std::string& where) {
  const auto require = [&](std::size_t size) {
    if (bytes.size() < size) {
      throw InputError(fmt::format("{}: truncated NPY file; {} bytes, its header needs {}", where, bytes.size(), size));
    }
  };
  require(8);
  const int version = static_cast<unsigned char>(bytes[6]);
  if (version < 1 || version > 3) {
    throw InputError(fmt::format("{}: NPY format version {}; 1, 2 and 3 are accepted", where, version));
  }
  const std::size_t begin = version == 1 ? 10 : 12;
  require(begin);
  const std::size_t size = little_endian(bytes.substr(8, begin - 8));
  require(begin + size);
  return {bytes.substr(begin, size), bytes.substr(begin + size)};
}

/// The text after `'key':` in the header's dictionary.
std::string_view entry(std::string_view header, std::string_view key, const std::string& where) {
  for (const char quote : {'\'', '"'}) {
    const std::size_t at = header.find(fmt::format("{}{}{}", quote, key, quote));
    if (at == std::string_view::npos) continue;
    const std::string_view after = trim(header.substr(at + key.size() + 2));
    if (after.starts_with(':')) return trim(after.substr(1));
  }
  throw InputError(fmt::format("{}: NPY header has no '{}'; descr, fortran_order and shape are required", where, key));
}

struct Shape {
  Index rows = 0;
  Index cols = 0;
};

Shape parse_shape(std::string_view text, const std::string& where) {
  const std::size_t close = text.find(')');
  const std::string_view tuple = text.substr(0, close == std::string_view::npos ? close : close + 1);
  const auto refuse = [&]() {
    throw InputError(
        fmt::format("{}: NPY shape {}; two dimensions (rows, columns) of at least 1 are required", where, tuple));
  };
  if (!tuple.starts_with('(') || close == std::string_view::npos) refuse();
  std::vector<std::string_view> fields = split(tuple.substr(1, tuple.size() - 2), ',');
  if (fields.size() == 3 && trim(fields.back()).empty()) fields.pop_back();
  if (fields.size() != 2) refuse();
  std::array<Index, 2> sizes{};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string_view field = trim(fields[i]);
    const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), sizes[i]);
    if (error != std::errc() || stop != field.data() + field.size() || sizes[i] < 1) refuse();
  }
  return {sizes[0], sizes[1]};
}

/// One stored number as a double; bytes in the file's order.
template <class T>
double stored(const char* bytes, bool reversed) {
  std::array<char, sizeof(T)> raw;
  std::copy_n(bytes, sizeof(T), raw.begin());
  if (reversed) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<T>(raw));
}

struct ElementType {
  std::string_view name;
  std::size_t size;
  double (*read)(const char*, bool);
};

constexpr std::array<ElementType, 10> kElementTypes{{{"f4", 4, stored<float>},
                                                     {"f8", 8, stored<double>},
                                                     {"i1", 1, stored<std::int8_t>},
                                                     {"i2", 2, stored<std::int16_t>},
                                                     {"i4", 4, stored<std::int32_t>},
                                                     {"i8", 8, stored<std::int64_t>},
                                                     {"u1", 1, stored<std::uint8_t>},
                                                     {"u2", 2, stored<std::uint16_t>},
                                                     {"u4", 4, stored<std::uint32_t>},
                                                     {"u8", 8, stored<std::uint64_t>}}};

struct Element {
  ElementType type;
  bool reversed = false;
};

Element parse_descr(std::string_view text, const std::string& where) {
  const std::size_t close = text.empty() ? std::string_view::npos : text.find(text.front(), 1);
  const bool quoted = close != std::string_view::npos && (text.front() == '\'' || text.front() == '"');
  const std::string_view descr = quoted ? text.substr(1, close - 1) : text.substr(0, 40);
  if (quoted && descr.size() > 1) {
    const char order = descr.front();
    for (const ElementType& type : kElementTypes) {
      const bool known_order = order == '<' || order == '>' || order == '=' || (order == '|' && type.size == 1);
      if (descr.substr(1) != type.name || !known_order) continue;
      constexpr bool kBig = std::endian::native == std::endian::big;
      return {type, (order == '<' && kBig) || (order == '>' && !kBig)};
    }
  }
  throw InputError(fmt::format(
      "{}: NPY element type {}; real numbers f4, f8, i1, i2, i4, i8, u1, u2, u4, u8 are accepted", where, descr));
}

bool parse_fortran_order(std::string_view text, const std::string& where) {
  if (text.starts_with("True")) return true;
  if (text.starts_with("False")) return false;
  throw InputError(fmt::format("{}: NPY fortran_order is '{}'; True or False is required", where, text.substr(0, 10)));
}

std::string header_bytes(const std::string& shape) {
  std::string dictionary = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}", shape);
  constexpr std::size_t kBefore = 10, kAlignment = 64;
  const std::size_t used = kBefore + dictionary.size() + 1;
  dictionary.append((kAlignment - used % kAlignment) % kAlignment, ' ');
  dictionary += '\n';
  std::string bytes(kNpyMagic);
  bytes += '\x01';
  bytes += '\0';
  bytes += static_cast<char>(dictionary.size() & 0xff);
  bytes += static_cast<char>(dictionary.size() >> 8);
  return bytes + dictionary;
}

void append_values(std::string& bytes, std::span<const double> values) {
  const std::size_t begin = bytes.size();
  bytes.resize(begin + values.size_bytes());
  if (!values.empty()) std::memcpy(bytes.data() + begin, values.data(), values.size_bytes());
  if constexpr (std::endian::native == std::endian::big) {
    for (std::size_t i = begin; i < bytes.size(); i += sizeof(double)) {
      std::reverse(bytes.data() + i, bytes.data() + i + sizeof(double));
    }
  }
}

}  // namespace

bool is_npy(std::string_view bytes) { return bytes.starts_with(kNpyMagic); }

MapSource parse_npy(std::string_view bytes, const std::string& where, const PixelLimit& limit) {
  if (!is_npy(bytes)) throw InputError(fmt::format("{}: not an NPY file; it must begin with \\x93NUMPY", where));
  const Parts parts = split_file(bytes, where);
  const Element element = parse_descr(entry(parts.header, "descr", where), where);
  const bool fortran = parse_fortran_order(entry(parts.header, "fortran_order", where), where);
  const Shape shape = parse_shape(entry(parts.header, "shape", where), where);

  const std::size_t held = parts.data.size() / element.type.size;
  const auto rows = static_cast<std::size_t>(shape.rows), cols = static_cast<std::size_t>(shape.cols);
  // Divided, not multiplied: an absurd shape must not overflow into a plausible size.
  if (rows > held / cols || rows * cols * element.type.size != parts.data.size()) {
    throw InputError(fmt::format(
        "{}: {} NPY file; shape ({}, {}) of {}-byte numbers, but {} bytes of data follow the "
        "header",
        where, rows > held / cols ? "truncated" : "overlong", rows, cols, element.type.size, parts.data.size()));
  }
  check_pixels(static_cast<double>(rows), static_cast<double>(cols), limit, where);
  MapSource matrix;
  matrix.rows = shape.rows;
  matrix.cols = shape.cols;
  if (element.type.name == "f8" && !element.reversed && !fortran) {
    matrix.values = doubles_of(parts.data);
    return matrix;
  }
  matrix.values.resize(rows * cols);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t col = 0; col < cols; ++col) {
      const std::size_t at = fortran ? col * rows + row : row * cols + col;
      matrix.values[row * cols + col] = element.type.read(parts.data.data() + at * element.type.size, element.reversed);
    }
  }
  return matrix;
}

std::string npy_bytes(const HeightMap& map) {
  std::string bytes = header_bytes(fmt::format("{}, {}", map.grid.rows, map.grid.cols));
  append_values(bytes, map.values);
  return bytes;
}

std::string npy_bytes(std::span<const double> values) {
  std::string bytes = header_bytes(fmt::format("{},", values.size()));
  append_values(bytes, values);
  return bytes;
}

}  // namespace dwell
