#include "core/formats/map_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/value_range.h"
#include "core/base/whole_file.h"
#include "core/formats/file_kind.h"
#include "core/formats/map_formats.h"
#include "core/formats/map_name.h"
#include "core/formats/matrix_text.h"
#include "core/formats/npy.h"
#include "core/formats/npy_sidecar.h"
#include "core/formats/part_size.h"
#include "core/formats/point_grid.h"
#include "core/formats/value_span.h"
#include "core/formats/wave_scale.h"
#include "core/formats/wavefront_words.h"
#include "core/formats/xyz_text.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr double kSame = 1e-9;  // relative difference up to which an option and a header agree

bool same(double a, double b, double size) { return std::abs(a - b) <= kSame * size; }

void check_options(const MapReadOptions& options, const std::string& where) {
  const auto is_pitch = [](double mm) { return std::isfinite(mm) && mm > 0.0; };
  if (options.pitch && !(is_pitch(options.pitch->x) && is_pitch(options.pitch->y))) {
    const std::string value = pitch_option_text(*options.pitch) + " mm";
    throw InputError(
        options.name + " pixel", value, "a finite pixel pitch > 0",
        fmt::format("`{} pixel` = {} for {}; a finite pixel pitch > 0 is required", options.name, value, where));
  }
  if (options.origin && !(std::isfinite(options.origin->x) && std::isfinite(options.origin->y))) {
    const std::string value = fmt::format("{},{} mm", options.origin->x, options.origin->y);
    throw InputError(options.name + " origin", value, "finite numbers",
                     fmt::format("`{} origin` = {} for {}; finite numbers are required", options.name, value, where));
  }
  check_wave_options(options.waves, where);
  if (options.scale && !(std::isfinite(*options.scale) && *options.scale > 0.0)) {
    throw InputError(options.name + " unit", fmt::format("{}", *options.scale), "a factor that is finite and > 0",
                     fmt::format("`{} unit` gives a factor of {} for {}; it must be finite and > 0", options.name,
                                 *options.scale, where));
  }
}

/// Pitch of header and option, which must agree; nothing if neither says it.
std::optional<Point> known_pitch(const MapHeader& header, const MapReadOptions& options, const std::string& where) {
  if (!options.pitch) return header.pitch;
  const Point pitch = *options.pitch;
  if (!header.pitch) return pitch;
  const auto agree = [&header](double said, double given) {
    return std::abs(said - given) <= header.pitch_rounding * given;
  };
  if (!agree(header.pitch->x, pitch.x) || !agree(header.pitch->y, pitch.y)) {
    throw InputError(fmt::format(
        "{}: header says pitch_mm = {},{} but `{} pixel` says {}; they must agree (or the option "
        "be left out)",
        where, fewest_digits(header.pitch->x), fewest_digits(header.pitch->y), options.name, pitch_option_text(pitch)));
  }
  // What the file rounds more than single precision would, as the size of a field, the user may know better.
  if (header.pitch_rounding > kSinglePitchRounding) return pitch;
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

/// Why a unit is none of the quantity.
std::string unit_hint(const std::string& unit, MapQuantity quantity) {
  if (quantity == MapQuantity::Rate && known_length_unit(unit)) {
    return " (removal rates are required here, not heights; of the surface that spots left, give their `tif dwell "
           "time`)";
  }
  if (quantity == MapQuantity::Height && known_rate_unit(unit)) return " (heights are required here, not rates)";
  return "";
}

/// The factor of a unit to nm (nm/s). A file that names its unit must be read with that unit: no file is scaled twice,
/// or not at all, unnoticed. `wave`: of a unit that is waves [nm].
double known_unit(const MapHeader& header, const std::optional<double>& wave, const MapReadOptions& options,
                  const std::string& where) {
  if (!header.unit) return wave.value_or(options.scale.value_or(1.0));
  double factor = 0.0;
  try {
    factor = wave ? *wave : unit_factor(*header.unit, options.quantity);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}: header says unit {}{}", where, error.what(), unit_hint(*header.unit, options.quantity)));
  }
  if (options.scale && !same(factor, *options.scale, factor)) {
    throw InputError(
        fmt::format("{}: header says unit {} (a factor of {} to nm), but `{} unit` gives a factor of {}; they "
                    "must agree: leave it out, or give `{} unit` {}",
                    where, *header.unit, factor, options.name, *options.scale, options.name, *header.unit));
  }
  return factor;
}

/// The factor to nm (nm/s) of the surface. What was done about waves is appended to the header's history.
double known_scale(MapHeader& header, const MapReadOptions& options, const std::string& where) {
  const WaveReading waves = read_waves(options.waves, header, options.quantity, options.name, where);
  return waves.scale * known_unit(header, waves.wave, options, where);
}

/// Whether neither the file nor the options say the unit.
bool assumes_unit(const MapHeader& header, const MapReadOptions& options) {
  return !header.unit && !options.scale && !options.waves.in_waves;
}

/// What the name of the file itself calls its data.
void read_file_name(MapHeader& header, const MapName& name, const MapReadOptions& options, const std::string& where) {
  if (options.quantity != MapQuantity::Height) return;
  // Of several arrays the file may be named after another one.
  if (header.other_is_wavefront && !name.inside.empty()) return;
  note_wavefront(name.file.stem().string(), where, "the name of the file", header);
}

/// Refuses what the header says unclearly and neither it nor an option says clearly. The places of points say pitch and
/// origin as well.
void settle_unclear(const MapHeader& header, const MapReadOptions& options, bool points) {
  using About = UnclearStatement::About;
  for (const UnclearStatement& unclear : header.unclear) {
    const auto [settled, option] = [&]() -> std::pair<bool, std::string> {
      switch (unclear.about) {
        case About::Unit:
          return {header.unit || options.scale || options.waves.in_waves, "unit"};
        case About::Factor:
          return {options.scale || options.waves.in_waves, "unit"};
        case About::Pitch:
          return {points || header.pitch || options.pitch, "pixel"};
        case About::Places:
          return points ? std::pair(header.places_known, "") : std::pair(header.pitch || options.pitch, "pixel");
        case About::Origin:
          return {points || header.origin || options.origin || !options.origin_counts, "origin"};
        case About::Shift:
          return {header.origin || options.origin || !options.origin_counts, "origin"};
        case About::Rows:
          return {points || options.rows, "rows"};
        case About::Axes:
          return {options.rows.has_value(), "rows"};
        case About::NoData:
          return {!header.no_data.empty() || options.no_data, "no data"};
        case About::Wavefront:
          return {options.waves.scale || states_wave_scale(header), ""};
      }
      return {false, ""};
    }();
    if (settled) continue;
    if (unclear.about == About::Wavefront)
      throw InputError(unclear.message + way_out_of_wavefront(options.name == "map"));
    // The origin of a removal function is where its tool axis says; no option gives it.
    const bool has_option = !option.empty() && (option != "origin" || options.name == "map");
    throw InputError(unclear.message + (has_option ? fmt::format("; or give `{} {}`", options.name, option) : ""));
  }
}

void append(std::vector<std::string>& history, std::vector<std::string> lines) {
  history.insert(history.end(), std::make_move_iterator(lines.begin()), std::make_move_iterator(lines.end()));
}

/// Numbers of the file to nm (nm/s); what no part has is refused.
void scale_values(HeightMap& map, double scale, const MapReadOptions& options, const std::string& where) {
  const bool rate = options.quantity == MapQuantity::Rate;
  const char* const unit = rate ? "nm/s" : "nm";
  const double most = rate ? ranges::kRate.most : ranges::kHeight.most;
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    double& value = map.values[i];
    const double read = value;
    value *= scale;
    if (std::isnan(value) || std::abs(value) <= most) continue;
    const Index pixel = static_cast<Index>(i);
    throw InputError(fmt::format(
        "{}: value {} in row {}, column {} of the map is {} {}; a number from {:g} to {:g} {}, nan for no data or one "
        "of "
        "its usual marks (3.4e38 and the like) is required: is the unit right, or does it mark no data (give `{} no "
        "data`)?",
        where, read, pixel / map.grid.cols + 1, pixel % map.grid.cols + 1,
        std::isinf(value) ? "infinite in" : fmt::format("{:g}", value), unit, -most, most, unit, options.name));
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
  if (options.grid) {
    throw InputError(
        fmt::format("{}: `{} grid` is for points x y z, but the file holds a grid of {} x {} values; "
                    "leave it out",
                    where, options.name, source.rows, source.cols));
  }
  settle_unclear(source.header, options, false);
  apply_map_rows(source, options.rows);
  const double scale = known_scale(source.header, options, where);
  check_origin_is_clear(source, options, where);
  check_pixels(static_cast<double>(source.rows), static_cast<double>(source.cols), options.limit, where);
  const std::optional<Point> pitch = known_pitch(source.header, options, where);
  if (!pitch) {
    throw MissingPitch(fmt::format("{}: the file says no pixel pitch; give `{} pixel` [mm] > 0{}", where, options.name,
                                   source.pitch_hint));
  }
  const Point on_camera{source.camera_pixel.x * pitch->x, source.camera_pixel.y * pitch->y};
  const Point origin = known_origin(source.header, options, where).value_or(on_camera);
  append(source.header.history, remove_no_data({&source.values, source.raw_factor, source.header.no_data,
                                                static_cast<std::size_t>(source.cols)},
                                               options.no_data, where, options.name));
  const Grid grid{source.rows, source.cols, pitch->x, pitch->y, origin};
  const std::string field = source.header.pitch ? source.pitch_field : fmt::format("`{} pixel`", options.name);
  check_part_size(grid, field.empty() ? "pitch_mm" : field, where);
  HeightMap map(grid, std::move(source.values));
  map.unit_assumed = assumes_unit(source.header, options);
  map.history = std::move(source.header.history);
  scale_values(map, scale, options, where);
  return map;
}

/// The marks among the heights of points, before these become a map.
std::vector<std::string> remove_no_data_of_points(XyzText& xyz, const MapReadOptions& options,
                                                  const std::string& where) {
  std::vector<double> heights;
  for (const XyzPoint& point : xyz.points) heights.push_back(point.height);
  std::vector<std::string> history =
      remove_no_data({&heights, 1.0, xyz.header.no_data, 0}, options.no_data, where, options.name);
  for (std::size_t i = 0; i < heights.size(); ++i) xyz.points[i].height = heights[i];
  return history;
}

HeightMap fit_points_of(const XyzText& xyz, const MapReadOptions& options, const std::string& where,
                        const Progress& progress) {
  const double wanted = options.grid->pitch;
  if (options.pitch && !(same(options.pitch->x, wanted, wanted) && same(options.pitch->y, wanted, wanted))) {
    throw InputError(fmt::format(
        "{}: `{} pixel` is {} mm, but `{} grid` has a pitch of {} mm; they must agree (or `{} "
        "pixel` be left out)",
        where, options.name, pitch_option_text(*options.pitch), options.name, options.grid->pitch, options.name));
  }
  std::vector<HeightPoint> points;
  for (const XyzPoint& point : xyz.points) points.push_back({point.position, point.height});
  try {
    const Grid grid = grid_over(points, options.grid->pitch, options.origin, options.limit);
    ScatterSummary summary;
    HeightMap map = scattered_surface(std::move(points), grid, *options.grid, summary, options.threads, progress);
    map.history.push_back(fmt::format("grid pitch={},reach={:.6g}: {} about {:.4g} mm apart, {} of {} pixels have data",
                                      options.grid->pitch, summary.reach, counted(xyz.points.size(), "point"),
                                      summary.spacing, summary.pixels, map.grid.size()));
    return map;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", where, error.what()));
  }
}

/// The places of points say which way these lie; `rows` bottom only affirms it where a comment is in doubt.
void check_not_of_a_matrix(const MapHeader& header, const MapReadOptions& options, const std::string& where) {
  const bool in_doubt = std::any_of(header.unclear.begin(), header.unclear.end(), [](const UnclearStatement& unclear) {
    return unclear.about == UnclearStatement::About::Axes;
  });
  const bool rows = options.rows && !(in_doubt && *options.rows == MapRows::Bottom);
  if (!options.table && !rows) return;
  throw InputError(fmt::format("{}: `{} {}` is for a matrix, but the file holds points x y z; leave it out", where,
                               options.name, options.table ? "table" : "rows"));
}

HeightMap read_xyz(const MapName& name, std::string_view text, const MapReadOptions& options, const std::string& where,
                   const Progress& progress) {
  XyzText xyz = parse_xyz_text(text, where);
  check_not_of_a_matrix(xyz.header, options, where);
  read_file_name(xyz.header, name, options, where);
  settle_unclear(xyz.header, options, true);
  const double scale = known_scale(xyz.header, options, where);
  append(xyz.header.history, remove_no_data_of_points(xyz, options, where));
  HeightMap map = options.grid
                      ? fit_points_of(xyz, options, where, progress)
                      : grid_points(xyz.points, known_pitch(xyz.header, options, where),
                                    known_origin(xyz.header, options, where), where, options.name, options.limit);
  check_part_size(map.grid, "the points' pitch", where);
  map.unit_assumed = assumes_unit(xyz.header, options);
  append(xyz.header.history, std::move(map.history));
  map.history = std::move(xyz.header.history);
  scale_values(map, scale, options, where);
  return map;
}

HeightMap read_matrix(const MapName& name, std::string_view text, const MapReadOptions& options,
                      const std::string& where) {
  const bool headed = options.table && options.table->kind != MatrixTable::Kind::Heights;
  bool named_columns = false;
  MapSource matrix = parse_matrix_text(text, where, headed ? &named_columns : nullptr);
  apply_matrix_table(matrix, options.table, named_columns, where, options.name);
  read_file_name(matrix.header, name, options, where);
  return map_of_source(std::move(matrix), options, where);
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
                    const std::string& where, const Progress& progress) {
  if (bytes.empty()) {
    throw InputError(fmt::format("{}: the file is empty; {} is required", where, accepted_map_formats()));
  }
  const std::string extension = extension_of(name.file);
  if (const MapFormat* format = map_format_of(bytes, extension)) {
    if (options.table) {
      throw InputError(fmt::format("{}: `{} table` is for a matrix as text, but the file is {}; leave it out", where,
                                   options.name, format->name));
    }
    MapSource source = read_array(*format, bytes, name.inside, where, options.limit);
    if (is_npy(bytes)) add_npy_sidecar(name.file, bytes, source);
    read_file_name(source.header, name, options, where);
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
  if (extension == ".xyz" || names_xyz_columns(bytes)) return read_xyz(name, bytes, options, where, progress);
  return read_matrix(name, bytes, options, where);
}

}  // namespace

HeightMap read_map(const std::filesystem::path& file, const MapReadOptions& options, const Progress& progress) {
  const std::string where = fmt::format("{} {}", options.name, file.string());
  check_options(options, where);
  const MapName name = split_map_name(file);
  HeightMap map = parse_map(name, read_whole_file(name.file), options, where, progress);
  map.quantity = options.quantity;
  check_value_span(map, options.max_pv.value_or(kMostSpan), options.name, where);
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
