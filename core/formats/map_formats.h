#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/grid_limit.h"
#include "core/base/staged_files.h"
#include "core/formats/map_source.h"
#include "core/map/height_map.h"

namespace dwell {

/// A format that holds a regular array of heights. Formats are tried in the order of the table.
struct MapFormat {
  const char* name;  // as messages list it: "an NPY array (.npy)"
  const char* fuzz;  // its fuzz target: tests/fuzz/reader_FUZZ.cpp with seeds/FUZZ
  /// Whether a file of these first bytes and this extension (lower case, with its dot) is to be read as one.
  bool (*claims)(std::string_view bytes, std::string_view extension);
  /// Reads it. `where` begins error messages ("map part.dat"). Throws InputError naming byte, line or field, and,
  /// before it takes memory for them, for more pixels than the limit.
  MapSource (*read)(std::string_view bytes, const std::string& where, const PixelLimit& limit);
  /// Reads the array at a path in a file that may hold several (core/formats/map_name.h); null for formats that hold
  /// one.
  MapSource (*read_inside)(std::string_view bytes, const std::string& path, const std::string& where,
                           const PixelLimit& limit) = nullptr;
};

/// Every format with a record, in the order in which a file is tried; text is what is left (map_format_of).
std::span<const MapFormat> map_formats();

/// The format that claims the file, or null: text, lines x y z (core/formats/xyz_text.h) or a matrix
/// (core/formats/matrix_text.h).
const MapFormat* map_format_of(std::string_view bytes, std::string_view extension);

/// What read_map accepts, for messages: names of all formats.
std::string accepted_map_formats();

/// A format that maps are written in, by the extension of the file (lower case, with its dot).
struct MapWriter {
  const char* extension;
  /// Writes the file, and what belongs to it, under temporary names (core/base/staged_files.h).
  void (*stage)(const std::filesystem::path& file, const HeightMap& map, StagedFiles& files);
};

/// The writer of an extension, or null.
const MapWriter* map_writer_of(std::string_view extension);

/// What write_map accepts, for messages: ".csv, .txt, ... and .npy".
std::string written_map_extensions();

}  // namespace dwell
