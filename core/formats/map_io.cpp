#include "core/formats/map_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/whole_file.h"
#include "core/formats/file_kind.h"
#include "core/formats/map_formats.h"
#include "core/formats/map_name.h"
#include "core/formats/matrix_text.h"
#include "core/formats/npy.h"
#include "core/formats/npy_sidecar.h"
#include "core/formats/part_size.h"
#include "core/formats/point_grid.h"
#include "core/formats/xyz_text.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr double kSame = 1e-9;  // relative difference up to which an option and a header agree

bool same(double a, double b, double size) { return std::abs(a - b) <= kSame * size; }

void check_options(const MapReadOptions& options, const std::string& where) {
  if (options.pitch && !(std::isfinite(*options.pitch) && *options.pitch > 0.0)) {
    const std::string value = fmt::format("{} mm", *options.pitch);
    throw InputError(
        options.name + " pixel", value, "a finite pixel pitch > 0",
        fmt::format("`{} pixel` = {} for {}; a finite pixel pitch > 0 is required", options.name, value, where));
  }
  if (options.origin && !(std::isfinite(options.origin->x) && std::isfinite(options.origin->y))) {
    const std::string value = fmt::format("{},{} mm", options.origin->x, options.origin->y);
    throw InputError(options.name + " origin", value, "finite numbers",
                     fmt::format("`{} origin` = {} for {}; finite numbers are required", options.name, value, where));
  }
  if (!(std::isfinite(options.scale) && options.scale > 0.0)) {
    throw InputError(options.name + " unit", fmt::format("{}", options.scale), "a factor that is finite and > 0",
                     fmt::format("`{} unit` gives a factor of {} for {}; it must be finite and > 0", options.name,
                                 options.scale, where));
  }
}

/// Pitch of header and option, which must agree; nothing if neither says it.
std::optional<Point> known_pitch(const MapHeader& header, const MapReadOptions& options, const std::string& where) {
  if (!options.pitch) return header.pitch;
  const double pitch = *options.pitch;
  if (!header.pitch) return Point{pitch, pitch};
  const double rounding = header.pitch_rounding * pitch;
  if (!(std::abs(header.pitch->x - pitch) <= rounding && std::abs(header.pitch->y - pitch) <= rounding)) {
    throw InputError(
        fmt::format("{}: header says pitch_mm = {},{} but `{} pixel` says {}; they must agree (or the option "
                    "be left out)",
                    where, header.pitch->x, header.pitch->y, options.name, pitch));
  }
  return header.pitch;
}

std::optional<Point> known_origin(const MapHeader& header, const MapReadOptions& options, const std::string& where) {
  if (!options.origin || !header.origin) return options.origin ? options.origin : header.origin;
  const Point given = *options.origin;
  // An origin may be zero, so the pitch (of a header with an origin, if it says one) also counts as its size.
  const double pitch = header.pitch ? std::min(header.pitch->x, header.pitch->y) : 0.0;
  if (!same(header.origin->x, given.x, std::max(std::abs(given.x), pitch)) ||
      !same(header.origin->y, given.y, std::max(std::abs(given.y), pitch))) {
    throw InputError(
        fmt::format("{}: header says origin_mm = {},{} but `{} origin` says {},{}; they must agree (or the "
                    "option be left out)",
                    where, header.origin->x, header.origin->y, options.name, given.x, given.y));
  }
  return header.origin;
}

/// A file that names its unit must be read with that unit: no file is scaled twice, or not at all, unnoticed.
void check_unit(const MapHeader& header, const MapReadOptions& options, const std::string& where) {
  if (!header.unit) return;
  double factor = 0.0;
  try {
    factor = unit_factor(*header.unit, options.quantity);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: header says unit {} ({})", where, error.what(),
                                 options.quantity == MapQuantity::Rate
                                     ? "removal rates are required here, not heights; of the surface that spots left, "
                                       "give their `tif dwell time`"
                                     : "heights are required here, not rates"));
  }
  if (!same(factor, options.scale, factor)) {
    throw InputError(
        fmt::format("{}: header says unit {} (a factor of {} to nm), but `{} unit` gives a factor of {}; they "
                    "must agree: give `{} unit` {}",
                    where, *header.unit, factor, options.name, options.scale, options.name, *header.unit));
  }
}

/// Without an origin a map begins at (0, 0): what may be one must not be skipped.
void check_origin_is_clear(const MapSource& source, const MapReadOptions& options, const std::string& where) {
  if (source.unclear_origin.empty() || source.header.origin || options.origin || !options.origin_counts) return;
  const std::string way_out =
      options.name == "tif" ? "give `tif centre` middle or centroid, for which it does not matter"
                            : fmt::format(
                                  "give `{} origin` X,Y in mm, the centre of the map's first pixel (0,0 if it does "
                                  "not matter)",
                                  options.name);
  throw InputError(fmt::format("{}: {}: what looks like an origin leaves open of what it is, or in which unit; {}",
                               where, source.unclear_origin, way_out));
}

HeightMap map_of_source(MapSource source, const MapReadOptions& options, const std::string& where) {
  check_unit(source.header, options, where);
  check_origin_is_clear(source, options, where);
  check_pixels(static_cast<double>(source.rows), static_cast<double>(source.cols), options.limit, where);
  const std::optional<Point> pitch = known_pitch(source.header, options, where);
  if (!pitch) {
    throw InputError(fmt::format("{}: the file says no pixel pitch; give `{} pixel` [mm] > 0{}", where, options.name,
                                 source.pitch_hint));
  }
  const Point on_camera{source.camera_pixel.x * pitch->x, source.camera_pixel.y * pitch->y};
  const Point origin = known_origin(source.header, options, where).value_or(on_camera);
  const Grid grid{source.rows, source.cols, pitch->x, pitch->y, origin};
  const std::string field = source.header.pitch ? source.pitch_field : fmt::format("`{} pixel`", options.name);
  check_part_size(grid, field.empty() ? "pitch_mm" : field, where);
  HeightMap map(grid, std::move(source.values));
  map.history = std::move(source.header.history);
  map.quantity = options.quantity;
  return map;
}

HeightMap read_xyz(std::string_view text, const MapReadOptions& options, const std::string& where) {
  XyzText xyz = parse_xyz_text(text, where);
  check_unit(xyz.header, options, where);
  HeightMap map = grid_points(xyz.points, known_pitch(xyz.header, options, where),
                              known_origin(xyz.header, options, where), where, options.name, options.limit);
  check_part_size(map.grid, "the points' pitch", where);
  map.history = std::move(xyz.header.history);
  map.quantity = options.quantity;
  return map;
}

std::string extension_of(const std::filesystem::path& file) { return lower_case(file.extension().string()); }

MapSource read_array(const MapFormat& format, std::string_view bytes, const std::string& inside,
                     const std::string& where, const PixelLimit& limit) {
  if (inside.empty()) return format.read(bytes, where, limit);
  if (format.read_inside) return format.read_inside(bytes, inside, where, limit);
  throw InputError(
      fmt::format("{}: the file is {}, which holds one array; leave out ':{}'", where, format.name, inside));
}

HeightMap parse_map(const MapName& name, std::string_view bytes, const MapReadOptions& options,
                    const std::string& where) {
  if (bytes.empty()) {
    throw InputError(fmt::format("{}: the file is empty; {} is required", where, accepted_map_formats()));
  }
  const std::string extension = extension_of(name.file);
  if (const MapFormat* format = map_format_of(bytes, extension)) {
    MapSource source = read_array(*format, bytes, name.inside, where, options.limit);
    if (is_npy(bytes)) add_npy_sidecar(name.file, bytes, source);
    return map_of_source(std::move(source), options, where);
  }
  const std::string binary = kind_of_binary(bytes);
  if (!binary.empty()) {
    throw InputError(fmt::format("{}: the file looks like {}; {} is required", where, binary, accepted_map_formats()));
  }
  if (!name.inside.empty()) {
    throw InputError(fmt::format("{}: the file is text, which holds one array; leave out ':{}'", where, name.inside));
  }
  if (extension == ".npy") throw InputError(fmt::format("{}: not an NPY array but text; name it .csv or .xyz", where));
  if (extension == ".xyz" || names_xyz_columns(bytes)) return read_xyz(bytes, options, where);
  return map_of_source(parse_matrix_text(bytes, where), options, where);
}

/// Values to nm; every one finite or NaN, and one at least finite.
void scale_and_check(HeightMap& map, double scale, const std::string& where) {
  bool any = false;
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    double& value = map.values[i];
    const double read = value;
    value *= scale;
    if (std::isinf(value)) {
      const Index pixel = static_cast<Index>(i);
      throw InputError(
          fmt::format("{}: value {} in row {}, column {} of the map is infinite (in nm); a finite number, or "
                      "nan for no data, is required",
                      where, read, pixel / map.grid.cols + 1, pixel % map.grid.cols + 1));
    }
    any = any || std::isfinite(value);
  }
  if (!any) {
    throw InputError(fmt::format("{}: all {} values are no data (nan); at least one finite value is required", where,
                                 map.values.size()));
  }
}

}  // namespace

HeightMap read_map(const std::filesystem::path& file, const MapReadOptions& options) {
  const std::string where = fmt::format("{} {}", options.name, file.string());
  check_options(options, where);
  const MapName name = split_map_name(file);
  HeightMap map = parse_map(name, read_whole_file(name.file), options, where);
  scale_and_check(map, options.scale, where);
  return map;
}

void stage_map(const std::filesystem::path& file, const HeightMap& map, StagedFiles& files) {
  if (std::any_of(map.values.begin(), map.values.end(), [](double v) { return std::isinf(v); })) {
    throw InputError(
        fmt::format("cannot write '{}': the map holds an infinite value; finite or NaN is required", file.string()));
  }
  const std::string extension = extension_of(file);
  const MapWriter* writer = map_writer_of(extension);
  if (!writer) {
    throw InputError(fmt::format("cannot write '{}': extension '{}' is not of a map format; {} are accepted",
                                 file.string(), extension, written_map_extensions()));
  }
  writer->stage(file, map, files);
}

void write_map(const std::filesystem::path& file, const HeightMap& map) {
  StagedFiles files;
  stage_map(file, map, files);
  files.put_in_place();
}

}  // namespace dwell
