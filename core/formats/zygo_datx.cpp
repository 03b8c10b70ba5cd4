#include "core/formats/zygo_datx.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr const char* kSurfaces = "/Data/Surface";
constexpr double kNever = 2147483640.0;  // no data in files that do not say, as in a .dat: nothing is as high

/// Where a link leads from, in the table of (Source, Link, Destination); empty if nowhere.
std::string linked(const Hdf5Value& table, const std::string& from, const std::string& link) {
  const Hdf5Value *source = table.member("Source"), *name = table.member("Link"), *to = table.member("Destination");
  if (!source || !name || !to) return "";
  const std::size_t count = std::min({source->texts.size(), name->texts.size(), to->texts.size()});
  for (std::size_t i = 0; i < count; ++i) {
    if (source->texts[i] == from && name->texts[i] == link) return to->texts[i];
  }
  return "";
}

/// The surface as a reader of attributes sees it.
struct Surface {
  const Hdf5File& file;
  const std::string& path;
  const std::string& where;

  [[noreturn]] void refuse(const std::string& attribute, const std::string& value, const std::string& required) const {
    throw InputError(fmt::format("{}: attribute '{}' of the surface {}{}{}; {}", where, attribute, path,
                                 value.empty() ? "" : " = ", value, required));
  }
  std::optional<Hdf5Value> attribute(const std::string& name) const { return file.attribute(path, name); }

  std::optional<double> number(const std::string& name) const {
    const auto value = attribute(name);
    if (!value) return std::nullopt;
    if (value->numbers.size() != 1) refuse(name, "", "one number is required");
    return value->numbers.front();
  }
  /// A member of a converter (Category, BaseUnit, Parameters).
  std::optional<Hdf5Value> converter(const std::string& name, const char* member) const {
    const auto value = attribute(name);
    const Hdf5Value* found = value ? value->member(member) : nullptr;
    if (!found) return std::nullopt;
    return *found;
  }
  std::string base_unit(const std::string& name) const {
    const auto unit = converter(name, "BaseUnit");
    return unit && unit->texts.size() == 1 ? unit->texts.front() : "";
  }
};

/// A factor that the surface states by itself, or else the `at`-th parameter of its Z Converter.
double fringe_factor(const Surface& surface, const std::string& name, std::size_t at) {
  std::optional<double> value = surface.number(name);
  const auto parameters = surface.converter("Z Converter", "Parameters");
  if (!value && parameters && at < parameters->numbers.size()) value = parameters->numbers[at];
  if (!value) surface.refuse(name, "", "needed for heights in fringes, but neither it nor 'Z Converter' is there");
  if (!(std::isfinite(*value) && *value > 0.0)) {
    surface.refuse(name, fmt::format("{}", *value), "a finite number > 0 is required");
  }
  return *value;
}

/// Factor from a stored number to nm; what the surface says of waves goes into the header.
double height_factor(const Surface& surface, MapHeader& header) {
  const auto stated = surface.attribute("Unit");
  const std::string converter = surface.base_unit("Z Converter");
  const std::string unit = stated && stated->texts.size() == 1 ? stated->texts.front() : converter;
  if (!converter.empty() && lower_case(unit) != lower_case(converter)) {
    surface.refuse("Unit", unit, fmt::format("but 'Z Converter' says {}; they must agree", converter));
  }
  const std::string known = lower_case(unit);
  if (known == "fringes") {
    header.wavelength = fringe_factor(surface, "Wavelength", 1) * units::kNmPerM;
    header.wave_scale =
        fringe_factor(surface, "Interferometric Scale Factor", 2) * fringe_factor(surface, "Obliquity Factor", 3);
    header.from_waves = true;
    header.wave_field =
        fmt::format("the surface {} (Wavelength, Interferometric Scale Factor, Obliquity Factor)", surface.path);
    return *header.wavelength * *header.wave_scale;
  }
  if (const auto nm = known_length_unit(unit)) {
    header.wave_scale = surface.number("Interferometric Scale Factor");  // by which the heights were made
    header.wave_field = fmt::format("attribute 'Interferometric Scale Factor' of the surface {}", surface.path);
    return *nm;
  }
  surface.refuse("Unit", unit, "Fringes, NanoMeters, MicroMeters, MilliMeters, Meters or Angstroms is required");
}

/// Pitch along one axis [mm]; nothing if the file does not know.
std::optional<double> pitch(const Surface& surface, const std::string& name) {
  const auto parameters = surface.converter(name, "Parameters");
  if (!parameters || parameters->numbers.size() < 2) return std::nullopt;
  const std::string unit = surface.base_unit(name);
  if (unit != "Pixels") surface.refuse(name, unit, "a base unit of Pixels is required");
  const double metres = parameters->numbers[1];
  if (!(std::isfinite(metres) && metres >= 0.0)) {
    surface.refuse(name, fmt::format("{}", metres), "a finite pitch >= 0 m is required");
  }
  if (metres == 0.0) return std::nullopt;
  return metres * units::kMmPerM;
}

/// Where the last row, first column lies on the camera, y up [pixels]; (0, 0) of a camera that the file does not tell.
Point camera_pixel(const Surface& surface, std::size_t rows) {
  const auto coordinates = surface.attribute("Coordinates");
  const Hdf5Value* row = coordinates ? coordinates->member("RowStart") : nullptr;
  const Hdf5Value* col = coordinates ? coordinates->member("ColumnStart") : nullptr;
  if (!row || !col || row->numbers.size() != 1 || col->numbers.size() != 1) return {};
  const double bottom = row->numbers.front() + static_cast<double>(rows - 1);
  if (!std::isfinite(bottom) || !std::isfinite(col->numbers.front())) return {};
  return {col->numbers.front(), 0.0 - bottom};
}

}  // namespace

std::string datx_surface_path(const Hdf5File& file, const std::string& where) {
  const std::vector<std::string> surfaces = file.data_sets_in(kSurfaces);
  if (surfaces.empty()) return "";
  if (const auto table = file.table("/MetaData")) {
    const std::string surface = linked(*table, linked(*table, "Root", "Measurement"), "Surface");
    std::string path = linked(*table, surface, "Path");
    if (std::find(surfaces.begin(), surfaces.end(), path) != surfaces.end()) return path;
  }
  if (surfaces.size() == 1) return surfaces.front();
  throw InputError(
      fmt::format("{}: the .datx file holds {} surfaces, and its MetaData points to none; add the path of "
                  "one to the file's name, as ':{}'",
                  where, surfaces.size(), surfaces.front()));
}

bool is_datx_surface(const Hdf5File& file, const std::string& path) {
  return file.has_attribute(path, "Z Converter") || path.starts_with(std::string(kSurfaces) + "/");
}

MapSource read_datx_surface(const Hdf5File& file, const std::string& path, const std::string& where,
                            const PixelLimit& limit) {
  const Surface surface{file, path, where};
  MapSource source;
  const double factor = height_factor(surface, source.header);
  const std::optional<double> no_data = surface.number("No Data");
  const std::optional<double> x = pitch(surface, "X Converter"), y = pitch(surface, "Y Converter");
  if (x && y) source.header.pitch = Point{*x, *y};
  source.pitch_field = "parameter 1 of 'X Converter' and 'Y Converter' [m]";
  source.pitch_hint = "; its 'X Converter' and 'Y Converter' say 0, unknown, or are not there";
  source.header.unit = "nm";
  source.header.pitch_rounding = kSinglePitchRounding;
  Hdf5Matrix matrix = file.matrix(path, limit);
  const auto cols = static_cast<std::ptrdiff_t>(matrix.cols);
  for (auto top = matrix.values.begin(), end = matrix.values.end(); end - top > cols; top += cols, end -= cols) {
    std::swap_ranges(top, top + cols, end - cols);
  }
  for (double& v : matrix.values) {
    const bool seen = !(no_data && v == *no_data) && std::abs(v) < kNever;
    v = seen ? factor * v : std::numeric_limits<double>::quiet_NaN();
  }
  source.rows = static_cast<Index>(matrix.rows);
  source.cols = static_cast<Index>(matrix.cols);
  source.camera_pixel = camera_pixel(surface, matrix.rows);
  source.values = std::move(matrix.values);
  return source;
}

}  // namespace dwell
