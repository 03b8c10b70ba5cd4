#include "runs/drawing/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "runs/drawing/ticks.h"

namespace dwell {
namespace {

constexpr Colour kInk{32, 32, 32};
constexpr Colour kPaper{255, 255, 255};
constexpr int kScale = 2;    // of the font, everywhere but a title that has room
constexpr int kMargin = 16;  // around everything
constexpr int kGap = 8;      // between a thing and its label
constexpr int kFrame = 2;
constexpr int kTick = 6;
constexpr int kBar = 22;    // thickness of the colour bar
constexpr int kArrow = 12;  // its arrows, where values are cut off
constexpr int kDescent = 2 * kScale;

int width_of(const std::string& text) { return Canvas::text_width(text, kScale); }
int height_of_text() { return Canvas::text_height(kScale); }

// A horizontal or vertical axis: where its ticks are, as a fraction of its length, and what they say.
struct Axis {
  std::vector<double> fractions;
  std::vector<std::string> labels;
  int widest = 0;  // label [pixels]
};

enum class Direction { Across, Up };

// As many ticks, up to ten, as have room for their labels on `pixels`.
Axis axis_of(double lower, double upper, int pixels, Direction direction) {
  Axis axis;
  for (int most = 10; most >= 1; --most) {
    const Ticks ticks = round_ticks(lower, upper, most);
    axis = {};
    for (std::size_t i = 0; i < ticks.values.size(); ++i) {
      axis.fractions.push_back((ticks.values[i] - lower) / (upper - lower));
      axis.labels.push_back(ticks.labels[i]);
      axis.widest = std::max(axis.widest, width_of(ticks.labels[i]));
    }
    const int room = direction == Direction::Across ? axis.widest + 2 * kGap : height_of_text() + kGap;
    if (axis.fractions.size() < 2 || (axis.fractions[1] - axis.fractions[0]) * pixels >= room) break;
  }
  return axis;
}

// Breaks a text into lines of at most `most` characters: at spaces, or anywhere if there is none.
std::vector<std::string> broken_into_lines(std::string text, std::size_t most) {
  std::vector<std::string> lines;
  while (text.size() > most) {
    std::size_t at = text.rfind(' ', most);
    const bool at_space = at != std::string::npos && at > 0;
    if (!at_space) at = most;
    lines.push_back(text.substr(0, at));
    text.erase(0, at_space ? at + 1 : at);
  }
  if (!text.empty()) lines.push_back(text);
  return lines;
}

std::string short_number(double value) { return fmt::format("{:.4g}", value); }

// Everything that has to be known before the canvas can be made.
struct Layout {
  Axis x, y, bar;
  bool bar_below = false;
  std::string unit, below, above;  // "[nm]", "min -400", "max 312": empty where not said
  std::vector<std::string> title;
  int title_scale = kScale;
  int width = 0, height = 0;  // of the canvas
  PlotPlace plot;
  PlotPlace strip;  // the bar's colours, without arrows
};

int line_height(int scale) { return Canvas::text_height(scale) + 4 * scale; }

// Colour bar at the right: unit, "max", arrow, strip, arrow, "min", all within the height of the plot. Returns the
// right edge of it all.
int place_bar_at_right(Layout& l, const ColourLimits& limits) {
  const int text = height_of_text() + kGap;
  const int head = text + (l.above.empty() ? 0 : text + kArrow);
  const int foot = l.below.empty() ? 0 : text + kArrow;
  l.strip = {l.plot.left + l.plot.width + 4 * kGap, l.plot.top + head, kBar, std::max(16, l.plot.height - head - foot)};
  l.bar = axis_of(limits.lower, limits.upper, l.strip.height, Direction::Up);
  const int labels = kBar + kFrame + kTick + kGap + l.bar.widest;
  return l.strip.left + std::max({labels, width_of(l.unit), width_of(l.above), width_of(l.below)});
}

// Colour bar below: "min" and arrow at the left, arrow, "max" and unit at the right. Returns the right edge.
int place_bar_below(Layout& l, const ColourLimits& limits, int top) {
  const int length = std::min(l.plot.width, 600);
  int left = l.plot.left + (l.plot.width - length) / 2;
  if (!l.below.empty()) left = std::max(left, kMargin + width_of(l.below) + kGap + kArrow + kFrame);
  l.strip = {left, top, length, kBar};
  l.bar = axis_of(limits.lower, limits.upper, length, Direction::Across);
  const int text = width_of(l.above.empty() ? l.unit : l.above + " " + l.unit);
  return left + length + kFrame + (l.above.empty() ? 0 : kArrow) + kGap + std::max(text, l.bar.widest / 2);
}

void place_title(Layout& l, const std::string& title, int right) {
  const int room = std::max(right - kMargin, 420);
  l.title_scale = Canvas::text_width(title, 3) <= room ? 3 : kScale;
  const int advance = Canvas::text_width("MM", l.title_scale) - Canvas::text_width("M", l.title_scale);
  l.title = broken_into_lines(title, static_cast<std::size_t>(room / advance));
}

void shift(Layout& l, int dx, int dy) {
  for (PlotPlace* p : {&l.plot, &l.strip}) {
    p->left += dx;
    p->top += dy;
  }
}

Layout layout_of(const PlotField& field, const ColourLimits& limits, const std::string& title,
                 const std::string& unit) {
  Layout l;
  l.x = axis_of(field.left, field.right, field.cols, Direction::Across);
  l.y = axis_of(field.bottom, field.top, field.rows, Direction::Up);
  l.bar_below = field.cols >= kLongAspect * field.rows;
  if (!unit.empty()) l.unit = "[" + unit + "]";
  if (limits.clips_below()) l.below = "min " + short_number(limits.smallest);
  if (limits.clips_above()) l.above = "max " + short_number(limits.largest);

  // Placed as if there were no title; shifted down by it at the end.
  const int half_title = std::max(0, (width_of("y [mm]") - field.rows) / 2);
  l.plot.left = kMargin + height_of_text() + kDescent + kGap + l.y.widest + kGap + kTick + kFrame;
  l.plot.top = kMargin + std::max(height_of_text() / 2, half_title);
  l.plot.width = field.cols;
  l.plot.height = field.rows;
  const int bottom = l.plot.top + l.plot.height;
  int right = l.plot.left + l.plot.width + kFrame + l.x.widest / 2;
  int low = bottom + kFrame + kTick + kGap + height_of_text() + kGap + height_of_text() + kDescent;
  if (limits.any && l.bar_below) {
    const int top = low + 2 * kGap;
    right = std::max(right, place_bar_below(l, limits, top));
    low = top + kBar + kFrame + kTick + kGap + height_of_text();
  } else if (limits.any) {
    right = std::max(right, place_bar_at_right(l, limits));
  }
  place_title(l, title, right);
  int widest = 0;
  for (const std::string& line : l.title) widest = std::max(widest, Canvas::text_width(line, l.title_scale));
  l.width = std::max(right, kMargin + widest) + kMargin;
  const int title_height = static_cast<int>(l.title.size()) * line_height(l.title_scale);
  l.height = low + title_height + kMargin;
  shift(l, std::max(0, (kMargin + widest - right) / 2), title_height);
  return l;
}

void draw_axes(Canvas& canvas, const Layout& l) {
  const PlotPlace& p = l.plot;
  canvas.frame(p.left, p.top, p.width, p.height, kFrame, kInk);
  const int bottom = p.top + p.height;
  for (std::size_t i = 0; i < l.x.labels.size(); ++i) {
    const int x = p.left + std::clamp(static_cast<int>(l.x.fractions[i] * p.width), 0, p.width - 1);
    canvas.fill_rectangle(x, bottom + kFrame, kFrame, kTick, kInk);
    canvas.text(x - width_of(l.x.labels[i]) / 2, bottom + kFrame + kTick + kGap, l.x.labels[i], kScale, kInk);
  }
  for (std::size_t i = 0; i < l.y.labels.size(); ++i) {
    const int y = bottom - 1 - std::clamp(static_cast<int>(l.y.fractions[i] * p.height), 0, p.height - 1);
    canvas.fill_rectangle(p.left - kFrame - kTick, y, kTick, kFrame, kInk);
    const int right = p.left - kFrame - kTick - kGap;
    canvas.text(right - width_of(l.y.labels[i]), y - height_of_text() / 2 + 1, l.y.labels[i], kScale, kInk);
  }
  const int below = bottom + kFrame + kTick + 2 * kGap + height_of_text();
  canvas.text(p.left + (p.width - width_of("x [mm]")) / 2, below, "x [mm]", kScale, kInk);
  const int beside = p.left - kFrame - kTick - 2 * kGap - l.y.widest - height_of_text() - kDescent;
  canvas.text_upwards(beside, p.top + (p.height + width_of("y [mm]")) / 2, "y [mm]", kScale, kInk);
}

// A triangle on one end of the bar, base `kBar`, in the colour of the values beyond it.
void draw_arrow(Canvas& canvas, int x, int y, Direction along, int towards, Colour colour) {
  for (int i = 0; i < kArrow; ++i) {
    const int half = kBar * (kArrow - i) / (2 * kArrow);
    const int at = towards > 0 ? i : -1 - i;
    const int middle = kBar / 2;
    if (along == Direction::Across) {
      canvas.line(x + at, y + middle - half, x + at, y + middle + half - 1, colour);
    } else {
      canvas.line(x + middle - half, y + at, x + middle + half - 1, y + at, colour);
    }
  }
}

void draw_bar_at_right(Canvas& canvas, const Layout& l, ColourMap map) {
  const PlotPlace& s = l.strip;
  for (int i = 0; i < s.height; ++i) {
    canvas.fill_rectangle(s.left, s.top + s.height - 1 - i, s.width, 1, colour_at(map, (i + 0.5) / s.height));
  }
  canvas.frame(s.left, s.top, s.width, s.height, kFrame, kInk);
  for (std::size_t i = 0; i < l.bar.labels.size(); ++i) {
    const int up = std::clamp(static_cast<int>(l.bar.fractions[i] * s.height), 0, s.height - 1);
    const int y = s.top + s.height - 1 - up;
    canvas.fill_rectangle(s.left + s.width + kFrame, y, kTick, kFrame, kInk);
    canvas.text(s.left + s.width + kFrame + kTick + kGap, y - height_of_text() / 2 + 1, l.bar.labels[i], kScale, kInk);
  }
  const int text = height_of_text() + kGap;
  int head = s.top;
  if (!l.above.empty()) {
    draw_arrow(canvas, s.left, s.top - kFrame, Direction::Up, -1, colour_at(map, 1.0));
    head -= kArrow + text;
    canvas.text(s.left, head - kFrame, l.above, kScale, kInk);
  }
  canvas.text(s.left, head - text, l.unit, kScale, kInk);
  if (!l.below.empty()) {
    draw_arrow(canvas, s.left, s.top + s.height + kFrame, Direction::Up, 1, colour_at(map, 0.0));
    canvas.text(s.left, s.top + s.height + kFrame + kArrow + kGap - kFrame, l.below, kScale, kInk);
  }
}

void draw_bar_below(Canvas& canvas, const Layout& l, ColourMap map) {
  const PlotPlace& s = l.strip;
  for (int i = 0; i < s.width; ++i) {
    canvas.fill_rectangle(s.left + i, s.top, 1, s.height, colour_at(map, (i + 0.5) / s.width));
  }
  canvas.frame(s.left, s.top, s.width, s.height, kFrame, kInk);
  const int bottom = s.top + s.height;
  for (std::size_t i = 0; i < l.bar.labels.size(); ++i) {
    const int x = s.left + std::clamp(static_cast<int>(l.bar.fractions[i] * s.width), 0, s.width - 1);
    canvas.fill_rectangle(x, bottom + kFrame, kFrame, kTick, kInk);
    canvas.text(x - width_of(l.bar.labels[i]) / 2, bottom + kFrame + kTick + kGap, l.bar.labels[i], kScale, kInk);
  }
  const int text_top = s.top + (s.height - height_of_text()) / 2;
  int right = s.left + s.width + kFrame;
  if (!l.above.empty()) {
    draw_arrow(canvas, right, s.top, Direction::Across, 1, colour_at(map, 1.0));
    right += kArrow;
  }
  canvas.text(right + kGap, text_top, l.above.empty() ? l.unit : l.above + " " + l.unit, kScale, kInk);
  if (!l.below.empty()) {
    const int left = s.left - kFrame;
    draw_arrow(canvas, left, s.top, Direction::Across, -1, colour_at(map, 0.0));
    canvas.text(left - kArrow - kGap - width_of(l.below), text_top, l.below, kScale, kInk);
  }
}

void draw_no_data(Canvas& canvas, const PlotPlace& p) {
  const std::string text = "no data";
  int scale = 3;
  while (scale > 1 && Canvas::text_width(text, scale) + 2 * kGap > p.width) --scale;
  const int x = p.left + (p.width - Canvas::text_width(text, scale)) / 2;
  canvas.text(x, p.top + (p.height - Canvas::text_height(scale)) / 2, text, scale, kInk);
}

}  // namespace

Plot draw_plot(const PlotField& field, ColourMap map, const ColourLimits& limits, const std::string& title,
               const std::string& unit) {
  const Layout l = layout_of(field, limits, title, unit);
  Canvas canvas(l.width, l.height, kPaper);
  int line_top = kMargin;
  for (const std::string& line : l.title) {
    canvas.text((l.width - Canvas::text_width(line, l.title_scale)) / 2, line_top, line, l.title_scale, kInk);
    line_top += line_height(l.title_scale);
  }
  for (int row = 0; row < field.rows; ++row) {
    for (int col = 0; col < field.cols; ++col) {
      const Colour colour = colour_at(map, limits.fraction(field.at(row, col)));
      canvas.set(l.plot.left + col, l.plot.top + field.rows - 1 - row, colour);
    }
  }
  draw_axes(canvas, l);
  if (!limits.any) {
    draw_no_data(canvas, l.plot);
  } else if (l.bar_below) {
    draw_bar_below(canvas, l, map);
  } else {
    draw_bar_at_right(canvas, l, map);
  }
  return {std::move(canvas), l.plot};
}

}  // namespace dwell
