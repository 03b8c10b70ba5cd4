#include "core/formats/hdf5_waves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/formats/hdf5_fields.h"

namespace dwell {
namespace {

/// A length as an attribute of a group, "632.8 nm" [mm]; nothing if there is no such attribute.
std::optional<double> length_in(const Hdf5File& file, const std::string& group, const std::string& name,
                                const std::string& where) {
  if (!file.has_attribute(group, name)) return std::nullopt;
  const Hdf5Value value = file.attribute(group, name).value_or(Hdf5Value{});
  const std::string text = value.texts.size() == 1 ? value.texts.front() : "";
  const auto length = length_of_text(text);
  if (length && std::isfinite(*length) && *length > 0.0) return length;
  const std::string shown = value.numbers.size() == 1 ? fmt::format("{}", value.numbers.front()) : in_quotes(text);
  throw InputError(
      fmt::format("{}: attribute {} of HDF5 group '{}' = {}; a length > 0 with its unit, as '0.12 mm', "
                  "required",
                  where, name, group, shown));
}

}  // namespace

bool is_measurement_in_waves(const Hdf5File& file, const std::string& path) {
  const std::string group = group_of(path);
  return lower_case(last_name(path)) == "data" && lower_case(last_name(group)) == "genraw" &&
         file.has_attribute(group, "wavelength");
}

MapSource read_measurement_in_waves(const Hdf5File& file, const std::string& path, const std::string& where,
                                    const PixelLimit& limit) {
  constexpr double kNever = 1e38;  // stands for no data there
  const std::string group = group_of(path);
  const double nm = length_in(file, group, "wavelength", where).value_or(0.0) * units::kNmPerMm;
  const auto x = length_in(file, group, "xpix", where), y = length_in(file, group, "ypix", where);
  MapSource source;
  if (x || y) {
    source.header.pitch = Point{x ? *x : *y, y ? *y : *x};
    source.header.pitch_rounding = kSinglePitchRounding;
    source.pitch_field = fmt::format("attribute {} of HDF5 group '{}'", x ? "xpix" : "ypix", group);
  }
  source.pitch_hint = fmt::format("; HDF5 group '{}' has no attribute xpix", group);
  source.header.unit = "nm";
  source.header.wavelength = nm;
  source.header.from_waves = true;
  source.header.wave_field = fmt::format("attribute wavelength of HDF5 group '{}'", group);
  source.header.history = {
      fmt::format("heights in waves of {:.9g} nm, the first row on top, as 4D writes {}", nm, path)};
  Hdf5Matrix matrix = file.matrix(path, limit);
  const auto cols = static_cast<std::ptrdiff_t>(matrix.cols);
  for (auto top = matrix.values.begin(), end = matrix.values.end(); end - top > cols; top += cols, end -= cols) {
    std::swap_ranges(top, top + cols, end - cols);
  }
  for (double& value : matrix.values) {
    value = std::abs(value) < kNever ? value * nm : std::numeric_limits<double>::quiet_NaN();
  }
  source.rows = static_cast<Index>(matrix.rows);
  source.cols = static_cast<Index>(matrix.cols);
  source.values = std::move(matrix.values);
  return source;
}

}  // namespace dwell
