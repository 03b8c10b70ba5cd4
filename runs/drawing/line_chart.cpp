#include "runs/drawing/line_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dwell {
namespace {

constexpr Colour kChartInk{32, 32, 32}, kGrid{224, 224, 224}, kChartPaper{255, 255, 255};
constexpr int kChartScale = 2;                                    // of the font
constexpr int kHeight = 420;                                      // of the axes of a panel
constexpr int kLeft = 120, kRight = 40, kTop = 60, kBottom = 76;  // around them
constexpr int kKeyLine = 26, kKeyColumns = 4, kKeyWidth = 330;    // of the key
constexpr std::size_t kMostKeys = 12;
constexpr int kMostTicks = 7;
constexpr double kChartMargin = 0.06;  // of the range of the logarithm, on either side

/// The range of one axis.
struct Range {
  AxisScale scale = AxisScale::Logarithmic;
  double lower = 0.1, upper = 1.0;

  /// From 0 at the lower end to 1; whatever is outside, or no number of this scale, is on the edge.
  double share(double value) const {
    if (!(value > lower)) return 0.0;
    const bool is_linear = scale == AxisScale::Linear;
    const double share =
        is_linear ? (value - lower) / (upper - lower) : std::log(value / lower) / std::log(upper / lower);
    return std::min(share, 1.0);
  }
  bool holds(double value) const { return std::isfinite(value) && (scale == AxisScale::Linear || value > 0.0); }
  Ticks ticks() const {
    return scale == AxisScale::Linear ? round_ticks(lower, upper, kMostTicks) : log_ticks(lower, upper, kMostTicks);
  }
};

Range range_of(const ChartPanel& panel, double ChartPoint::*coordinate, AxisScale scale) {
  Range range{scale, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const ChartLine& line : panel.lines) {
    for (const ChartPoint& p : line.points) {
      if (!range.holds(p.*coordinate)) continue;
      range.lower = std::min(range.lower, p.*coordinate);
      range.upper = std::max(range.upper, p.*coordinate);
    }
  }
  if (!(range.lower <= range.upper)) return {scale};
  if (scale == AxisScale::Linear) {
    const double size = std::max(std::abs(range.lower), std::abs(range.upper));
    const double room = std::max({kChartMargin * (range.upper - range.lower), 1e-9 * size, 1e-300});
    return {scale, range.lower - room, range.upper + room};
  }
  const double room = std::max(kChartMargin * std::log(range.upper / range.lower), 0.01);
  return {scale, range.lower * std::exp(-room), range.upper * std::exp(room)};
}

struct Axes {
  int left, top, width;
  Range x, y;

  int column(double value) const { return left + static_cast<int>(std::lround(width * x.share(value))); }
  int row(double value) const { return top + kHeight - static_cast<int>(std::lround(kHeight * y.share(value))); }
  /// Where linear axes have no such point, the line is cut.
  bool cut(const ChartPoint& p) const {
    return (x.scale == AxisScale::Linear && !std::isfinite(p.x)) ||
           (y.scale == AxisScale::Linear && !std::isfinite(p.y));
  }
};

void shade_bands(Canvas& canvas, const Axes& axes, const std::vector<ChartBand>& bands) {
  for (const ChartBand& band : bands) {
    const int from = axes.column(band.from), to = axes.column(band.to), width = to - from;
    canvas.fill_rectangle(from, axes.top, width, kHeight, band.colour);
  }
}

void label_bands(Canvas& canvas, const Axes& axes, const std::vector<ChartBand>& bands) {
  for (const ChartBand& band : bands) {
    const int from = axes.column(band.from), room = axes.column(band.to) - from;
    const int width = Canvas::text_width(band.label, kChartScale);
    if (width + 8 > room) continue;
    canvas.text(from + (room - width) / 2, axes.top + 8, band.label, kChartScale, kChartInk);
  }
}

void draw_frame(Canvas& canvas, const Axes& axes, const ChartPanel& panel) {
  const int below = axes.top + kHeight;
  const Ticks x = axes.x.ticks();
  for (std::size_t i = 0; i < x.values.size(); ++i) {
    const int at = axes.column(x.values[i]);
    canvas.line(at, axes.top, at, below, kGrid);
    canvas.text(at - Canvas::text_width(x.labels[i], kChartScale) / 2, below + 12, x.labels[i], kChartScale, kChartInk);
  }
  const Ticks y = axes.y.ticks();
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    const int at = axes.row(y.values[i]);
    canvas.line(axes.left, at, axes.left + axes.width, at, kGrid);
    canvas.text(axes.left - 10 - Canvas::text_width(y.labels[i], kChartScale),
                at - Canvas::text_height(kChartScale) / 2, y.labels[i], kChartScale, kChartInk);
  }
  canvas.frame(axes.left, axes.top, axes.width, kHeight, 1, kChartInk);
  canvas.text(axes.left + (axes.width - Canvas::text_width(panel.x_label, kChartScale)) / 2, below + 42, panel.x_label,
              kChartScale, kChartInk);
  canvas.text_upwards(axes.left - kLeft + 16, axes.top + (kHeight + Canvas::text_width(panel.y_label, kChartScale)) / 2,
                      panel.y_label, kChartScale, kChartInk);
}

void draw_point(Canvas& canvas, int x, int y, bool marked, Colour colour) {
  if (marked) canvas.fill_rectangle(x - 7, y - 7, 15, 15, kChartInk);
  const int half = marked ? 5 : 3;
  canvas.fill_rectangle(x - half, y - half, 2 * half + 1, 2 * half + 1, colour);
}

/// Two pixels thick; dashed: ten pixels drawn, ten left out, counted from `along`.
void draw_stroke(Canvas& canvas, int x0, int y0, int x1, int y1, const ChartLine& line, double& along) {
  constexpr double kDash = 10.0;
  const double length = std::hypot(x1 - x0, y1 - y0);
  const int pieces = line.dashed ? std::max(static_cast<int>(std::ceil(length / 2.0)), 1) : 1;
  for (int k = 0; k < pieces; ++k) {
    const double begin = along + length * k / pieces;
    if (line.dashed && std::fmod(begin, 2.0 * kDash) >= kDash) continue;
    const auto at = [&](int from, int to, int step) {
      return from + static_cast<int>(std::lround(static_cast<double>(to - from) * step / pieces));
    };
    const int bx = at(x0, x1, k), by = at(y0, y1, k), ex = at(x0, x1, k + 1), ey = at(y0, y1, k + 1);
    canvas.line(bx, by, ex, ey, line.colour);
    canvas.line(bx, by + 1, ex, ey + 1, line.colour);
  }
  along += length;
}

void draw_line(Canvas& canvas, const Axes& axes, const ChartLine& line) {
  double along = 0.0;
  for (std::size_t k = 1; k < line.points.size(); ++k) {
    const ChartPoint &p = line.points[k - 1], &q = line.points[k];
    if (axes.cut(p) || axes.cut(q)) continue;
    draw_stroke(canvas, axes.column(p.x), axes.row(p.y), axes.column(q.x), axes.row(q.y), line, along);
  }
  for (const ChartPoint& p : line.points) {
    if (axes.cut(p) || !(line.dots || p.marked)) continue;
    draw_point(canvas, axes.column(p.x), axes.row(p.y), p.marked, line.colour);
  }
}

/// The lines named in the key: of those with different labels, a dozen with the first and the last.
std::vector<const ChartLine*> keys_of(const std::vector<ChartPanel>& panels) {
  std::vector<const ChartLine*> all;
  for (const ChartPanel& panel : panels) {
    for (const ChartLine& line : panel.lines) {
      const auto same = [&](const ChartLine* other) { return other->label == line.label; };
      if (!line.label.empty() && std::none_of(all.begin(), all.end(), same)) all.push_back(&line);
    }
  }
  const std::size_t count = std::min(all.size(), kMostKeys);
  std::vector<const ChartLine*> keys;
  for (std::size_t k = 0; k < count; ++k) keys.push_back(all[count == 1 ? 0 : k * (all.size() - 1) / (count - 1)]);
  return keys;
}

void draw_key(Canvas& canvas, const std::vector<const ChartLine*>& keys, const std::string& mark, int top, int columns,
              int column_width) {
  const std::size_t entries = keys.size() + (mark.empty() ? 0 : 1);
  for (std::size_t k = 0; k < entries; ++k) {
    const int x = kLeft + static_cast<int>(k) % columns * column_width;
    const int y = top + static_cast<int>(k) / columns * kKeyLine;
    if (k == keys.size()) {
      draw_point(canvas, x, y + 7, true, kChartPaper);
    } else if (keys[k]->dashed) {
      canvas.fill_rectangle(x - 12, y + 5, 10, 4, keys[k]->colour);
      canvas.fill_rectangle(x + 2, y + 5, 10, 4, keys[k]->colour);
    } else {
      canvas.fill_rectangle(x - 12, y + 5, 24, 4, keys[k]->colour);
    }
    canvas.text(x + 22, y, k == keys.size() ? mark : keys[k]->label, kChartScale, kChartInk);
  }
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
  const std::vector<const ChartLine*> keys = keys_of(panels);
  int panels_width = 0, key_width = kKeyWidth;
  for (const ChartPanel& panel : panels) panels_width += kLeft + panel.width + kRight;
  for (const ChartLine* key : keys) key_width = std::max(key_width, 60 + Canvas::text_width(key->label, kChartScale));
  const int width = std::max({panels_width, kLeft + (panels_width > 0 ? 1 : kKeyColumns) * key_width,
                              2 * kRight + Canvas::text_width(title, kChartScale)});
  const int columns = std::max((width - kLeft) / key_width, 1);
  const int entries = static_cast<int>(keys.size()) + (mark.empty() ? 0 : 1), key_top = kTop + kHeight + kBottom + 10;
  Canvas canvas(width, key_top + (entries + columns - 1) / columns * kKeyLine + 16, kChartPaper);
  canvas.text(kRight, 20, title, kChartScale, kChartInk);
  int left = 0;
  for (const ChartPanel& panel : panels) {
    const Axes axes{left + kLeft, kTop, panel.width, range_of(panel, &ChartPoint::x, panel.x_scale),
                    range_of(panel, &ChartPoint::y, panel.y_scale)};
    shade_bands(canvas, axes, panel.bands);
    draw_frame(canvas, axes, panel);
    for (const ChartLine& line : panel.lines) draw_line(canvas, axes, line);
    label_bands(canvas, axes, panel.bands);
    left += kLeft + panel.width + kRight;
  }
  draw_key(canvas, keys, mark, key_top, columns, key_width);
  return canvas.png();
}

}  // namespace dwell
