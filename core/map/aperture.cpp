#include "core/map/aperture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/value_range.h"

namespace dwell {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw InputError(
      fmt::format("aperture '{}': {}; accepted: map, rect:x0,y0,x1,y1 with x0 < x1 and y0 < y1, circle:x,y,r with "
                  "r > 0, ellipse:x,y,a,b[,degrees] with a, b > 0, annulus:x,y,r_inner,r_outer with 0 <= r_inner < "
                  "r_outer, or polygon:x1,y1,x2,y2,x3,y3,...[/x1,y1,...] (more rings: holes) [mm]",
                  text, reason));
}

std::vector<double> numbers(const std::string& text, std::string_view list) {
  std::vector<double> values;
  for (const std::string_view field : split(list, ',')) {
    const std::optional<double> value = finite_number(field);
    if (!value) refuse(text, fmt::format("'{}' is not a finite number", field));
    if (!ranges::kPlace.holds(*value)) refuse(text, fmt::format("'{}' is not {}", field, ranges::kPlace.text()));
    values.push_back(*value);
  }
  return values;
}

void require_count(const std::string& text, const std::vector<double>& v, std::size_t least, std::size_t most) {
  if (v.size() >= least && v.size() <= most) return;
  const std::string required = least == most ? fmt::format("{}", least) : fmt::format("{} or {}", least, most);
  refuse(text, fmt::format("{} given, {} required", counted(v.size(), "number"), required));
}

Aperture rectangle(const std::string& text, const std::vector<double>& v) {
  require_count(text, v, 4, 4);
  Aperture area{.kind = Aperture::Kind::Rectangle, .x0 = v[0], .y0 = v[1], .x1 = v[2], .y1 = v[3], .rings = {}};
  if (!(area.x0 < area.x1 && area.y0 < area.y1)) refuse(text, "the rectangle is empty");
  return area;
}

Aperture circle(const std::string& text, const std::vector<double>& v) {
  require_count(text, v, 3, 3);
  Aperture area{.kind = Aperture::Kind::Circle, .x = v[0], .y = v[1], .radius = v[2], .rings = {}};
  if (!(area.radius > 0.0)) refuse(text, "the radius is not positive");
  return area;
}

Aperture ellipse(const std::string& text, const std::vector<double>& v) {
  require_count(text, v, 4, 5);
  Aperture area{.kind = Aperture::Kind::Ellipse, .x = v[0], .y = v[1], .a = v[2], .b = v[3], .rings = {}};
  if (!(area.a > 0.0 && area.b > 0.0)) refuse(text, "a half axis is not positive");
  if (v.size() == 5) area.degrees = v[4];
  return area;
}

Aperture annulus(const std::string& text, const std::vector<double>& v) {
  require_count(text, v, 4, 4);
  Aperture area{
      .kind = Aperture::Kind::Annulus, .x = v[0], .y = v[1], .radius = v[3], .inner_radius = v[2], .rings = {}};
  if (!(area.inner_radius >= 0.0 && area.inner_radius < area.radius)) refuse(text, "the ring is empty");
  return area;
}

Aperture polygon(const std::string& text, std::string_view list) {
  Aperture area{.kind = Aperture::Kind::Polygon, .rings = {}};
  for (const std::string_view ring : split(list, '/')) {
    const std::vector<double> v = numbers(text, ring);
    if (v.size() % 2 != 0 || v.size() < 6) {
      refuse(text, fmt::format("a ring of {} numbers; x and y of at least 3 corners required", v.size()));
    }
    std::vector<Point>& corners = area.rings.emplace_back();
    for (std::size_t i = 0; i < v.size(); i += 2) corners.push_back({v[i], v[i + 1]});
  }
  return area;
}

struct Edge {
  Point from, to;
};

double distance_to(const Edge& edge, Point p) {
  const Point along = edge.to - edge.from, to_p = p - edge.from;
  const double length2 = along.x * along.x + along.y * along.y;
  const double t = length2 > 0.0 ? std::clamp((to_p.x * along.x + to_p.y * along.y) / length2, 0.0, 1.0) : 0.0;
  return length(to_p - t * along);
}

/// Even-odd rule among the edges that come near the point's row; the boundary belongs to the area.
bool in_polygon(const std::vector<Edge>& edges, Point p, double slack) {
  bool inside = false;
  for (const Edge& e : edges) {
    if (distance_to(e, p) <= slack) return true;
    if ((e.from.y > p.y) == (e.to.y > p.y)) continue;
    if (p.x < e.from.x + (p.y - e.from.y) / (e.to.y - e.from.y) * (e.to.x - e.from.x)) inside = !inside;
  }
  return inside;
}

/// The area as the pixels of one row after the other ask for it.
class RowTest {
 public:
  RowTest(const Aperture& area, double slack) : area_(area), slack_(slack) {
    const double angle = area.degrees * std::numbers::pi / 180.0;
    cos_ = std::cos(angle), sin_ = std::sin(angle);
  }

  void enter_row(double y) {
    edges_.clear();
    for (const std::vector<Point>& ring : area_.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Edge edge{ring[i], ring[(i + 1) % ring.size()]};
        const auto [low, high] = std::minmax(edge.from.y, edge.to.y);
        if (y >= low - slack_ && y <= high + slack_) edges_.push_back(edge);
      }
    }
  }

  bool contains(Point p) const {
    const Point d = p - Point{area_.x, area_.y};
    switch (area_.kind) {
      case Aperture::Kind::Map:
        return true;
      case Aperture::Kind::Rectangle:
        return p.x >= area_.x0 - slack_ && p.x <= area_.x1 + slack_ && p.y >= area_.y0 - slack_ &&
               p.y <= area_.y1 + slack_;
      case Aperture::Kind::Circle:
        return length(d) <= area_.radius + slack_;
      case Aperture::Kind::Ellipse:
        return std::hypot((cos_ * d.x + sin_ * d.y) / (area_.a + slack_),
                          (cos_ * d.y - sin_ * d.x) / (area_.b + slack_)) <= 1.0;
      case Aperture::Kind::Annulus:
        return length(d) <= area_.radius + slack_ && length(d) >= area_.inner_radius - slack_;
      case Aperture::Kind::Polygon:
        return in_polygon(edges_, p, slack_);
    }
    return false;
  }

 private:
  const Aperture& area_;
  double slack_, cos_, sin_;
  std::vector<Edge> edges_;
};

HeightMap mask_map(HeightMap map, const Aperture& area, bool keep_inside, const Progress& progress) {
  const Grid grid = map.grid;
  const Index with_data = map.valid_pixels();
  // The boundary is closed: a pixel centre that rounding (0.1 * 3 > 0.3) puts a hair outside belongs to it.
  RowTest test(area, 1e-9 * std::min(grid.pitch_x, grid.pitch_y));
  constexpr std::uint32_t kBetweenLooks = 4096;  // a polygon may have many corners
  Poll poll(progress, kBetweenLooks);
  for (Index row = 0; row < grid.rows; ++row) {
    test.enter_row(grid.y(row));
    for (Index col = 0; col < grid.cols; ++col) {
      poll.step();
      if (test.contains(grid.centre(row, col)) != keep_inside) {
        map.at(row, col) = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  if (map.valid_pixels() == 0) {
    throw InputError(
        fmt::format("aperture '{}' leaves no pixel with data{}; the map ({} with data) has pixel "
                    "centres at x = {} to {} mm, y = {} to {} mm",
                    to_string(area), keep_inside ? "" : " outside it", counted(with_data, "pixel"), grid.x(0),
                    grid.x(grid.cols - 1), grid.y(0), grid.y(grid.rows - 1)));
  }
  return map;
}

}  // namespace

Aperture parse_aperture(const std::string& text) {
  const std::string_view view = trim(text);
  const std::size_t colon = view.find(':');
  const std::string_view kind = view.substr(0, colon);
  if (view == "map") return {};
  if (colon != std::string_view::npos) {
    const std::string_view list = view.substr(colon + 1);
    if (kind == "rect") return rectangle(text, numbers(text, list));
    if (kind == "circle") return circle(text, numbers(text, list));
    if (kind == "ellipse") return ellipse(text, numbers(text, list));
    if (kind == "annulus") return annulus(text, numbers(text, list));
    if (kind == "polygon") return polygon(text, list);
  }
  refuse(text, "unknown form");
}

std::string to_string(const Aperture& area) {
  switch (area.kind) {
    case Aperture::Kind::Map:
      return "map";
    case Aperture::Kind::Rectangle:
      return fmt::format("rect:{},{},{},{}", area.x0, area.y0, area.x1, area.y1);
    case Aperture::Kind::Circle:
      return fmt::format("circle:{},{},{}", area.x, area.y, area.radius);
    case Aperture::Kind::Ellipse:
      return fmt::format("ellipse:{},{},{},{},{}", area.x, area.y, area.a, area.b, area.degrees);
    case Aperture::Kind::Annulus:
      return fmt::format("annulus:{},{},{},{}", area.x, area.y, area.inner_radius, area.radius);
    case Aperture::Kind::Polygon:
      break;
  }
  std::string text = "polygon:";
  for (const std::vector<Point>& ring : area.rings) {
    if (&ring != &area.rings.front()) text += '/';
    for (const Point& p : ring) text += fmt::format("{}{},{}", &p == &ring.front() ? "" : ",", p.x, p.y);
  }
  return text;
}

HeightMap within(HeightMap map, const Aperture& aperture, const Progress& progress) {
  return mask_map(std::move(map), aperture, true, progress);
}

HeightMap outside(HeightMap map, const Aperture& aperture, const Progress& progress) {
  return mask_map(std::move(map), aperture, false, progress);
}

}  // namespace dwell
