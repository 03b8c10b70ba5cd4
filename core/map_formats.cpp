#include "core/map_formats.h"

#include <array>

#include "core/matrix_text.h"
#include "core/npy.h"
#include "core/xyz_text.h"

namespace dwell {
namespace {

constexpr std::array kFormats{
    MapFormat{"an NPY array (.npy)", [](std::string_view bytes, std::string_view) { return is_npy(bytes); }, parse_npy},
};

constexpr std::array kWriters{
    MapWriter{".csv", [](const HeightMap& map) { return matrix_text(map, ','); }},
    MapWriter{".txt", [](const HeightMap& map) { return matrix_text(map, ' '); }},
    MapWriter{".xyz", xyz_text},
    MapWriter{".npy", [](const HeightMap& map) { return npy_bytes(map); }},
};

/// "a, b and c" with the last word before c.
template <class Table, class Name>
std::string listed(const Table& table, Name name, const char* last_word) {
  std::string names;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (i > 0) names += i + 1 == table.size() ? last_word : ", ";
    names += name(table[i]);
  }
  return names;
}

}  // namespace

const MapFormat* map_format_of(std::string_view bytes, std::string_view extension) {
  for (const MapFormat& format : kFormats) {
    if (format.claims(bytes, extension)) return &format;
  }
  return nullptr;
}

std::string accepted_map_formats() {
  const std::string text = "a matrix of numbers (.csv, .txt), lines x y z (.xyz)";
  const std::string others = listed(
      kFormats, [](const MapFormat& format) { return format.name; }, " or ");
  return text + (kFormats.size() == 1 ? " or " : ", ") + others;
}

const MapWriter* map_writer_of(std::string_view extension) {
  for (const MapWriter& writer : kWriters) {
    if (extension == writer.extension) return &writer;
  }
  return nullptr;
}

std::string written_map_extensions() {
  return listed(
      kWriters, [](const MapWriter& writer) { return writer.extension; }, " and ");
}

}  // namespace dwell
