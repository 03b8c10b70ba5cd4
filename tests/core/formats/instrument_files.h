#pragma once

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/map/height_map.h"
#include "tests/core/formats/hdf5_test_file.h"
#include "tests/core/formats/zygo_dat_bytes.h"

namespace dwell::test {

/// A made-up part as several instruments would have written it, in small files that are committed under
/// tests/core/formats/files, so that the readers are tested on files in every checkout. Nothing in it was measured.
/// The writers here share no code with the program's own.

inline constexpr Index kPartRows = 18, kPartCols = 24;

/// Height of the part [nm], a multiple of 1/8. Turned over, transposed or shifted by a pixel it is another part: a bump
/// of 120 nm towards +x, a smaller one of 60 nm towards +y, a slope, and no data in the corner of smallest x and y.
inline double part_height(Index row, Index col) {
  if (row + col < 2) return std::nan("");
  const auto bump = [&](double height, double at_row, double at_col, double width) {
    const double y = (static_cast<double>(row) - at_row) / width, x = (static_cast<double>(col) - at_col) / width;
    return height * std::exp(-(x * x + y * y));
  };
  const double slope = 0.25 * static_cast<double>(col) - 0.5 * static_cast<double>(row);
  return std::round(8.0 * (bump(120.0, 9.0, 18.0, 2.5) + bump(60.0, 14.0, 7.0, 2.0) + slope)) / 8.0;
}

/// The heights, one row after the other; the row of the largest y first if `top_first`.
template <class Value>
std::vector<double> part_values(bool top_first, Value value) {
  std::vector<double> values;
  for (Index r = 0; r < kPartRows; ++r) {
    for (Index c = 0; c < kPartCols; ++c) values.push_back(value(part_height(top_first ? kPartRows - 1 - r : r, c)));
  }
  return values;
}

inline std::string dat_bytes() {
  ZygoDatFile file;
  file.intensity_cols = file.cols = kPartCols;
  file.intensity_rows = file.rows = kPartRows;
  file.frames = 1;
  file.left = 100;
  file.top = 50;
  file.intensity_bytes = 2 * kPartCols * kPartRows;
  file.phase_bytes = 4 * kPartCols * kPartRows;
  file.obliquity = 1.0F;
  file.resolution = 3e-4F;
  file.phase.clear();
  const double nm = 0.5 * 632.8 / 32768;  // of one number
  for (const double n : part_values(true, [nm](double h) { return std::isnan(h) ? 2147483640.0 : std::round(h / nm); }))
    file.phase.push_back(static_cast<std::int32_t>(n));
  return file.bytes();
}

/// The library of HDF5 may lay the same file out in another way: its bytes are not compared.
inline std::string datx_bytes() {
  Hdf5TestFile file;
  const std::string path = "/Data/Surface/{7B1C}";
  const hid_t untimed = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(untimed, false);
  const double none = 1.7976931348623157e308;
  file.doubles(path, {kPartRows, kPartCols},
               part_values(true, [none](double h) { return std::isnan(h) ? none : h / (0.5 * 632.8); }), untimed);
  H5Pclose(untimed);
  file.text(path, "Unit", "Fringes");
  file.number(path, "No Data", {none});
  file.converter(path, "X Converter", "Pixels", {0.0, 4e-4, 0.0, 0.0});
  file.converter(path, "Y Converter", "Pixels", {0.0, 2.5e-4, 0.0, 0.0});
  file.converter(path, "Z Converter", "Fringes", {0.0, 6.328e-7, 0.5, 1.0});
  file.number(path, "Wavelength", {6.328e-7});
  file.number(path, "Interferometric Scale Factor", {0.5});
  file.number(path, "Obliquity Factor", {1.0});
  file.coordinates(path, 50, 100, kPartCols, kPartRows);
  return file.bytes();
}

/// Lines of numbers, one a row of pixels. `word` writes a height.
template <class Word>
std::string part_lines(bool top_first, const char* separator, const char* line_end, Word word) {
  std::string text;
  for (Index r = 0; r < kPartRows; ++r) {
    for (Index c = 0; c < kPartCols; ++c) {
      const double h = part_height(top_first ? kPartRows - 1 - r : r, c);
      text += (c > 0 ? separator : "") + word(h);
    }
    text += line_end;
  }
  return text;
}

/// As the forerunner of the standard has it, the profile of the largest y first; an eighth of a nanometre a unit.
inline std::string sdf_bytes() {
  return "aBCR-1.0\r\nManufacID = none\r\nCreateDate = 010120261200\r\nModDate = 010120261200\r\nNumPoints = 24\r\n"
         "NumProfiles = 18\r\nXscale = 4e-4\r\nYscale = 2.5e-4\r\nZscale = 1.25e-10\r\nZresolution = 1.25e-10\r\n"
         "Compression = 0\r\nDataType = 5\r\nCheckType = 0\r\n*\r\n" +
         part_lines(true, " ", "\r\n",
                    [](double h) { return std::isnan(h) ? std::string("BAD") : fmt::format("{:.0f}", 8.0 * h); }) +
         "*\r\nmade up\r\n*\r\n";
}

inline std::string int_bytes() {
  return "! made up\na part\nGRD 24 18 SUR WVL 0.6328 NNR SSZ 5000 NDA -32768\n" +
         part_lines(true, " ", "\n", [](double h) {
           return std::isnan(h) ? std::string("-32768") : fmt::format("{:.0f}", h * 5000.0 / 632.8);
         });
}

inline std::string fits_part_bytes() {
  std::string bytes;
  for (const char* card :
       {"SIMPLE  =                    T", "BITPIX  =                  -32", "NAXIS   =                    2",
        "NAXIS1  =                   24", "NAXIS2  =                   18", "CDELT1  =                0.400",
        "CDELT2  =                0.250", "CRPIX1  =                  1.0", "CRPIX2  =                  1.0",
        "CRVAL1  =                 -4.0", "CRVAL2  =                  2.5", "CUNIT1  = 'mm      '",
        "CUNIT2  = 'mm      '", "BUNIT   = 'nm      '", "END"}) {
    bytes += fmt::format("{:<80}", card);
  }
  bytes.resize(2880, ' ');
  for (const double h : part_values(false, [](double v) { return v; })) {
    const auto bits = std::isnan(h) ? 0x7fc00000U : std::bit_cast<std::uint32_t>(static_cast<float>(h));
    for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes += static_cast<char>(bits >> shift);
  }
  bytes.resize(2 * 2880, '\0');
  return bytes;
}

inline std::string xyz_bytes() {
  std::string text = "x_mm y_mm z_um\n";
  for (Index r = 0; r < kPartRows; ++r) {
    for (Index c = 0; c < kPartCols; ++c) {
      const double h = part_height(r, c);
      text += fmt::format("{:.2f} {:.2f} {}\n", 0.4 * static_cast<double>(c) - 4.0, 0.25 * static_cast<double>(r) + 2.5,
                          std::isnan(h) ? "No Data" : fmt::format("{:.6f}", 1e-3 * h));
    }
  }
  return text;
}

inline std::string csv_bytes() {
  return "# pitch_mm: 0.4,0.25\n# origin_mm: -4,2.5\n# unit: nm\n" +
         part_lines(false, ";", "\n", [](double h) { return std::isnan(h) ? std::string() : fmt::format("{}", h); });
}

/// Single precision, little endian, as cameras are read out.
inline std::string npy_part_bytes() {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (18, 24), }";
  header.resize(117, ' ');  // so that the data begin at a multiple of 64
  std::string bytes = std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + "\n";
  for (const double h : part_values(false, [](double v) { return v; })) {
    const auto bits = std::isnan(h) ? 0x7fc00000U : std::bit_cast<std::uint32_t>(static_cast<float>(h));
    for (const unsigned shift : {0U, 8U, 16U, 24U}) bytes += static_cast<char>(bits >> shift);
  }
  return bytes;
}

struct InstrumentFile {
  const char* name;
  std::string (*bytes)();
  Grid grid;                   // as it is to be read
  double tolerance;            // half a step of its numbers [nm]
  std::optional<Point> pitch;  // that the user gives [mm], for formats that carry none
  double scale = 1.0;          // from the file's unit to nm
};

inline std::vector<InstrumentFile> instrument_files() {
  const double dat = 1e3 * static_cast<double>(3e-4F);
  const auto oblong = [](double x, double y) { return Grid{kPartRows, kPartCols, 0.4, 0.25, {x, y}}; };
  const auto square = [](double pitch, double x, double y) { return Grid{kPartRows, kPartCols, pitch, pitch, {x, y}}; };
  // On a camera the first pixel of the map is the lower left one: row 50 + 17, counted downwards.
  return {{"part.dat", dat_bytes, square(dat, 100 * dat, -67 * dat), 0.005, {}},
          {"part.datx", datx_bytes, oblong(100 * 0.4, -67 * 0.25), 1e-9, {}},
          {"part.sdf", sdf_bytes, oblong(0.0, 0.0), 1e-9, {}},
          {"part.int", int_bytes, square(0.3, 0.0, 0.0), 0.064, square_pitch(0.3)},
          {"part.fits", fits_part_bytes, oblong(-4.0, 2.5), 1e-9, {}},
          {"part.xyz", xyz_bytes, oblong(-4.0, 2.5), 1e-9, {}, 1e3},
          {"part.csv", csv_bytes, oblong(-4.0, 2.5), 1e-9, {}},
          {"part.npy", npy_part_bytes, oblong(0.0, 0.0), 1e-9, Point{0.4, 0.25}}};
}

}  // namespace dwell::test
