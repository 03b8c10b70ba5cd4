#include "runs/drawing/map_figure.h"

#include <algorithm>
#include <cmath>

#include "runs/drawing/axis.h"
#include "runs/drawing/colour_bar.h"

namespace dwell {
namespace {

constexpr double kMargin = 14.0;  // around everything
constexpr double kTickLength = 4.0, kGap = 5.0, kFrameWidth = 1.0;
constexpr double kLineHeight = 1.35;  // of a line of text [sizes of the font]
const TextStyle kLabel{13.0};
const TextStyle kPanelTitle{13.0, true};
const TextStyle kTitle{15.0, true};

/// A panel on its own: everything from its own top left corner.
struct PanelLayout {
  SheetBox field;
  std::vector<std::string> title;
  AxisTicks x, y;
  double widest_y = 0.0;  // label
  bool bar_below = false;
  ColourBar bar;
  double width = 0.0, height = 0.0;
};

double title_height(const std::vector<std::string>& lines, const TextStyle& style) {
  return static_cast<double>(lines.size()) * kLineHeight * style.size;
}

AxisRange x_range(const PlotField& f) { return {AxisScale::Linear, f.left, f.right}; }
AxisRange y_range(const PlotField& f) { return {AxisScale::Linear, f.bottom, f.top}; }

PanelLayout lay_out(const MapPanel& panel) {
  const PlotField& f = panel.field;
  PanelLayout l;
  l.field.width = static_cast<double>(f.cols) / kPixelsPerUnit;
  l.field.height = static_cast<double>(f.rows) / kPixelsPerUnit;
  l.x = x_range(f).ticks(l.field.width, AxisDirection::Across, kLabel);
  l.y = y_range(f).ticks(l.field.height, AxisDirection::Up, kLabel);
  for (const std::string& label : l.y.labels) l.widest_y = std::max(l.widest_y, Sheet::text_width(label, kLabel));
  l.field.left = std::ceil(kLabel.size * kLineHeight + kGap + l.widest_y + kGap + kTickLength + kFrameWidth);
  l.bar_below = f.cols >= kLongAspect * f.rows;
  l.bar = colour_bar(panel.limits, panel.unit, l.bar_below ? l.field.width : l.field.height,
                     l.bar_below ? AxisDirection::Across : AxisDirection::Up);
  const double right =
      l.bar_below || !panel.key.empty() ? std::max(l.field.width, l.bar.size) : l.field.width + 14.0 + l.bar.size;
  // The last label of the x axis may stand out of the field.
  const double last_label = l.x.labels.empty() ? 0.0 : 0.5 * Sheet::text_width(l.x.labels.back(), kLabel);
  l.width = l.field.left + std::max(right, l.field.width + last_label);
  for (const PanelKey& entry : panel.key)
    l.width = std::max(l.width, l.field.left + 32.0 + Sheet::text_width(entry.label, kLabel));
  l.title = break_into_lines(panel.title, kPanelTitle, l.width);
  const double above =
      title_height(l.title, kPanelTitle) + (l.bar_below || !panel.key.empty() || !panel.limits.any ? 0.0 : kLabel.size);
  // The name of the y axis may stand out of a thin field.
  const double name_above = 0.5 * (Sheet::text_width("y [mm]", kLabel) - l.field.height);
  l.field.top = std::ceil(std::max({above + kGap, 0.6 * kLabel.size, name_above}));
  l.height = l.field.bottom() + kTickLength + 2.0 * kGap + 2.0 * kLineHeight * kLabel.size;
  if (!panel.key.empty()) {
    l.height += kGap + static_cast<double>(panel.key.size()) * kLineHeight * kLabel.size;
  } else if (l.bar_below && panel.limits.any) {
    l.height += kColourBarBelowHeight;
  }
  return l;
}

void draw_title(Sheet& sheet, const std::vector<std::string>& lines, double left, double top, const TextStyle& style) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    sheet.text({left, top + (static_cast<double>(i) * kLineHeight + 1.0) * style.size}, lines[i], style);
  }
}

void draw_axes(Sheet& sheet, const MapPanel& panel, const PanelLayout& l, const SheetBox& field) {
  sheet.frame(field, kFrameWidth, kInk);
  TextStyle centred = kLabel, right = kLabel, upwards = kLabel;
  centred.anchor = upwards.anchor = TextStyle::Anchor::Middle;
  right.anchor = TextStyle::Anchor::Right;
  upwards.upwards = true;
  const AxisRange x = x_range(panel.field), y = y_range(panel.field);
  const double below = field.bottom() + kFrameWidth;
  for (std::size_t i = 0; i < l.x.values.size(); ++i) {
    const double at = field.left + x.share(l.x.values[i]) * field.width;
    sheet.line({at, below}, {at, below + kTickLength}, {kInk, 1.0});
    sheet.text({at, below + kTickLength + kGap + 0.75 * kLabel.size}, l.x.labels[i], centred);
  }
  const double before = field.left - kFrameWidth;
  for (std::size_t i = 0; i < l.y.values.size(); ++i) {
    const double at = field.bottom() - y.share(l.y.values[i]) * field.height;
    sheet.line({before - kTickLength, at}, {before, at}, {kInk, 1.0});
    sheet.text({before - kTickLength - kGap, at + kMiddleToBaseline * kLabel.size}, l.y.labels[i], right);
  }
  sheet.text({field.centre().x, below + kTickLength + 2.0 * kGap + (kLineHeight + 0.75) * kLabel.size}, "x [mm]",
             centred);
  sheet.text({before - kTickLength - 2.0 * kGap - l.widest_y - 0.2 * kLabel.size, field.centre().y}, "y [mm]", upwards);
}

Raster raster_of(const MapPanel& panel) {
  const PlotField& f = panel.field;
  Raster raster{f.cols, f.rows, {}};
  raster.pixels.reserve(f.values.size());
  for (int row = f.rows; row-- > 0;) {
    for (int col = 0; col < f.cols; ++col) {
      raster.pixels.push_back(packed(colour_at(panel.colours, panel.limits.fraction(f.at(row, col)))));
    }
  }
  return raster;
}

void draw_no_data(Sheet& sheet, const SheetBox& field) {
  TextStyle style{15.0, false, TextStyle::Anchor::Middle};
  while (style.size > 6.0 && Sheet::text_width("no data", style) > field.width) style.size -= 1.0;
  sheet.text({field.centre().x, field.centre().y + kMiddleToBaseline * style.size}, "no data", style);
}

void draw_key(Sheet& sheet, const std::vector<PanelKey>& key, Point at) {
  const double line = kLineHeight * kLabel.size;
  for (const PanelKey& entry : key) {
    if (!entry.is_text) sheet.line({at.x, at.y + 0.5 * line}, {at.x + 24.0, at.y + 0.5 * line}, {entry.colour, 3.0});
    sheet.text({at.x + (entry.is_text ? 0.0 : 32.0), at.y + 0.5 * line + kMiddleToBaseline * kLabel.size}, entry.label,
               kLabel);
    at.y += line;
  }
}

/// Returns the place of the field.
SheetBox draw_panel(Sheet& sheet, const MapPanel& panel, const PanelLayout& l, double left, double top) {
  const SheetBox field{left + l.field.left, top + l.field.top, l.field.width, l.field.height};
  draw_title(sheet, l.title, left, top, kPanelTitle);
  sheet.image(field, raster_of(panel));
  if (panel.over) {
    sheet.clip(field);
    panel.over(sheet, field);
    sheet.unclip();
  }
  draw_axes(sheet, panel, l, field);
  const double below = field.bottom() + kTickLength + 3.0 * kGap + 2.0 * kLineHeight * kLabel.size;
  if (!panel.key.empty()) {
    draw_key(sheet, panel.key, {field.left, below});
  } else if (!panel.limits.any) {
    draw_no_data(sheet, field);
  } else if (l.bar_below) {
    draw_colour_bar(sheet, l.bar, panel.colours, {field.left, below});
  } else {
    draw_colour_bar(sheet, l.bar, panel.colours, {field.right() + 14.0, field.top});
  }
  return field;
}

/// Panels that stand side by side.
struct Row {
  std::size_t first = 0, last = 0;
  double width = 0.0, height = 0.0;
};

constexpr double kBetween = 22.0;

/// Rows of panels, whose fields of one row get the same top.
std::vector<Row> rows_of(std::vector<PanelLayout>& layouts) {
  std::vector<Row> rows;
  for (std::size_t k = 0; k < layouts.size(); ++k) {
    const double with_this = rows.empty() ? 0.0 : rows.back().width + kBetween + layouts[k].width;
    if (rows.empty() || with_this > kWidestSheet - 2.0 * kMargin) {
      rows.push_back({k, k + 1, layouts[k].width, 0.0});
    } else {
      rows.back().last = k + 1;
      rows.back().width = with_this;
    }
  }
  for (Row& row : rows) {
    double top = 0.0;
    for (std::size_t k = row.first; k < row.last; ++k) top = std::max(top, layouts[k].field.top);
    for (std::size_t k = row.first; k < row.last; ++k) {
      layouts[k].height += top - layouts[k].field.top;
      layouts[k].field.top = top;
      row.height = std::max(row.height, layouts[k].height);
    }
  }
  return rows;
}

}  // namespace

FieldEdges field_edges(std::size_t panels) {
  if (panels < 2) return {1040, 1280};
  return {500, 1280};
}

MapFigure draw_maps(const std::string& title, const std::vector<MapPanel>& panels, FigureFormat format) {
  std::vector<PanelLayout> layouts;
  layouts.reserve(panels.size());
  for (const MapPanel& panel : panels) layouts.push_back(lay_out(panel));
  const std::vector<Row> rows = rows_of(layouts);
  double width = 320.0, height = 0.0;
  for (const Row& row : rows) width = std::max(width, row.width), height += row.height + kMargin;
  const std::vector<std::string> lines = break_into_lines(title, kTitle, width);
  double top = kMargin + (lines.empty() ? 0.0 : title_height(lines, kTitle) + kGap);
  Sheet sheet(format, std::ceil(width + 2.0 * kMargin), std::ceil(top + height));
  draw_title(sheet, lines, kMargin, kMargin, kTitle);
  MapFigure figure;
  for (const Row& row : rows) {
    double left = kMargin;
    for (std::size_t k = row.first; k < row.last; ++k) {
      figure.places.push_back(draw_panel(sheet, panels[k], layouts[k], left, std::ceil(top)));
      left = std::ceil(left + layouts[k].width + kBetween);
    }
    top = std::ceil(top + row.height + kMargin);
  }
  figure.bytes = sheet.bytes();
  return figure;
}

}  // namespace dwell
