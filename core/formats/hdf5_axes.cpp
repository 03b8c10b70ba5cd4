#include "core/formats/hdf5_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/formats/field_name.h"
#include "core/formats/hdf5_fields.h"
#include "core/formats/hdf5_packing.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr double kIrregular = 0.05;  // of a pitch, as for points of a grid
constexpr double kSamePitch = 1e-6;  // relative: coordinates may be in single precision

[[noreturn]] void refuse(const std::string& where, const std::string& scale, const std::string& what) {
  throw InputError(fmt::format("{}: HDF5 data set '{}', the coordinates of {}", where, scale, what));
}

/// netCDF-4 puts a data set without meaning where a dimension has no coordinates.
bool is_without_values(const Hdf5File& file, const std::string& scale) {
  const auto name = file.attribute(scale, "NAME");
  return name && name->texts.size() == 1 &&
         name->texts.front().starts_with("This is a netCDF dimension but not a netCDF variable");
}

/// The letter of the axis that a data set is named after: x, X_mm and "x (mm)" are 'x'; 0 if none.
char letter_of(const std::string& path) {
  const std::string name = lower_case(last_name(path));
  const bool alone = name.size() == 1 || std::isalnum(static_cast<unsigned char>(name[1])) == 0;
  return alone && (name.front() == 'x' || name.front() == 'y') ? name.front() : '\0';
}

/// An unattached data set beside the map, named as the axis and as long.
std::string neighbour(const Hdf5File& file, const std::string& path, char letter, std::size_t count) {
  for (const std::string& other : file.data_sets_in(group_of(path))) {
    if (letter_of(other) != letter || other == path) continue;
    const auto values = file.table(other);
    if (values && values->texts.empty() && values->numbers.size() == count && count > 1) return other;
  }
  return "";
}

/// Whether the name is that of coordinates alone: x, "X_mm", xx, but not x_slope.
bool names_coordinates(const std::string& path, char letter) {
  constexpr std::array<const char*, 5> kEndings{"", "grid", "mesh", "coord", "coords"};
  std::string name;
  for (const char c : lower_case(last_name(path))) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
  }
  const std::string axis(1, letter);
  const bool known = name == axis + axis ||
                     std::any_of(kEndings.begin(), kEndings.end(), [&](const char* end) { return name == axis + end; });
  return known || (letter_of(path) == letter && parse_field_name(last_name(path)).place);
}

/// A data set beside the map with the name of the coordinates but another length; empty if there is none.
std::string misfit(const Hdf5File& file, const std::string& path, char letter) {
  for (const std::string& other : file.data_sets_in(group_of(path))) {
    if (other == path || !names_coordinates(other, letter)) continue;
    const auto values = file.table(other);
    if (values && values->texts.empty() && values->numbers.size() > 1) return other;
  }
  return "";
}

struct AxisName {
  const char* lines;  // "its rows"
  char letter;
  unsigned index;
};

constexpr AxisName kRows{"its rows", 'y', 0}, kCols{"its columns", 'x', 1};

std::string scale_path(const Hdf5File& file, const std::string& path, const AxisName& axis, std::size_t count,
                       const std::string& where) {
  for (const std::string& scale : file.scales_of(path, axis.index)) {
    if (is_without_values(file, scale)) continue;
    const char letter = letter_of(scale);
    if (letter != '\0' && letter != axis.letter) {
      refuse(where, scale,
             fmt::format("{}; rows along y, the first index, are required: exchange the two dimensions", axis.lines));
    }
    return scale;
  }
  return neighbour(file, path, axis.letter, count);
}

std::vector<double> coordinates(const Hdf5File& file, const std::string& scale, const AxisName& axis, std::size_t count,
                                const std::string& where) {
  const auto table = file.table(scale);
  if (!table || !table->texts.empty() || table->numbers.size() != count) {
    refuse(where, scale,
           fmt::format("{}, holds {} that can be read; {} are required", axis.lines,
                       counted(table ? table->numbers.size() : 0, "number"), count));
  }
  std::vector<double> values = table->numbers;
  unpack_values(packing_of_data_set(
                    file, scale, {.floating = true, .with_sign = true, .bytes = sizeof(double), .fill = {}}, {}, where),
                values);
  return values;
}

/// Throws unless the coordinates are first + i * pitch.
void check_regular(const std::vector<double>& values, double pitch, const std::string& scale, const AxisName& axis,
                   const std::string& where) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = values.front() + pitch * static_cast<double>(i);
    if (std::isfinite(pitch) && pitch != 0.0 && std::abs(values[i] - expected) <= kIrregular * std::abs(pitch))
      continue;
    refuse(where, scale,
           fmt::format("{}: number {} is {}, but a regular grid from {} to {} has {} there; equal steps are "
                       "required",
                       axis.lines, i + 1, values[i], values.front(), values.back(), expected));
  }
}

/// The data set of x or y at each pixel of the map, as meshgrid makes them; empty if there is none.
std::string mesh_beside(const Hdf5File& file, const std::string& path, char letter) {
  for (const std::string& other : file.matrices()) {
    if (other != path && group_of(other) == group_of(path) && names_coordinates(other, letter)) return other;
  }
  return "";
}

/// The coordinates of a mesh along its axis. Throws unless they are the same in every other row (or column).
std::vector<double> coordinates_of_mesh(const Hdf5File& file, const std::string& mesh, const AxisName& axis,
                                        const Hdf5Matrix& map, const std::string& where) {
  const Hdf5Matrix all = file.matrix(mesh);
  if (all.rows != map.rows || all.cols != map.cols) {
    refuse(where, mesh,
           fmt::format("{}, holds {} x {} numbers; {} x {} are required", axis.lines, all.rows, all.cols, map.rows,
                       map.cols));
  }
  const bool along_rows = axis.index == 0;
  std::vector<double> values;
  for (std::size_t i = 0; i < (along_rows ? all.rows : all.cols); ++i) {
    values.push_back(all.values[along_rows ? i * all.cols : i]);
  }
  const double span = std::abs(values.back() - values.front());
  const double tolerance = values.size() > 1 ? kIrregular * span / static_cast<double>(values.size() - 1) : 0.0;
  for (std::size_t i = 0; i < all.values.size(); ++i) {
    const double expected = values[along_rows ? i / all.cols : i % all.cols];
    if (std::abs(all.values[i] - expected) <= tolerance) continue;
    refuse(where, mesh,
           fmt::format("{}: {} in row {}, column {}, but {} at the edge; y along the first index alone and x along the "
                       "second are required",
                       axis.lines, all.values[i], i / all.cols + 1, i % all.cols + 1, expected));
  }
  return values;
}

std::optional<double> mm_of(const Hdf5File& file, const std::string& scale, const std::string& where) {
  const std::vector<MapField> fields = fields_of_data_set(file, scale);
  std::string unit = read_map_fields(fields, where).header.unit.value_or("");
  if (unit.empty()) unit = unit_of_array_name(last_name(scale));
  const auto nm = known_length_unit(unit);
  return nm ? std::optional(*nm / units::kNmPerMm) : std::nullopt;
}

Hdf5Axis axis_of(const Hdf5File& file, const std::string& path, const AxisName& name, const Hdf5Matrix& matrix,
                 const std::string& where) {
  Hdf5Axis axis;
  const std::size_t count = name.index == 0 ? matrix.rows : matrix.cols;
  axis.path = scale_path(file, path, name, count, where);
  const bool mesh = axis.path.empty();
  if (mesh) axis.path = mesh_beside(file, path, name.letter);
  if (axis.path.empty()) {
    axis.misfit = misfit(file, path, name.letter);
    return axis;
  }
  const std::vector<double> values = mesh ? coordinates_of_mesh(file, axis.path, name, matrix, where)
                                          : coordinates(file, axis.path, name, count, where);
  const double pitch = count < 2 ? 0.0 : (values.back() - values.front()) / static_cast<double>(count - 1);
  if (count > 1) check_regular(values, pitch, axis.path, name, where);
  axis.descending = pitch < 0.0;
  const auto mm = mm_of(file, axis.path, where);
  axis.in_mm = mm.has_value();
  if (mm && count > 1) axis.pitch = std::abs(pitch) * *mm;
  axis.smallest = std::min(values.front(), values.back()) * mm.value_or(1.0);
  const bool from_first = values.front() == 0.0 || values.front() == 1.0;
  axis.counts = !mm && from_first && (count == 1 || pitch == 1.0);
  return axis;
}

void flip_rows(Hdf5Matrix& matrix) {
  const auto cols = static_cast<std::ptrdiff_t>(matrix.cols);
  for (auto top = matrix.values.begin(), end = matrix.values.end(); end - top > cols; top += cols, end -= cols) {
    std::swap_ranges(top, top + cols, end - cols);
  }
}

void flip_cols(Hdf5Matrix& matrix) {
  const auto cols = static_cast<std::ptrdiff_t>(matrix.cols);
  for (auto row = matrix.values.begin(); row != matrix.values.end(); row += cols) std::reverse(row, row + cols);
}

void add_pitch(const Hdf5Axes& axes, SaidOfMap& said, const std::string& where) {
  const std::string shown = fmt::format("coordinates '{}' and '{}'", axes.cols.path, axes.rows.path);
  const Point pitch{*axes.cols.pitch, *axes.rows.pitch};
  const auto same = [](double a, double b) { return std::abs(a - b) <= kSamePitch * std::abs(b); };
  if (said.header.pitch && !(same(said.header.pitch->x, pitch.x) && same(said.header.pitch->y, pitch.y))) {
    throw InputError(fmt::format("{}: {}, but the {} have steps of {} and {} mm; they must agree", where,
                                 said.pitch_field, shown, pitch.x, pitch.y));
  }
  if (said.header.pitch) return;
  said.header.pitch = pitch;
  said.header.pitch_rounding = kSinglePitchRounding;
  said.pitch_field = fmt::format("{}: steps of {} and {} mm", shown, pitch.x, pitch.y);
}

void add_origin(const Hdf5Axes& axes, SaidOfMap& said, const std::string& where) {
  const Point origin{axes.cols.smallest, axes.rows.smallest};
  const Point pitch = said.header.pitch.value_or(Point{1.0, 1.0});
  const auto same = [](double a, double b, double step) { return std::abs(a - b) <= kIrregular * step; };
  if (said.header.origin &&
      !(same(said.header.origin->x, origin.x, pitch.x) && same(said.header.origin->y, origin.y, pitch.y))) {
    throw InputError(fmt::format(
        "{}: its origin is said as {},{} mm, but the coordinates '{}' and '{}' begin at {} and {} mm; "
        "they must agree",
        where, said.header.origin->x, said.header.origin->y, axes.cols.path, axes.rows.path, origin.x, origin.y));
  }
  if (!said.header.origin) said.header.origin = origin;
}

/// Coordinates in no known unit, or of one axis alone, say that there is a pitch and an origin, but not which.
void add_unclear(const Hdf5Axis& axis, SaidOfMap& said) {
  if (!axis.misfit.empty() && !said.header.origin) {
    said.unclear_origin += fmt::format("{}coordinates '{}', which are not as many as the map's",
                                       said.unclear_origin.empty() ? "" : ", ", axis.misfit);
  }
  if (axis.path.empty() || axis.counts) return;
  const std::string shown =
      fmt::format("coordinates '{}'{}", axis.path, axis.in_mm ? "" : " without a unit of length (mm, um, m)");
  const auto add = [&](std::string& list) { list += (list.empty() ? "" : ", ") + shown; };
  if (!said.header.pitch) add(said.unclear_pitch);
  if (!said.header.origin && axis.smallest != 0.0) add(said.unclear_origin);
}

}  // namespace

Hdf5Axes axes_of_data_set(const Hdf5File& file, const std::string& path, const Hdf5Matrix& matrix,
                          const std::string& where) {
  return {axis_of(file, path, kRows, matrix, where), axis_of(file, path, kCols, matrix, where)};
}

void apply_axes(const Hdf5Axes& axes, Hdf5Matrix& matrix, SaidOfMap& said, const std::string& where) {
  if (axes.rows.descending) flip_rows(matrix);
  if (axes.cols.descending) flip_cols(matrix);
  if (axes.rows.pitch && axes.cols.pitch) add_pitch(axes, said, where);
  if (axes.rows.in_mm && axes.cols.in_mm) return add_origin(axes, said, where);
  add_unclear(axes.rows, said);
  add_unclear(axes.cols, said);
}

}  // namespace dwell
