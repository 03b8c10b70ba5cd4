#include "paths/domain/keep_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/segment.h"

namespace dwell {
namespace {

constexpr double kTouch = 1e-6;  // [mm]

/// Twice the area of the triangle a, b, c; > 0 where it runs counter-clockwise.
double cross(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool segments_touch(Point a, Point b, Point c, Point d) {
  if (cross(a, b, c) * cross(a, b, d) < 0.0 && cross(c, d, a) * cross(c, d, b) < 0.0) return true;
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)}) <= kTouch;
}

bool beside(Point a, Point b, Point c, Point d) {
  return std::max(a.x, b.x) < std::min(c.x, d.x) - kTouch || std::min(a.x, b.x) > std::max(c.x, d.x) + kTouch ||
         std::max(a.y, b.y) < std::min(c.y, d.y) - kTouch || std::min(a.y, b.y) > std::max(c.y, d.y) + kTouch;
}

/// Even-odd rule for one end; the other is then inside as well unless the move meets an edge.
bool enters_rings(const std::vector<std::vector<Point>>& rings, Point a, Point b) {
  bool inside = false;
  for (const std::vector<Point>& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point from = ring[i], to = ring[(i + 1) % ring.size()];
      if (!beside(a, b, from, to) && segments_touch(a, b, from, to)) return true;
      if ((from.y > a.y) == (to.y > a.y)) continue;
      if (a.x < from.x + (a.y - from.y) / (to.y - from.y) * (to.x - from.x)) inside = !inside;
    }
  }
  return inside;
}

/// The point in coordinates in which the ellipse is the unit circle.
Point in_ellipse(const Aperture& area, Point p) {
  const double angle = area.degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
  const Point d = p - Point{area.x, area.y};
  return {(c * d.x + s * d.y) / (area.a + kTouch), (c * d.y - s * d.x) / (area.b + kTouch)};
}

}  // namespace

bool enters(const Aperture& area, Point a, Point b) {
  const Point centre{area.x, area.y};
  switch (area.kind) {
    case Aperture::Kind::Map:
      return true;
    case Aperture::Kind::Rectangle:
      return enters_rings({{{area.x0, area.y0}, {area.x1, area.y0}, {area.x1, area.y1}, {area.x0, area.y1}}}, a, b);
    case Aperture::Kind::Circle:
      return distance_to_segment(centre, a, b) <= area.radius + kTouch;
    case Aperture::Kind::Ellipse:
      return distance_to_segment({0.0, 0.0}, in_ellipse(area, a), in_ellipse(area, b)) <= 1.0;
    case Aperture::Kind::Annulus:
      return distance_to_segment(centre, a, b) <= area.radius + kTouch &&
             std::max(distance(a, centre), distance(b, centre)) >= area.inner_radius - kTouch;
    case Aperture::Kind::Polygon:
      break;
  }
  return enters_rings(area.rings, a, b);
}

namespace {

class Sparing {
 public:
  Sparing(const ToolPath& path, Motion motion, const std::vector<Aperture>& zones)
      : motion_(motion), zones_(zones), result_{path, 0, 0} {}

  SparedPath find() {
    leave_out(points_inside());
    do {
      cut();
    } while (leave_out(strokes_inside()));
    note();
    return std::move(result_);
  }

 private:
  bool in_zone(Point a, Point b) const {
    return std::any_of(zones_.begin(), zones_.end(), [&](const Aperture& zone) { return enters(zone, a, b); });
  }

  std::vector<char> points_inside() const {
    std::vector<char> inside;
    for (const Point& p : result_.path.points) inside.push_back(static_cast<char>(in_zone(p, p)));
    return inside;
  }

  std::vector<char> strokes_inside() const {
    std::vector<char> inside;
    if (motion_ == Motion::Stop) return inside;  // the points themselves are outside
    for (const Stroke& s : moving_strokes(result_.path))
      inside.push_back(static_cast<char>(in_zone(s.start, s.via) || in_zone(s.via, s.finish)));
    return inside;
  }

  /// Returns whether any point was.
  bool leave_out(const std::vector<char>& marked) {
    const std::size_t count = static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1));
    if (count == 0) return false;
    if (count == result_.path.size()) {
      throw InputError(fmt::format("`keep out`: the zones leave none of the path's dwell points ({} before)",
                                   counted(count + result_.left_out, "point")));
    }
    std::vector<Point> points;
    std::vector<char> lifted;
    bool lift = false;
    for (std::size_t j = 0; j < marked.size(); ++j) {
      lift = lift || result_.path.lifted[j] != 0;
      if (marked[j] != 0) continue;
      points.push_back(result_.path.points[j]);
      lifted.push_back(static_cast<char>(lift));
      lift = false;
    }
    result_.path.points.swap(points);
    result_.path.lifted.swap(lifted);
    result_.left_out += count;
    return true;
  }

  void cut() {
    for (std::size_t j = 1; j < result_.path.size(); ++j) {
      char& lifted = result_.path.lifted[j];
      if (lifted != 0 || !in_zone(result_.path.points[j - 1], result_.path.points[j])) continue;
      lifted = 1;
      ++result_.lifted_over;
    }
  }

  void note() {
    if (result_.left_out == 0 && result_.lifted_over == 0) return;
    result_.path.notes.push_back(fmt::format(
        "keep-out: {} in a zone or with a stroke that would come into one left out, the tool lifted over zones {}",
        counted(result_.left_out, "dwell point"), counted(result_.lifted_over, "time")));
  }

  Motion motion_;
  const std::vector<Aperture>& zones_;
  SparedPath result_;
};

}  // namespace

SparedPath keep_out_of(const ToolPath& path, Motion motion, const std::vector<Aperture>& zones) {
  validate(path);
  return Sparing(path, motion, zones).find();
}

}  // namespace dwell
