#include "core/formats/hdf5_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/formats/hdf5_file.h"
#include "core/formats/isolated_reader.h"
#include "core/formats/zygo_datx.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

using namespace std::string_view_literals;

/// The attribute, which if it is there must have what is asked for.
std::optional<Hdf5Value> known_attribute(const Hdf5File& file, const std::string& path, const std::string& name,
                                         bool (*good)(const Hdf5Value&), const char* required,
                                         const std::string& where) {
  if (!file.has_attribute(path, name)) return std::nullopt;
  std::optional<Hdf5Value> value = file.attribute(path, name);
  if (value && good(*value)) return value;
  throw InputError(fmt::format("{}: attribute {} of HDF5 data set '{}'{}; {} required", where, name, path,
                               value && !value->numbers.empty() ? fmt::format(" = {}", value->numbers.front()) : "",
                               required));
}

bool all(const std::vector<double>& numbers, bool (*good)(double)) {
  return std::all_of(numbers.begin(), numbers.end(), good);
}

MapHeader header_of(const Hdf5File& file, const std::string& path, const std::string& where) {
  MapHeader header;
  const auto one_or_two = [](const Hdf5Value& v) {
    return (v.numbers.size() == 1 || v.numbers.size() == 2) &&
           all(v.numbers, [](double pitch) { return std::isfinite(pitch) && pitch > 0.0; });
  };
  const auto two = [](const Hdf5Value& v) {
    return v.numbers.size() == 2 && all(v.numbers, [](double place) { return std::isfinite(place); });
  };
  const auto one_text = [](const Hdf5Value& v) { return v.texts.size() == 1; };
  const auto texts = [](const Hdf5Value& v) { return v.numbers.empty() && v.members.empty(); };
  if (const auto v =
          known_attribute(file, path, "pitch_mm", one_or_two, "one finite number > 0, or two (x, y),", where))
    header.pitch = Point{v->numbers.front(), v->numbers.back()};
  if (const auto v = known_attribute(file, path, "origin_mm", two, "two finite numbers (x, y)", where))
    header.origin = Point{v->numbers.front(), v->numbers.back()};
  if (const auto v = known_attribute(file, path, "unit", one_text, "a text", where))
    header.unit = std::string(trim(v->texts.front()));
  if (const auto v = known_attribute(file, path, "history", texts, "lines of text", where)) header.history = v->texts;
  for (std::string& step : header.history) std::replace(step.begin(), step.end(), '\n', ' ');
  return header;
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

MapSource read_hdf5(std::string_view bytes, std::string path, const std::string& where) {
  const Hdf5File file(bytes, where);
  if (path.empty()) path = datx_surface_path(file, where);
  if (path.empty()) path = only_matrix(file, where);
  if (is_datx_surface(file, path)) return read_datx_surface(file, path, where);
  MapSource source;
  source.header = header_of(file, path, where);
  source.pitch_hint = ", or the data set an attribute pitch_mm";
  Hdf5Matrix matrix = file.matrix(path);
  source.rows = static_cast<Index>(matrix.rows);
  source.cols = static_cast<Index>(matrix.cols);
  source.values = std::move(matrix.values);
  return source;
}

}  // namespace

bool is_hdf5(std::string_view bytes) { return bytes.starts_with("\x89HDF\r\n\x1a\n"sv); }

MapSource parse_hdf5(std::string_view bytes, const std::string& where) { return parse_hdf5_at(bytes, "", where); }

MapSource parse_hdf5_at(std::string_view bytes, const std::string& path, const std::string& where) {
  if (!is_hdf5(bytes)) throw InputError(fmt::format("{}: not an HDF5 file; it must begin with \\x89HDF", where));
  return read_isolated([&] { return read_hdf5(bytes, path, where); }, bytes.size(), "the HDF5 file", where);
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
