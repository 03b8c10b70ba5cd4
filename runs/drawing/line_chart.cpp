#include "runs/drawing/line_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runs/drawing/sheet.h"

namespace dwell {
namespace {

constexpr double kRim = 14.0;          // around everything
constexpr double kAxesHeight = 270.0;  // of a panel
constexpr double kBelowAxes = 50.0, kRightOfAxes = 16.0, kAboveAxes = 12.0;
constexpr double kKeyLine = 20.0, kKeyMark = 26.0, kKeyGap = 22.0;
constexpr double kCurveWidth = 1.6;
constexpr std::size_t kMostKeys = 12;
constexpr double kRoom = 0.06;  // of the range (of its logarithm), on either side
const TextStyle kText{13.0};
const TextStyle kStrong{13.0, true};
const TextStyle kHeading{15.0, true};

TextStyle with_anchor(TextStyle style, TextStyle::Anchor anchor) {
  style.anchor = anchor;
  return style;
}

AxisRange range_of(const ChartPanel& panel, double ChartPoint::*coordinate, AxisScale scale) {
  AxisRange range{scale, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const ChartLine& line : panel.lines) {
    for (const ChartPoint& p : line.points) {
      if (!range.holds(p.*coordinate)) continue;
      range.lower = std::min(range.lower, p.*coordinate);
      range.upper = std::max(range.upper, p.*coordinate);
    }
  }
  if (!(range.lower <= range.upper)) return {scale, 0.1, 1.0};
  if (scale == AxisScale::Linear) {
    const double size = std::max(std::abs(range.lower), std::abs(range.upper));
    const double room = std::max({kRoom * (range.upper - range.lower), 1e-9 * size, 1e-300});
    return {scale, range.lower - room, range.upper + room};
  }
  const double room = std::max(kRoom * std::log(range.upper / range.lower), 0.01);
  return {scale, range.lower * std::exp(-room), range.upper * std::exp(room)};
}

/// The axes of a panel on the sheet.
struct Axes {
  SheetBox box;
  AxisRange x, y;
  AxisTicks x_ticks, y_ticks;
  double widest_y = 0.0;  // label

  double column(double value) const { return box.left + box.width * x.share(value); }
  double row(double value) const { return box.bottom() - box.height * y.share(value); }
  Point place(const ChartPoint& p) const { return {column(p.x), row(p.y)}; }
  /// Where linear axes have no such point, the line is cut.
  bool cut(const ChartPoint& p) const {
    return (x.scale == AxisScale::Linear && !std::isfinite(p.x)) ||
           (y.scale == AxisScale::Linear && !std::isfinite(p.y));
  }
};

/// The axes in a cell of the sheet, left and top of which are given.
Axes axes_in(const ChartPanel& panel, double left, double top, double width) {
  Axes axes;
  axes.x = range_of(panel, &ChartPoint::x, panel.x_scale);
  axes.y = range_of(panel, &ChartPoint::y, panel.y_scale);
  if (panel.y_limits) axes.y.lower = panel.y_limits->lower, axes.y.upper = panel.y_limits->upper;
  axes.y_ticks = axes.y.ticks(kAxesHeight, AxisDirection::Up, kText);
  for (const std::string& label : axes.y_ticks.labels) {
    axes.widest_y = std::max(axes.widest_y, Sheet::text_width(label, kText));
  }
  const double before = std::ceil(axes.widest_y + 2.4 * kText.size);
  const double above = kAboveAxes + (panel.title.empty() ? 0.0 : 1.3 * kStrong.size);
  axes.box = {left + before, std::ceil(top + above), width - before - kRightOfAxes, kAxesHeight};
  axes.x_ticks = axes.x.ticks(axes.box.width, AxisDirection::Across, kText);
  return axes;
}

void shade_bands(Sheet& sheet, const Axes& axes, const std::vector<ChartBand>& bands) {
  for (const ChartBand& band : bands) {
    const double from = axes.column(band.from);
    sheet.fill({from, axes.box.top, axes.column(band.to) - from, axes.box.height}, band.colour);
  }
}

/// Draws the label in two lines if it does not fit in one, and not at all if it does not fit in two.
void label_bands(Sheet& sheet, const Axes& axes, const std::vector<ChartBand>& bands) {
  const TextStyle style = with_anchor({11.0}, TextStyle::Anchor::Middle);
  for (const ChartBand& band : bands) {
    const double from = axes.column(band.from), room = axes.column(band.to) - from - 6.0;
    const std::vector<std::string> lines = break_into_lines(band.label, style, std::max(room, 1.0));
    if (lines.size() > 3 || std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
          return Sheet::text_width(line, style) > room || line.size() < 2;
        })) {
      continue;
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      sheet.text({from + 3.0 + 0.5 * room, axes.box.top + (1.3 + 1.25 * static_cast<double>(i)) * style.size}, lines[i],
                 style);
    }
  }
}

void draw_frame(Sheet& sheet, const Axes& axes, const ChartPanel& panel) {
  const SheetBox& box = axes.box;
  const TextStyle middle = with_anchor(kText, TextStyle::Anchor::Middle),
                  right = with_anchor(kText, TextStyle::Anchor::Right);
  for (std::size_t i = 0; i < axes.x_ticks.values.size(); ++i) {
    const double at = axes.column(axes.x_ticks.values[i]);
    sheet.line({at, box.top}, {at, box.bottom()}, {kGridLines, 1.0});
    sheet.text({at, box.bottom() + 6.0 + 0.75 * kText.size}, axes.x_ticks.labels[i], middle);
  }
  for (std::size_t i = 0; i < axes.y_ticks.values.size(); ++i) {
    const double at = axes.row(axes.y_ticks.values[i]);
    sheet.line({box.left, at}, {box.right(), at}, {kGridLines, 1.0});
    sheet.text({box.left - 6.0, at + kMiddleToBaseline * kText.size}, axes.y_ticks.labels[i], right);
  }
  sheet.frame(box, 1.0, kInk);
  sheet.text({box.centre().x, box.bottom() + 12.0 + 2.0 * kText.size}, panel.x_label, middle);
  TextStyle upwards = middle;
  upwards.upwards = true;
  sheet.text({box.left - axes.widest_y - 1.1 * kText.size, box.centre().y}, panel.y_label, upwards);
  sheet.text({box.left, box.top - 6.0}, panel.title, kStrong);
}

/// `ring`: how much larger the point is drawn, so that those drawn over it leave a ring of it.
void draw_point(Sheet& sheet, Point at, bool marked, Colour colour, double ring = 0.0) {
  if (marked) sheet.disc(at, 5.5 + ring, kInk);
  sheet.disc(at, (marked ? 4.0 : 3.0) + ring, colour);
}

/// The points of lines that are but a point. Those that would lie one over the other lie in one another.
void draw_single_points(Sheet& sheet, const Axes& axes, const std::vector<ChartLine>& lines) {
  constexpr double kHides = 5.0, kRing = 3.0;
  std::vector<const ChartLine*> single;
  for (const ChartLine& line : lines) {
    if (line.points.size() == 1 && !axes.cut(line.points.front())) single.push_back(&line);
  }
  for (std::size_t k = 0; k < single.size(); ++k) {
    const ChartPoint& p = single[k]->points.front();
    const auto over = std::count_if(
        single.begin() + static_cast<std::ptrdiff_t>(k) + 1, single.end(),
        [&](const ChartLine* other) { return distance(axes.place(other->points.front()), axes.place(p)) < kHides; });
    draw_point(sheet, axes.place(p), p.marked, single[k]->colour, kRing * static_cast<double>(over));
  }
}

void draw_line(Sheet& sheet, const Axes& axes, const ChartLine& line) {
  const LineStyle style{line.colour, kCurveWidth, line.dashed};
  std::vector<Point> joined;
  const auto finish = [&] {
    sheet.polyline(joined, style);
    joined.clear();
  };
  for (const ChartPoint& p : line.points) {
    if (axes.cut(p)) {
      finish();
      continue;
    }
    const Point at = axes.place(p);
    if (line.steps && !joined.empty()) joined.push_back({at.x, joined.back().y});
    joined.push_back(at);
  }
  finish();
  for (const ChartPoint& p : line.points) {
    if (axes.cut(p) || line.points.size() == 1 || !(line.dots || p.marked)) continue;
    draw_point(sheet, axes.place(p), p.marked, line.colour);
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

/// One entry of the key: a line, or what a marked point is.
struct KeyEntry {
  const ChartLine* line = nullptr;
  std::string label;
  Point at;
};

/// Entries in columns of equal width from the top left corner on, as many as have room; returns their height.
double place_key(std::vector<KeyEntry>& entries, Point corner, double room) {
  double widest = 1.0;
  for (const KeyEntry& e : entries) widest = std::max(widest, kKeyMark + Sheet::text_width(e.label, kText) + kKeyGap);
  const auto columns = static_cast<std::size_t>(std::max(1.0, std::floor((room + kKeyGap) / widest)));
  for (std::size_t k = 0; k < entries.size(); ++k) {
    entries[k].at = {corner.x + static_cast<double>(k % columns) * widest,
                     corner.y + static_cast<double>(k / columns) * kKeyLine};
  }
  return static_cast<double>((entries.size() + columns - 1) / columns) * kKeyLine;
}

void draw_key(Sheet& sheet, const std::vector<KeyEntry>& entries) {
  for (const KeyEntry& e : entries) {
    const double middle = e.at.y + 0.5 * kKeyLine;
    if (e.line == nullptr) {
      draw_point(sheet, {e.at.x + 9.0, middle}, true, kPaper);
    } else {
      sheet.line({e.at.x, middle}, {e.at.x + 18.0, middle}, {e.line->colour, 2.5, e.line->dashed});
    }
    sheet.text({e.at.x + kKeyMark, middle + kMiddleToBaseline * kText.size}, e.label, kText);
  }
}

std::vector<KeyEntry> entries_of(const std::vector<ChartPanel>& panels, const std::string& mark) {
  std::vector<KeyEntry> entries;
  for (const ChartLine* line : keys_of(panels)) entries.push_back({line, line->label, {}});
  if (!mark.empty()) entries.push_back({nullptr, mark, {}});
  return entries;
}

}  // namespace

std::string draw_line_charts(const std::string& title, const std::string& mark, const std::vector<ChartPanel>& panels,
                             FigureFormat format) {
  const double inner = kWidestSheet - 2.0 * kRim;
  const std::vector<std::string> heading = break_into_lines(title, kHeading, inner);
  double top = kRim + 1.35 * kHeading.size * static_cast<double>(heading.size());
  const std::size_t columns = panels.size() > 1 ? 2 : 1;
  const double cell = inner / static_cast<double>(columns);
  std::vector<Axes> axes;
  for (std::size_t first = 0; first < panels.size(); first += columns) {
    double bottom = top;
    for (std::size_t k = first; k < std::min(first + columns, panels.size()); ++k) {
      axes.push_back(axes_in(panels[k], kRim + static_cast<double>(k - first) * cell, top, cell));
      bottom = std::max(bottom, axes.back().box.bottom() + kBelowAxes);
    }
    top = bottom;
  }
  std::vector<KeyEntry> key = entries_of(panels, mark);
  const double key_left = axes.empty() ? kRim : axes.front().box.left;
  const double key_height = place_key(key, {key_left, top}, kWidestSheet - kRim - key_left);
  Sheet sheet(format, kWidestSheet, std::ceil(top + key_height + kRim));
  for (std::size_t i = 0; i < heading.size(); ++i) {
    sheet.text({kRim, kRim + (1.0 + 1.35 * static_cast<double>(i)) * kHeading.size}, heading[i], kHeading);
  }
  for (std::size_t k = 0; k < panels.size(); ++k) {
    shade_bands(sheet, axes[k], panels[k].bands);
    draw_frame(sheet, axes[k], panels[k]);
    sheet.clip({axes[k].box.left - 6.0, axes[k].box.top - 6.0, axes[k].box.width + 12.0, axes[k].box.height + 12.0});
    for (const ChartLine& line : panels[k].lines) draw_line(sheet, axes[k], line);
    draw_single_points(sheet, axes[k], panels[k].lines);
    sheet.unclip();
    label_bands(sheet, axes[k], panels[k].bands);
  }
  draw_key(sheet, key);
  return sheet.bytes();
}

}  // namespace dwell
