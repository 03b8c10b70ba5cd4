#include "core/formats/map_header.h"

#include <fmt/format.h>

#include <vector>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

/// "a,b", or with `one_for_both` just "a".
std::optional<Point> number_pair(std::string_view text, bool one_for_both) {
  const std::vector<std::string_view> fields = split(text, ',');
  if (fields.size() > 2 || (fields.size() == 1 && !one_for_both)) return std::nullopt;
  const std::optional<double> x = finite_number(fields.front()), y = finite_number(fields.back());
  if (!x || !y) return std::nullopt;
  return Point{*x, *y};
}

}  // namespace

void read_header_line(std::string_view line, const std::string& place, MapHeader& header) {
  line.remove_prefix(1);
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string_view key = trim(line.substr(0, colon)), value = trim(line.substr(colon + 1));
  const auto refuse = [&](const char* required) {
    throw InputError(fmt::format("{}: {} = '{}'; {} required", place, key, value, required));
  };
  const auto only_once = [&](bool given) {
    if (given) throw InputError(fmt::format("{}: {} is given a second time; once is accepted", place, key));
  };
  if (key == "pitch_mm") {
    only_once(header.pitch.has_value());
    header.pitch = number_pair(value, true);
    if (!header.pitch || !(header.pitch->x > 0.0 && header.pitch->y > 0.0)) {
      refuse("one finite number > 0, or two (x,y) separated by a comma,");
    }
  } else if (key == "origin_mm") {
    only_once(header.origin.has_value());
    header.origin = number_pair(value, false);
    if (!header.origin) refuse("two finite numbers x,y");
  } else if (key == "unit") {
    only_once(header.unit.has_value());
    header.unit = std::string(value);
  } else if (key == "made" && !value.empty()) {
    header.history.emplace_back(value);
  }
}

std::string header_lines(const HeightMap& map) {
  const Grid& grid = map.grid;
  const std::string pitch =
      grid.pitch_x == grid.pitch_y ? fmt::format("{}", grid.pitch_x) : fmt::format("{},{}", grid.pitch_x, grid.pitch_y);
  std::string lines = fmt::format("# pitch_mm: {}\n# origin_mm: {},{}\n# unit: {}\n", pitch, grid.origin.x,
                                  grid.origin.y, unit_of(map.quantity));
  for (const std::string& step : map.history) lines += fmt::format("# made: {}\n", step);
  return lines;
}

}  // namespace dwell
