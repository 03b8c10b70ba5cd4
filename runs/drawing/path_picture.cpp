#include "runs/drawing/path_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "runs/drawing/picture.h"
#include "runs/drawing/plot.h"

namespace dwell {
namespace {

constexpr Colour kTrack{24, 24, 24}, kLifted{220, 30, 30}, kStart{20, 150, 60}, kEnd{220, 30, 30};
constexpr double kTracksInDetail = 40.0;

struct Window {
  double left, right, bottom, top;  // [mm]

  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

Window window_of(const HeightMap& map, const ToolPath& path) {
  const Grid& g = map.grid;
  Window w{g.origin.x - 0.5 * g.pitch_x, 0.0, g.origin.y - 0.5 * g.pitch_y, 0.0};
  w.right = w.left + g.width();
  w.top = w.bottom + g.height();
  for (const Point p : path.points) {
    w = {std::min(w.left, p.x), std::max(w.right, p.x), std::min(w.bottom, p.y), std::max(w.top, p.y)};
  }
  return w;
}

/// Distance between neighbouring tracks of a path that covers its area evenly [mm].
double track_distance(const HeightMap& map, const std::vector<Stroke>& strokes) {
  double length = 0.0;
  for (const Stroke& s : strokes) length += s.length();
  const double area = static_cast<double>(map.valid_pixels()) * map.grid.pitch_x * map.grid.pitch_y;
  return length > 0.0 ? area / length : std::sqrt(area / static_cast<double>(strokes.size()));
}

PlotField field_in(const HeightMap& map, const Window& w) {
  const double scale = kPlotEdge / std::max(w.width(), w.height());
  PlotField field;
  field.cols = std::max(8, static_cast<int>(std::lround(w.width() * scale)));
  field.rows = std::max(8, static_cast<int>(std::lround(w.height() * scale)));
  field.left = w.left, field.right = w.right, field.bottom = w.bottom, field.top = w.top;
  const Grid& g = map.grid;
  for (int r = 0; r < field.rows; ++r) {
    const double row = std::round((w.bottom + w.height() * (r + 0.5) / field.rows - g.origin.y) / g.pitch_y);
    for (int c = 0; c < field.cols; ++c) {
      const double col = std::round((w.left + w.width() * (c + 0.5) / field.cols - g.origin.x) / g.pitch_x);
      const bool on_map =
          row >= 0.0 && col >= 0.0 && row < static_cast<double>(g.rows) && col < static_cast<double>(g.cols);
      field.values.push_back(on_map ? map.at(static_cast<Index>(row), static_cast<Index>(col))
                                    : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return field;
}

/// Draws what of the lines of a path lies in the window.
class Pen {
 public:
  Pen(Plot& plot, const Window& window) : plot_(plot), window_(window) {}

  void line(Point a, Point b, Colour colour) {
    // Liang and Barsky: the part of the segment between the four sides.
    double from = 0.0, to = 1.0;
    const Point d = b - a;
    clip(d.x, window_.right - a.x, from, to);
    clip(-d.x, a.x - window_.left, from, to);
    clip(d.y, window_.top - a.y, from, to);
    clip(-d.y, a.y - window_.bottom, from, to);
    if (!(from <= to)) return;
    const Point p = a + from * d, q = a + to * d;
    plot_.canvas.line(column(p), row(p), column(q), row(q), colour);
  }

  void square(Point p, Colour colour) {
    if (p.x < window_.left || p.x > window_.right || p.y < window_.bottom || p.y > window_.top) return;
    plot_.canvas.fill_rectangle(column(p) - 5, row(p) - 5, 11, 11, {255, 255, 255});
    plot_.canvas.fill_rectangle(column(p) - 4, row(p) - 4, 9, 9, colour);
  }

 private:
  /// Keeps the parameters for which along * s <= room.
  static void clip(double along, double room, double& from, double& to) {
    if (along > 0.0) {
      to = std::min(to, room / along);
    } else if (along < 0.0) {
      from = std::max(from, room / along);
    } else if (room < 0.0) {
      to = -1.0;
    }
  }
  int column(Point p) const {
    const double share = (p.x - window_.left) / window_.width();
    return plot_.place.left + std::min(static_cast<int>(share * plot_.place.width), plot_.place.width - 1);
  }
  int row(Point p) const {
    const double share = (window_.top - p.y) / window_.height();
    return plot_.place.top + std::min(static_cast<int>(share * plot_.place.height), plot_.place.height - 1);
  }

  Plot& plot_;
  const Window& window_;
};

std::string drawn(const HeightMap& map, const ToolPath& path, const std::vector<Stroke>& strokes, const Window& window,
                  const std::string& title) {
  Plot plot = draw_plot(field_in(map, window), ColourMap::Diverging, colour_limits(map.values, ColourMap::Diverging),
                        title, "nm");
  Pen pen(plot, window);
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    const Stroke& s = strokes[j];
    pen.line(s.start, s.via, kTrack);
    pen.line(s.via, s.finish, kTrack);
    if (j > 0 && path.lifted[j]) pen.line(strokes[j - 1].finish, s.start, kLifted);
  }
  pen.square(path.points.front(), kStart);
  pen.square(path.points.back(), kEnd);
  return plot.canvas.png();
}

}  // namespace

std::string path_picture(const HeightMap& map, const ToolPath& path, const std::string& title) {
  validate(path);
  const Window window = window_of(map, path);
  const std::vector<Stroke> strokes = moving_strokes(path);
  const double pixels = track_distance(map, strokes) * kPlotEdge / std::max(window.width(), window.height());
  if (pixels >= kClearTrack) return drawn(map, path, strokes, window, title);
  std::vector<double> order(path.size());
  for (std::size_t j = 0; j < order.size(); ++j) {
    order[j] = 100.0 * static_cast<double>(j + 1) / static_cast<double>(order.size());
  }
  return dwell_picture(path, order, {title + ", colour: place in the order", "%", false, {}, {}});
}

std::string path_detail_picture(const HeightMap& map, const ToolPath& path, const std::string& title) {
  validate(path);
  const Window whole = window_of(map, path);
  const std::vector<Stroke> strokes = moving_strokes(path);
  const double half =
      0.5 * std::min(kTracksInDetail * track_distance(map, strokes), std::max(whole.width(), whole.height()));
  const Point middle{0.5 * (whole.left + whole.right), 0.5 * (whole.bottom + whole.top)};
  const Window window{std::max(whole.left, middle.x - half), std::min(whole.right, middle.x + half),
                      std::max(whole.bottom, middle.y - half), std::min(whole.top, middle.y + half)};
  return drawn(map, path, strokes, window, title);
}

}  // namespace dwell
