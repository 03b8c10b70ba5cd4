#include "runs/line_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dwell {
namespace {

constexpr Colour kInk{32, 32, 32}, kGrid{224, 224, 224}, kPaper{255, 255, 255};
constexpr int kScale = 2;                                         // of the font
constexpr int kWidth = 560, kHeight = 420;                        // of the axes of a panel
constexpr int kLeft = 120, kRight = 40, kTop = 60, kBottom = 76;  // around them
constexpr int kKeyLine = 26, kKeyColumns = 4, kKeyWidth = 330;    // of the key
constexpr std::size_t kMostKeys = 12;
constexpr int kMostTicks = 7;
constexpr double kMargin = 0.06;  // of the range of the logarithm, on either side

/// The range of one axis.
struct Range {
  double lower = 0.1, upper = 1.0;

  /// From 0 at the lower end to 1; whatever is outside, or no positive number, is on the edge.
  double share(double value) const {
    if (!(value > lower)) return 0.0;
    return std::min(std::log(value / lower) / std::log(upper / lower), 1.0);
  }
};

Range range_of(const ChartPanel& panel, double ChartPoint::*coordinate) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const ChartLine& line : panel.lines) {
    for (const ChartPoint& p : line.points) {
      if (!(p.*coordinate > 0.0) || !std::isfinite(p.*coordinate)) continue;
      least = std::min(least, p.*coordinate);
      most = std::max(most, p.*coordinate);
    }
  }
  if (!(most > 0.0)) return {};
  const double room = std::max(kMargin * std::log(most / least), 0.01);
  return {least * std::exp(-room), most * std::exp(room)};
}

struct Axes {
  int left, top;
  Range x, y;

  int column(double value) const { return left + static_cast<int>(std::lround(kWidth * x.share(value))); }
  int row(double value) const { return top + kHeight - static_cast<int>(std::lround(kHeight * y.share(value))); }
};

void draw_frame(Canvas& canvas, const Axes& axes, const ChartPanel& panel) {
  const int below = axes.top + kHeight;
  const Ticks x = log_ticks(axes.x.lower, axes.x.upper, kMostTicks);
  for (std::size_t i = 0; i < x.values.size(); ++i) {
    const int at = axes.column(x.values[i]);
    canvas.line(at, axes.top, at, below, kGrid);
    canvas.text(at - Canvas::text_width(x.labels[i], kScale) / 2, below + 12, x.labels[i], kScale, kInk);
  }
  const Ticks y = log_ticks(axes.y.lower, axes.y.upper, kMostTicks);
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    const int at = axes.row(y.values[i]);
    canvas.line(axes.left, at, axes.left + kWidth, at, kGrid);
    canvas.text(axes.left - 10 - Canvas::text_width(y.labels[i], kScale), at - Canvas::text_height(kScale) / 2,
                y.labels[i], kScale, kInk);
  }
  canvas.frame(axes.left, axes.top, kWidth, kHeight, 1, kInk);
  canvas.text(axes.left + (kWidth - Canvas::text_width(panel.x_label, kScale)) / 2, below + 42, panel.x_label, kScale,
              kInk);
  canvas.text_upwards(axes.left - kLeft + 16, axes.top + (kHeight + Canvas::text_width(panel.y_label, kScale)) / 2,
                      panel.y_label, kScale, kInk);
}

void draw_point(Canvas& canvas, int x, int y, bool marked, Colour colour) {
  if (marked) canvas.fill_rectangle(x - 7, y - 7, 15, 15, kInk);
  const int half = marked ? 5 : 3;
  canvas.fill_rectangle(x - half, y - half, 2 * half + 1, 2 * half + 1, colour);
}

void draw_line(Canvas& canvas, const Axes& axes, const ChartLine& line) {
  for (std::size_t k = 1; k < line.points.size(); ++k) {
    const int x0 = axes.column(line.points[k - 1].x), y0 = axes.row(line.points[k - 1].y);
    const int x1 = axes.column(line.points[k].x), y1 = axes.row(line.points[k].y);
    canvas.line(x0, y0, x1, y1, line.colour);
    canvas.line(x0, y0 + 1, x1, y1 + 1, line.colour);
  }
  for (const ChartPoint& p : line.points) {
    draw_point(canvas, axes.column(p.x), axes.row(p.y), p.marked, line.colour);
  }
}

/// The lines named in the key, first and last among them.
std::vector<std::size_t> keys_of(const std::vector<ChartLine>& lines) {
  const std::size_t count = std::min(lines.size(), kMostKeys);
  std::vector<std::size_t> keys;
  for (std::size_t k = 0; k < count; ++k) keys.push_back(count == 1 ? 0 : k * (lines.size() - 1) / (count - 1));
  return keys;
}

bool is_decade_multiple(int mantissa) { return mantissa == 1 || mantissa == 2 || mantissa == 5; }

}  // namespace

Ticks log_ticks(double lower, double upper, int most) {
  if (!(0.0 < lower && lower < upper && std::isfinite(upper)) || most < 3) {
    throw std::invalid_argument(fmt::format("logarithmic ticks of [{}, {}], at most {}", lower, upper, most));
  }
  Ticks fine, decades;
  const int first = static_cast<int>(std::floor(std::log10(lower))), last = static_cast<int>(std::log10(upper)) + 1;
  for (int exponent = first; exponent <= last; ++exponent) {
    for (int mantissa = 1; mantissa < 10; ++mantissa) {
      const double value = mantissa * std::pow(10.0, exponent);
      if (!is_decade_multiple(mantissa) || value < lower || value > upper) continue;
      for (Ticks* ticks : {&fine, &decades}) {
        if (ticks == &decades && mantissa != 1) continue;
        ticks->values.push_back(value);
        ticks->labels.push_back(fmt::format("{:.6g}", value));
      }
    }
  }
  if (fine.values.size() < 3) return round_ticks(lower, upper, most);
  return fine.values.size() <= static_cast<std::size_t>(most) ? fine : decades;
}

std::string draw_line_charts(const std::string& title, const std::string& mark, const std::vector<ChartPanel>& panels) {
  const int panel_width = kLeft + kWidth + kRight;
  const std::vector<std::size_t> keys = panels.empty() ? std::vector<std::size_t>() : keys_of(panels[0].lines);
  const int key_rows = static_cast<int>(keys.size()) / kKeyColumns + 1;  // one more entry: the mark
  const int key_top = kTop + kHeight + kBottom + 10;
  Canvas canvas(std::max({static_cast<int>(panels.size()) * panel_width, kLeft + kKeyColumns * kKeyWidth,
                          2 * kRight + Canvas::text_width(title, kScale)}),
                key_top + key_rows * kKeyLine + 16, kPaper);
  canvas.text(kRight, 20, title, kScale, kInk);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Axes axes{static_cast<int>(k) * panel_width + kLeft, kTop, range_of(panels[k], &ChartPoint::x),
                    range_of(panels[k], &ChartPoint::y)};
    draw_frame(canvas, axes, panels[k]);
    for (const ChartLine& line : panels[k].lines) draw_line(canvas, axes, line);
  }
  for (std::size_t k = 0; k <= keys.size(); ++k) {
    const int x = kLeft + static_cast<int>(k) % kKeyColumns * kKeyWidth,
              y = key_top + static_cast<int>(k) / kKeyColumns * kKeyLine;
    if (k < keys.size()) {
      const ChartLine& line = panels[0].lines[keys[k]];
      canvas.fill_rectangle(x - 12, y + 5, 24, 4, line.colour);
      canvas.text(x + 22, y, line.label, kScale, kInk);
    } else {
      draw_point(canvas, x, y + 7, true, kPaper);
      canvas.text(x + 22, y, mark, kScale, kInk);
    }
  }
  return canvas.png();
}

}  // namespace dwell
