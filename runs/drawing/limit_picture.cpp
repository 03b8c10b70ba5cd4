#include "runs/drawing/limit_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/duration_text.h"
#include "runs/drawing/line_chart.h"
#include "runs/drawing/map_figure.h"

namespace dwell {
namespace {

// Blue, orange, vermilion and bluish green of Okabe and Ito, which colour-blind readers tell apart; grey where nothing
// binds.
constexpr std::array<Colour, kBindingLimits> kLimitColours{
    {{110, 110, 110}, {0, 114, 178}, {230, 159, 0}, {213, 94, 0}, {0, 158, 115}}};
constexpr std::size_t kStretchesAtOnce = 65536;
constexpr std::size_t kShownTimes = 1500;

struct PlaneBox {
  double left, right, bottom, top;  // [mm]
};

PlaneBox box_around(const HeightMap& map, const std::vector<MotionNode>& nodes) {
  const Grid& g = map.grid;
  PlaneBox b{g.origin.x - 0.5 * g.pitch_x, 0.0, g.origin.y - 0.5 * g.pitch_y, 0.0};
  b.right = b.left + g.width();
  b.top = b.bottom + g.height();
  for (const MotionNode& node : nodes) {
    if (!node.removes) continue;
    b.left = std::min(b.left, node.place.x), b.right = std::max(b.right, node.place.x);
    b.bottom = std::min(b.bottom, node.place.y), b.top = std::max(b.top, node.place.y);
  }
  const double rim = 0.01 * std::max(b.right - b.left, b.top - b.bottom);
  return {b.left - rim, b.right + rim, b.bottom - rim, b.top + rim};
}

/// The part as zeros, NaN outside of it.
PlotField part_in(const HeightMap& map, const PlaneBox& b, const Progress& progress) {
  const double scale = field_edges(1).square / std::max(b.right - b.left, b.top - b.bottom);
  PlotField field;
  field.cols = std::max(8, static_cast<int>(std::lround((b.right - b.left) * scale)));
  field.rows = std::max(8, static_cast<int>(std::lround((b.top - b.bottom) * scale)));
  field.left = b.left, field.right = b.right, field.bottom = b.bottom, field.top = b.top;
  const Grid& g = map.grid;
  const auto is_part = [&](double x, double y) {
    const double col = std::round((x - g.origin.x) / g.pitch_x), row = std::round((y - g.origin.y) / g.pitch_y);
    return col >= 0.0 && row >= 0.0 && col < static_cast<double>(g.cols) && row < static_cast<double>(g.rows) &&
           std::isfinite(map.at(static_cast<Index>(row), static_cast<Index>(col)));
  };
  for (int r = 0; r < field.rows; ++r) {
    progress.check();
    const double y = b.bottom + (b.top - b.bottom) * (r + 0.5) / field.rows;
    for (int c = 0; c < field.cols; ++c) {
      const double x = b.left + (b.right - b.left) * (c + 0.5) / field.cols;
      field.values.push_back(is_part(x, y) ? 0.0 : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return field;
}

class LimitPen {
 public:
  LimitPen(Sheet& sheet, const SheetBox& place, const PlaneBox& box) : sheet_(sheet), place_(place), box_(box) {}

  void draw(const std::vector<MotionNode>& nodes, const std::vector<BindingLimit>& limits, BindingLimit limit,
            const Progress& progress) {
    const Colour colour = kLimitColours[static_cast<std::size_t>(limit)];
    std::vector<Point> line;
    const auto finish = [&] {
      if (line.size() > 1) sheet_.polyline(line, {colour, limit == BindingLimit::None ? 0.8 : 1.3});
      line.clear();
    };
    for (std::size_t k = 0; k < limits.size(); ++k) {
      if (k % kStretchesAtOnce == 0) progress.check();
      const bool drawn = limits[k] == limit && nodes[k + 1].removes;
      if (!drawn || line.size() > 500) finish();
      if (!drawn) continue;
      if (limit == BindingLimit::Rest) {
        sheet_.disc(on_sheet(nodes[k].place), 1.3, colour);
        continue;
      }
      if (line.empty()) line.push_back(on_sheet(nodes[k].place));
      line.push_back(on_sheet(nodes[k + 1].place));
    }
    finish();
  }

 private:
  Point on_sheet(Point p) const {
    return {place_.left + (p.x - box_.left) / (box_.right - box_.left) * place_.width,
            place_.top + (box_.top - p.y) / (box_.top - box_.bottom) * place_.height};
  }

  Sheet& sheet_;
  const SheetBox& place_;
  const PlaneBox& box_;
};

std::vector<PanelKey> key_of(const std::vector<MotionNode>& nodes, const std::vector<BindingLimit>& limits) {
  constexpr std::array<const char*, kBindingLimits> kWords{
      {"nothing binds: at the feed that is commanded", "the highest speed of path or axes",
       "the acceleration of path or axes", "at rest at a corner", "the jerk of path or axes"}};
  const std::array<double, kBindingLimits> seconds = time_at_limits(nodes, limits);
  double total = 0.0;
  for (const double s : seconds) total += s;
  std::vector<PanelKey> key;
  for (std::size_t k = 0; k < kBindingLimits; ++k) {
    if (static_cast<BindingLimit>(k) == BindingLimit::Jerk && !(seconds[k] > 0.0)) continue;  // few machines limit it
    key.push_back(
        {kLimitColours[k], fmt::format("{}: {:.1f} % of the time at work, {}", kWords[k],
                                       total > 0.0 ? 100.0 * seconds[k] / total : 0.0, duration_text(seconds[k]))});
  }
  return key;
}

/// A value that changes evenly over a time.
struct ValueStretch {
  double begin, end;     // [s]
  double first, second;  // at the two
};

/// Points of a line; where there are more stretches than it can show, of equal times the least and the largest value.
std::vector<ChartPoint> shown_points(const std::vector<ValueStretch>& stretches) {
  std::vector<ChartPoint> points;
  if (stretches.size() <= kShownTimes) {
    for (const ValueStretch& s : stretches) {
      points.push_back({s.begin, s.first, false});
      points.push_back({s.end, s.second, false});
    }
    return points;
  }
  const double from = stretches.front().begin, width = (stretches.back().end - from) / kShownTimes;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<double> least(kShownTimes, kNone), most(kShownTimes, -kNone);
  for (const ValueStretch& s : stretches) {
    const auto bin = [&](double t) {
      return std::min(static_cast<std::size_t>(std::max(0.0, (t - from) / width)), kShownTimes - 1);
    };
    const auto value = [&](double t) { return s.first + (t - s.begin) / (s.end - s.begin) * (s.second - s.first); };
    for (std::size_t k = bin(s.begin); k <= bin(s.end); ++k) {
      const double begin = from + static_cast<double>(k) * width;
      const double a = value(std::max(begin, s.begin)), b = value(std::min(begin + width, s.end));
      least[k] = std::min({least[k], a, b});
      most[k] = std::max({most[k], a, b});
    }
  }
  for (std::size_t k = 0; k < kShownTimes; ++k) {
    if (!(least[k] <= most[k])) continue;  // the tool is lifted
    const double middle = from + (static_cast<double>(k) + 0.5) * width;
    points.push_back({middle, least[k], false});
    points.push_back({middle, most[k], false});
  }
  return points;
}

}  // namespace

std::string limit_picture(const HeightMap& map, const std::vector<MotionNode>& nodes,
                          const std::vector<BindingLimit>& limits, const std::string& title, FigureFormat format,
                          const Progress& progress) {
  const PlaneBox box = box_around(map, nodes);
  MapPanel panel;
  panel.field = part_in(map, box, progress);
  panel.colours = ColourMap::Diverging;
  panel.limits = {-1.0, 1.0, 0.0, 0.0, true};
  panel.key = key_of(nodes, limits);
  panel.over = [&](Sheet& sheet, const SheetBox& place) {
    LimitPen pen(sheet, place, box);
    for (std::size_t k = 0; k < kBindingLimits; ++k) pen.draw(nodes, limits, static_cast<BindingLimit>(k), progress);
  };
  return draw_maps(title, {std::move(panel)}, format).bytes;
}

std::string speed_picture(const std::vector<MotionNode>& nodes, const std::string& title, FigureFormat format) {
  std::vector<ValueStretch> speeds, accelerations;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const MotionNode &a = nodes[k], &b = nodes[k + 1];
    if (!b.removes || !(b.seconds > a.seconds)) continue;
    const double acceleration = (b.speed - a.speed) / (b.seconds - a.seconds);
    speeds.push_back({a.seconds, b.seconds, a.speed, b.speed});
    accelerations.push_back({a.seconds, b.seconds, acceleration, acceleration});
  }
  constexpr Colour kLine{0, 114, 178};
  ChartPanel speed{"time [s]", "speed along the path [mm/s]", {}};
  ChartPanel acceleration{"time [s]", "acceleration along the path [mm/s^2]", {}};
  speed.lines.push_back({"", kLine, shown_points(speeds), false});
  acceleration.lines.push_back({"", kLine, shown_points(accelerations), false});
  for (ChartPanel* panel : {&speed, &acceleration}) panel->x_scale = panel->y_scale = AxisScale::Linear;
  return draw_line_charts(title, "", {speed, acceleration}, format);
}

}  // namespace dwell
