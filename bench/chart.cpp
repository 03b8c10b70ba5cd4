#include "bench/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runs/drawing/canvas.h"

namespace dwell::bench {
namespace {

constexpr Colour kInk{32, 32, 32}, kGrid{224, 224, 224}, kPaper{255, 255, 255};
constexpr std::array<Colour, 12> kColours{{{214, 39, 40},
                                           {31, 119, 180},
                                           {44, 160, 44},
                                           {255, 127, 14},
                                           {148, 103, 189},
                                           {140, 86, 75},
                                           {227, 119, 194},
                                           {23, 190, 207},
                                           {188, 189, 34},
                                           {127, 127, 127},
                                           {0, 0, 0},
                                           {0, 90, 50}}};
constexpr int kWidth = 560, kHeight = 300;                       // of the axes of a panel
constexpr int kLeft = 90, kRight = 30, kTop = 44, kBottom = 66;  // around them
constexpr double kLowest = 1e-4, kHighest = 10.0;                // gap

struct Axes {
  int left, top;
  double first, last;  // seconds

  int x(double seconds) const {
    const double s = std::clamp(seconds, first, last);
    return left + static_cast<int>(std::lround(kWidth * std::log(s / first) / std::log(last / first)));
  }
  int y(double gap) const {
    const double g = gap >= kLowest ? std::min(gap, kHighest) : kLowest;
    return top + static_cast<int>(std::lround(kHeight * std::log(kHighest / g) / std::log(kHighest / kLowest)));
  }
};

Axes axes_of(const ChartPanel& panel, int left, int top) {
  double first = std::numeric_limits<double>::infinity(), last = 0.0;
  for (const ChartLine& line : panel.lines) {
    for (const ChartPoint& p : line.points) {
      if (!(p.seconds > 0.0)) continue;
      first = std::min(first, p.seconds);
      last = std::max(last, p.seconds);
    }
  }
  if (!(first < last)) return {left, top, 0.01, 10.0};
  return {left, top, std::pow(10.0, std::floor(std::log10(first))), std::pow(10.0, std::ceil(std::log10(last)))};
}

void draw_frame(Canvas& canvas, const Axes& axes, const std::string& title) {
  for (double g = kHighest; g >= 0.999 * kLowest; g /= 10.0) {
    canvas.line(axes.left, axes.y(g), axes.left + kWidth, axes.y(g), kGrid);
    const std::string label = g >= 0.9 ? fmt::format("{:.0f}00 %", g) : fmt::format("{:.6g} %", 100.0 * g);
    canvas.text(axes.left - 8 - Canvas::text_width(label, 2), axes.y(g) - 7, label, 2, kInk);
  }
  for (double s = axes.first; s <= 1.001 * axes.last; s *= 10.0) {
    canvas.line(axes.x(s), axes.top, axes.x(s), axes.top + kHeight, kGrid);
    const std::string label = fmt::format("{:.4g} s", s);
    canvas.text(axes.x(s) - Canvas::text_width(label, 2) / 2, axes.top + kHeight + 12, label, 2, kInk);
  }
  canvas.frame(axes.left, axes.top, kWidth, kHeight, 1, kInk);
  canvas.text(axes.left, axes.top - 26, title, 2, kInk);
}

void thick_line(Canvas& canvas, int x0, int y0, int x1, int y1, Colour colour) {
  canvas.line(x0, y0, x1, y1, colour);
  canvas.line(x0 + 1, y0 + 1, x1 + 1, y1 + 1, colour);
}

void draw_line(Canvas& canvas, const Axes& axes, const ChartLine& line, Colour colour) {
  for (std::size_t k = 1; k < line.points.size(); ++k) {
    const int x0 = axes.x(line.points[k - 1].seconds), x1 = axes.x(line.points[k].seconds);
    const int y0 = axes.y(line.points[k - 1].gap), y1 = axes.y(line.points[k].gap);
    thick_line(canvas, x0, y0, x1, y0, colour);
    thick_line(canvas, x1, y0, x1, y1, colour);
  }
  if (line.points.size() == 1) {
    canvas.fill_rectangle(axes.x(line.points[0].seconds) - 3, axes.y(line.points[0].gap) - 3, 7, 7, colour);
  }
}

std::vector<std::string> labels_of(const std::vector<ChartPanel>& panels) {
  std::vector<std::string> labels;
  for (const ChartPanel& panel : panels) {
    for (const ChartLine& line : panel.lines) {
      if (std::find(labels.begin(), labels.end(), line.label) == labels.end()) labels.push_back(line.label);
    }
  }
  return labels;
}

}  // namespace

std::string draw_chart(const std::vector<ChartPanel>& panels) {
  const std::vector<std::string> labels = labels_of(panels);
  const int columns = panels.size() > 1 ? 2 : 1;
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  const int panel_width = kLeft + kWidth + kRight, panel_height = kTop + kHeight + kBottom;
  const int width = std::max(columns * panel_width, 1100);
  constexpr int kKeyLine = 26, kKeyMark = 32, kKeyGap = 24;
  int key_width = 1;
  for (const std::string& label : labels)
    key_width = std::max(key_width, kKeyMark + Canvas::text_width(label, 2) + kKeyGap);
  const int key_columns = std::max(1, (width - kLeft) / key_width);
  const int key_rows = (static_cast<int>(labels.size()) + key_columns - 1) / key_columns;
  const int key_top = 52, panels_top = key_top + key_rows * kKeyLine + 12;
  Canvas canvas(width, panels_top + std::max(rows, 1) * panel_height, kPaper);
  canvas.text(kLeft, 16, "objective above the reference, against time since the start of the solve, 2 threads", 2,
              kInk);
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const int x = kLeft + static_cast<int>(k) % key_columns * key_width,
              y = key_top + static_cast<int>(k) / key_columns * kKeyLine;
    canvas.fill_rectangle(x, y + 5, 24, 4, kColours[k % kColours.size()]);
    canvas.text(x + kKeyMark, y, labels[k], 2, kInk);
  }
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const int column = static_cast<int>(k) % columns, row = static_cast<int>(k) / columns;
    const Axes axes = axes_of(panels[k], column * panel_width + kLeft, panels_top + row * panel_height + kTop);
    draw_frame(canvas, axes, panels[k].title);
    for (const ChartLine& line : panels[k].lines) {
      const auto label = std::find(labels.begin(), labels.end(), line.label) - labels.begin();
      draw_line(canvas, axes, line, kColours[static_cast<std::size_t>(label) % kColours.size()]);
    }
  }
  return canvas.png();
}

}  // namespace dwell::bench
