#include "core/formats/hdf5_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/errors.h"
#include "core/formats/hdf5_axes.h"
#include "core/formats/hdf5_fields.h"
#include "core/formats/hdf5_file.h"
#include "core/formats/hdf5_packing.h"
#include "core/formats/hdf5_waves.h"
#include "core/formats/isolated_reader.h"
#include "core/formats/wavefront_words.h"
#include "core/formats/zygo_datx.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

using namespace std::string_view_literals;

/// How the map was made: the lines of the attribute `history`.
std::vector<std::string> history_of(const Hdf5File& file, const std::string& path, const std::string& where) {
  if (!file.has_attribute(path, "history")) return {};
  const auto value = file.attribute(path, "history");
  if (!value || !value->numbers.empty() || !value->members.empty()) {
    throw InputError(
        fmt::format("{}: attribute history of HDF5 data set '{}'; lines of text are required", where, path));
  }
  std::vector<std::string> history = value->texts;
  for (std::string& step : history) std::replace(step.begin(), step.end(), '\n', ' ');
  return history;
}

std::string only_matrix(const Hdf5File& file, const std::string& where) {
  const std::vector<std::string> paths = file.matrices();
  if (paths.size() == 1) return paths.front();
  if (paths.empty()) {
    throw InputError(
        fmt::format("{}: the HDF5 file holds no two-dimensional data set of numbers, which is required", where));
  }
  constexpr std::size_t kListed = 10;
  std::string names;
  for (std::size_t i = 0; i < std::min(paths.size(), kListed); ++i)
    names += fmt::format("{}:{}", i == 0 ? "" : ", ", paths[i]);
  throw InputError(
      fmt::format("{}: the HDF5 file holds {} two-dimensional data sets; add the path of one to the file's "
                  "name: {}{}",
                  where, paths.size(), names, paths.size() > kListed ? ", ..." : ""));
}

/// What ends the message when no pitch is said.
std::string pitch_hint(const SaidOfMap& said) {
  std::string hint = ", or the data set an attribute pitch_mm";
  if (said.unclear_pitch.empty()) return hint;
  return fmt::format(
      "{} (what looks like one leaves open of what it is, in which unit, or whether x or y comes first: "
      "{})",
      hint, said.unclear_pitch);
}

MapSource read_plain_matrix(const Hdf5File& file, const std::string& path, const std::string& where,
                            const PixelLimit& limit) {
  SaidOfMap said = said_of_data_set(file, path, where);
  said.header.history = history_of(file, path, where);
  note_wavefront(path, where, fmt::format("the name of HDF5 data set '{}'", path), said.header);
  const std::vector<std::string> all = file.matrices();
  const auto is_wavefront = [](const std::string& name) { return names_wavefront(name); };
  said.header.other_is_wavefront = !is_wavefront(path) && std::any_of(all.begin(), all.end(), is_wavefront);
  Hdf5Matrix matrix = file.matrix(path, limit);
  // Markers are stored values here, so they go before scale and offset.
  const std::vector<double> markers = std::exchange(said.header.no_data, {});
  const std::string unpacked =
      unpack_values(packing_of_data_set(file, path, matrix.numbers, markers, where), matrix.values);
  if (!unpacked.empty()) said.header.history.push_back(fmt::format("read {}: {}", path, unpacked));
  apply_axes(axes_of_data_set(file, path, matrix, where), matrix, said, where);
  MapSource source;
  source.pitch_hint = pitch_hint(said);
  source.pitch_field = std::move(said.pitch_field);
  source.unclear_origin = std::move(said.unclear_origin);
  source.header = std::move(said.header);
  source.rows = static_cast<Index>(matrix.rows);
  source.cols = static_cast<Index>(matrix.cols);
  source.values = std::move(matrix.values);
  return source;
}

MapSource read_hdf5(std::string_view bytes, std::string path, const std::string& where, const PixelLimit& limit) {
  const Hdf5File file(bytes, where);
  if (path.empty()) path = datx_surface_path(file, where);
  if (path.empty()) path = only_matrix(file, where);
  if (!path.starts_with('/')) path.insert(0, "/");
  if (is_datx_surface(file, path)) return read_datx_surface(file, path, where, limit);
  if (is_measurement_in_waves(file, path)) return read_measurement_in_waves(file, path, where, limit);
  return read_plain_matrix(file, path, where, limit);
}

}  // namespace

bool is_hdf5(std::string_view bytes) { return bytes.starts_with("\x89HDF\r\n\x1a\n"sv); }

MapSource parse_hdf5(std::string_view bytes, const std::string& where, const PixelLimit& limit) {
  return parse_hdf5_at(bytes, "", where, limit);
}

MapSource parse_hdf5_at(std::string_view bytes, const std::string& path, const std::string& where,
                        const PixelLimit& limit) {
  if (!is_hdf5(bytes)) throw InputError(fmt::format("{}: not an HDF5 file; it must begin with \\x89HDF", where));
  return read_isolated([&] { return read_hdf5(bytes, path, where, limit); }, bytes.size(), "the HDF5 file", where,
                       limit);
}

std::string hdf5_map_bytes(const HeightMap& map) {
  Hdf5Content content;
  content.path = "map";
  content.rows = static_cast<std::size_t>(map.grid.rows);
  content.cols = static_cast<std::size_t>(map.grid.cols);
  content.values = map.values;
  content.numbers = {{"pitch_mm", {map.grid.pitch_x, map.grid.pitch_y}},
                     {"origin_mm", {map.grid.origin.x, map.grid.origin.y}}};
  content.texts = {{"unit", unit_of(map.quantity)}};
  content.lists = {{"history", map.history}};
  return hdf5_bytes(content);
}

}  // namespace dwell
