#include "runs/drawing/path_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "runs/drawing/map_figure.h"
#include "runs/drawing/picture.h"

namespace dwell {
namespace {

constexpr Colour kTrack{24, 24, 24}, kLifted{220, 30, 30}, kStart{20, 150, 60}, kEnd{220, 30, 30};
constexpr double kTracksInDetail = 40.0;
constexpr double kLineWidth = 1.0;     // [units]
constexpr std::size_t kChunk = 65536;  // points between two questions whether to stop

struct Window {
  double left, right, bottom, top;  // [mm]

  double width() const { return right - left; }
  double height() const { return top - bottom; }
  /// Whether the segment may cross the window: false only if it lies wholly on one side of it.
  bool may_see(Point a, Point b) const {
    return std::max(a.x, b.x) >= left && std::min(a.x, b.x) <= right && std::max(a.y, b.y) >= bottom &&
           std::min(a.y, b.y) <= top;
  }
  bool holds(Point p) const { return may_see(p, p); }
};

Window window_of(const HeightMap& map, const ToolPath& path, const Progress& progress) {
  const Grid& g = map.grid;
  Window w{g.origin.x - 0.5 * g.pitch_x, 0.0, g.origin.y - 0.5 * g.pitch_y, 0.0};
  w.right = w.left + g.width();
  w.top = w.bottom + g.height();
  for (std::size_t j = 0; j < path.size(); ++j) {
    if (j % kChunk == 0) progress.check();
    const Point p = path.points[j];
    w = {std::min(w.left, p.x), std::max(w.right, p.x), std::min(w.bottom, p.y), std::max(w.top, p.y)};
  }
  const double rim = 0.01 * std::max(w.width(), w.height());  // for the squares at both ends
  return {w.left - rim, w.right + rim, w.bottom - rim, w.top + rim};
}

/// Distance between neighbouring tracks of a path that covers its area evenly [mm].
double track_distance(const HeightMap& map, const ToolPath& path, const Progress& progress) {
  double length = 0.0;
  for (std::size_t j = 1; j < path.size(); ++j) {
    if (j % kChunk == 0) progress.check();
    if (!path.lifted[j]) length += distance(path.points[j - 1], path.points[j]);
  }
  const double area = static_cast<double>(map.valid_pixels()) * map.grid.pitch_x * map.grid.pitch_y;
  return length > 0.0 ? area / length : std::sqrt(area / static_cast<double>(path.size()));
}

PlotField field_in(const HeightMap& map, const Window& w, const Progress& progress) {
  const double edge = field_edges(1).square;
  const double scale = edge / std::max(w.width(), w.height());
  PlotField field;
  field.cols = std::max(8, static_cast<int>(std::lround(w.width() * scale)));
  field.rows = std::max(8, static_cast<int>(std::lround(w.height() * scale)));
  field.left = w.left, field.right = w.right, field.bottom = w.bottom, field.top = w.top;
  const Grid& g = map.grid;
  for (int r = 0; r < field.rows; ++r) {
    progress.check();
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

/// The parts of a path that cross a window, with some points on either side, so that their strokes are those of the
/// whole path.
struct VisiblePath {
  ToolPath path;                // cut where points were left out
  std::vector<char> by_lifted;  // whether the move that arrives at a point is a lifted one of the whole path
};

VisiblePath visible_path(const ToolPath& path, const Window& window, const Progress& progress) {
  constexpr std::size_t kBeyond = 3;
  std::vector<char> kept(path.size(), 0);
  for (std::size_t j = 0; j < path.size(); ++j) {
    if (j % kChunk == 0) progress.check();
    if (!window.may_see(path.points[j > 0 ? j - 1 : 0], path.points[j])) continue;
    const std::size_t first = j > kBeyond ? j - kBeyond : 0, last = std::min(j + kBeyond, path.size() - 1);
    std::fill(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.begin() + static_cast<std::ptrdiff_t>(last + 1),
              char{1});
  }
  VisiblePath visible;
  for (std::size_t j = 0; j < path.size(); ++j) {
    if (!kept[j]) continue;
    const bool joined = j > 0 && kept[j - 1] != 0;
    visible.path.points.push_back(path.points[j]);
    visible.path.lifted.push_back(!joined || path.lifted[j] ? 1 : 0);
    visible.by_lifted.push_back(joined && path.lifted[j] ? 1 : 0);
  }
  return visible;
}

/// Draws lines of the part on the field that shows a window of it.
class Pen {
 public:
  Pen(Sheet& sheet, const SheetBox& place, const Window& window) : sheet_(sheet), place_(place), window_(window) {}

  void move_to(Point p) {
    finish();
    line_ = {on_sheet(p)};
  }
  /// Ends closer than a quarter of a pixel to the last one are skipped: nobody would see them.
  void line_to(Point p) {
    constexpr double kUnseen = 0.25 / kPixelsPerUnit;
    const Point q = on_sheet(p);
    if (distance(q, line_.back()) >= kUnseen) line_.push_back(q);
    // Long lines are drawn in parts, because Cairo would search a single line for all of its crossings.
    if (line_.size() < 512) return;
    finish();
    line_ = {q};
  }
  void finish() {
    sheet_.polyline(line_, {kTrack, kLineWidth});
    line_.clear();
  }
  void lifted(Point a, Point b) { sheet_.line(on_sheet(a), on_sheet(b), {kLifted, kLineWidth}); }
  void square(Point p, Colour colour) {
    if (!window_.holds(p)) return;
    const Point at = on_sheet(p);
    sheet_.fill({at.x - 4.0, at.y - 4.0, 8.0, 8.0}, kPaper);
    sheet_.fill({at.x - 3.0, at.y - 3.0, 6.0, 6.0}, colour);
  }

 private:
  /// Far outside of the window, coordinates are cut: Cairo computes with 24 bits before the point.
  Point on_sheet(Point p) const {
    const double x = std::clamp((p.x - window_.left) / window_.width(), -50.0, 50.0);
    const double y = std::clamp((window_.top - p.y) / window_.height(), -50.0, 50.0);
    return {place_.left + x * place_.width, place_.top + y * place_.height};
  }

  Sheet& sheet_;
  const SheetBox& place_;
  const Window& window_;
  std::vector<Point> line_;
};

void draw_path(Pen& pen, const VisiblePath& visible, const Progress& progress) {
  const std::vector<Stroke> strokes = moving_strokes(visible.path);
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    if (j % kChunk == 0) progress.check();
    const Stroke& s = strokes[j];
    if (visible.path.lifted[j] || j == 0) pen.move_to(s.start);
    pen.line_to(s.via);
    pen.line_to(s.finish);
  }
  pen.finish();
  for (std::size_t j = 1; j < strokes.size(); ++j) {
    if (visible.by_lifted[j]) pen.lifted(strokes[j - 1].finish, strokes[j].start);
  }
}

std::string drawn(const HeightMap& map, const ToolPath& path, const Window& window, const std::string& title,
                  FigureFormat format, const Progress& progress) {
  const VisiblePath visible = visible_path(path, window, progress);
  MapPanel panel{field_in(map, window, progress), ColourMap::Diverging, colour_limits(map.values, ColourMap::Diverging),
                 "", "nm"};
  panel.over = [&](Sheet& sheet, const SheetBox& place) {
    Pen pen(sheet, place, window);
    draw_path(pen, visible, progress);
    pen.square(path.points.front(), kStart);
    pen.square(path.points.back(), kEnd);
  };
  return draw_maps(title, {std::move(panel)}, format).bytes;
}

}  // namespace

std::string path_picture(const HeightMap& map, const ToolPath& path, const std::string& title, FigureFormat format,
                         const Progress& progress) {
  validate(path);
  const Window window = window_of(map, path, progress);
  const double pixels =
      track_distance(map, path, progress) * field_edges(1).square / std::max(window.width(), window.height());
  if (pixels >= kClearTrack) return drawn(map, path, window, title, format, progress);
  std::vector<double> order(path.size());
  for (std::size_t j = 0; j < order.size(); ++j) {
    if (j % kChunk == 0) progress.check();
    order[j] = 100.0 * static_cast<double>(j + 1) / static_cast<double>(order.size());
  }
  return dwell_picture(path, order, {title + ", colour: place in the order", "%", false, {}, {}}, format, progress);
}

std::string path_detail_picture(const HeightMap& map, const ToolPath& path, const std::string& title,
                                FigureFormat format, const Progress& progress) {
  validate(path);
  const Window whole = window_of(map, path, progress);
  const double half =
      0.5 * std::min(kTracksInDetail * track_distance(map, path, progress), std::max(whole.width(), whole.height()));
  const Point middle{0.5 * (whole.left + whole.right), 0.5 * (whole.bottom + whole.top)};
  const Window window{std::max(whole.left, middle.x - half), std::min(whole.right, middle.x + half),
                      std::max(whole.bottom, middle.y - half), std::min(whole.top, middle.y + half)};
  return drawn(map, path, window, title, format, progress);
}

}  // namespace dwell
