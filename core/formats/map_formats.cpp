#include "core/formats/map_formats.h"

#include <array>

#include "core/formats/codev_int.h"
#include "core/formats/fits.h"
#include "core/formats/hdf5_map.h"
#include "core/formats/matrix_text.h"
#include "core/formats/npy.h"
#include "core/formats/npy_sidecar.h"
#include "core/formats/sdf_text.h"
#include "core/formats/xyz_text.h"
#include "core/formats/zygo_dat.h"

namespace dwell {
namespace {

/// Files that begin as one, and those that are named as one: these are then refused as no such file.
bool claims_hdf5(std::string_view bytes, std::string_view extension) {
  return is_hdf5(bytes) || extension == ".datx" || extension == ".h5" || extension == ".hdf5";
}

bool claims_fits(std::string_view bytes, std::string_view extension) {
  return is_fits(bytes) || extension == ".fits" || extension == ".fit";
}

constexpr std::array kFormats{
    MapFormat{"an NPY array (.npy)", "npy", [](std::string_view bytes, std::string_view) { return is_npy(bytes); },
              parse_npy},
    MapFormat{"a Zygo MetroPro file (.dat)", "zygo_dat",
              [](std::string_view bytes, std::string_view) { return is_zygo_dat(bytes); }, parse_zygo_dat},
    MapFormat{"a Zygo .datx or other HDF5 file (.h5, .hdf5)", "hdf5", claims_hdf5, parse_hdf5, parse_hdf5_at},
    MapFormat{"a FITS image (.fits)", "fits", claims_fits, parse_fits, parse_fits_at},
    MapFormat{"a surface data file as text (.sdf)", "sdf_text",
              [](std::string_view bytes, std::string_view extension) { return is_sdf(bytes) || extension == ".sdf"; },
              parse_sdf_text},
    MapFormat{
        "a Code V interferogram (.int)", "codev_int",
        [](std::string_view bytes, std::string_view extension) { return is_codev_int(bytes) || extension == ".int"; },
        parse_codev_int},
};

std::string csv_text(const HeightMap& map) { return matrix_text(map, ','); }
std::string blank_text(const HeightMap& map) { return matrix_text(map, ' '); }

template <std::string (*bytes)(const HeightMap& map)>
void stage_bytes(const std::filesystem::path& file, const HeightMap& map, StagedFiles& files) {
  files.add(file, bytes(map));
}

constexpr std::array kWriters{
    MapWriter{".csv", stage_bytes<csv_text>},      MapWriter{".txt", stage_bytes<blank_text>},
    MapWriter{".xyz", stage_bytes<xyz_text>},      MapWriter{".npy", stage_npy_with_sidecar},
    MapWriter{".h5", stage_bytes<hdf5_map_bytes>}, MapWriter{".hdf5", stage_bytes<hdf5_map_bytes>},
    MapWriter{".fits", stage_bytes<fits_bytes>},   MapWriter{".sdf", stage_bytes<sdf_text>},
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

std::span<const MapFormat> map_formats() { return kFormats; }

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
