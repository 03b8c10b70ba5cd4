#include "core/aperture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/errors.h"
#include "core/number_text.h"

namespace dwell {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw InputError(
      fmt::format("aperture '{}': {}; accepted: map, rect:x0,y0,x1,y1 with x0 < x1 and y0 < y1, or "
                  "circle:x,y,r with r > 0 [mm]",
                  text, reason));
}

std::vector<double> numbers(const std::string& text, std::string_view list, std::size_t count) {
  const std::vector<std::string_view> fields = split(list, ',');
  if (fields.size() != count) refuse(text, fmt::format("{} numbers given, {} required", fields.size(), count));
  std::vector<double> values;
  for (const std::string_view field : fields) {
    const std::optional<double> value = finite_number(field);
    if (!value) refuse(text, fmt::format("'{}' is not a finite number", field));
    values.push_back(*value);
  }
  return values;
}

bool contains(const Aperture& aperture, Point p, double slack) {
  switch (aperture.kind) {
    case Aperture::Kind::Map:
      return true;
    case Aperture::Kind::Rectangle:
      return p.x >= aperture.x0 - slack && p.x <= aperture.x1 + slack && p.y >= aperture.y0 - slack &&
             p.y <= aperture.y1 + slack;
    case Aperture::Kind::Circle:
      return distance(p, {aperture.x, aperture.y}) <= aperture.radius + slack;
  }
  return false;
}

}  // namespace

Aperture parse_aperture(const std::string& text) {
  Aperture aperture;
  const std::string_view view = trim(text);
  if (view == "map") return aperture;
  if (view.starts_with("rect:")) {
    const std::vector<double> v = numbers(text, view.substr(5), 4);
    aperture.kind = Aperture::Kind::Rectangle;
    aperture.x0 = v[0], aperture.y0 = v[1], aperture.x1 = v[2], aperture.y1 = v[3];
    if (!(aperture.x0 < aperture.x1 && aperture.y0 < aperture.y1)) refuse(text, "the rectangle is empty");
    return aperture;
  }
  if (view.starts_with("circle:")) {
    const std::vector<double> v = numbers(text, view.substr(7), 3);
    aperture.kind = Aperture::Kind::Circle;
    aperture.x = v[0], aperture.y = v[1], aperture.radius = v[2];
    if (!(aperture.radius > 0.0)) refuse(text, "the radius is not positive");
    return aperture;
  }
  refuse(text, "unknown form");
}

std::string to_string(const Aperture& aperture) {
  switch (aperture.kind) {
    case Aperture::Kind::Map:
      return "map";
    case Aperture::Kind::Rectangle:
      return fmt::format("rect:{},{},{},{}", aperture.x0, aperture.y0, aperture.x1, aperture.y1);
    case Aperture::Kind::Circle:
      return fmt::format("circle:{},{},{}", aperture.x, aperture.y, aperture.radius);
  }
  return "";
}

HeightMap within(HeightMap map, const Aperture& aperture) {
  const Grid grid = map.grid;
  const Index with_data = map.valid_pixels();
  // The boundary is closed: a pixel centre that rounding (0.1 * 3 > 0.3) puts a hair outside belongs to it.
  const double slack = 1e-9 * std::min(grid.pitch_x, grid.pitch_y);
  for (Index i = 0; aperture.kind != Aperture::Kind::Map && i < grid.size(); ++i) {
    if (!contains(aperture, grid.centre(i), slack)) {
      map.values[static_cast<std::size_t>(i)] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  if (map.valid_pixels() == 0) {
    throw InputError(fmt::format(
        "aperture '{}' leaves no pixel with data; the map ({} pixels with data) has pixel "
        "centres at x = {} to {} mm, y = {} to {} mm",
        to_string(aperture), with_data, grid.x(0), grid.x(grid.cols - 1), grid.y(0), grid.y(grid.rows - 1)));
  }
  return map;
}

}  // namespace dwell
