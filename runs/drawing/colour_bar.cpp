#include "runs/drawing/colour_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

constexpr double kThickness = 14.0, kArrowLength = 12.0, kBarTick = 4.0, kBarGap = 4.0;
const TextStyle kBarLabel{13.0};

/// Colours from the lower end to the upper one, as many as there are levels of a screen.
Raster colours_of(ColourMap colours, AxisDirection direction) {
  constexpr int kLevels = 256;
  const bool up = direction == AxisDirection::Up;
  Raster raster{up ? 1 : kLevels, up ? kLevels : 1, {}};
  for (int i = 0; i < kLevels; ++i) {
    const int level = up ? kLevels - 1 - i : i;
    raster.pixels.push_back(packed(colour_at(colours, static_cast<double>(level) / (kLevels - 1))));
  }
  return raster;
}

bool has_room_beside_arrows(const ColourBar& bar, double share) {
  const double length = bar.length, needed = 1.3 * kBarLabel.size;
  return !(!bar.above.empty() && (1.0 - share) * length < needed) && !(!bar.below.empty() && share * length < needed);
}

void draw_upright(Sheet& sheet, const ColourBar& bar, ColourMap colours, Point corner) {
  const double top = corner.y + (bar.above.empty() ? 0.0 : kArrowLength);
  const double bottom = corner.y + bar.length - (bar.below.empty() ? 0.0 : kArrowLength);
  const SheetBox box{corner.x, top, kThickness, bottom - top};
  const double label_left = box.right() + kBarTick + kBarGap, down = kMiddleToBaseline * kBarLabel.size;
  sheet.image(box, colours_of(colours, bar.direction));
  sheet.frame(box, 1.0, kInk);
  for (std::size_t i = 0; i < bar.ticks.values.size(); ++i) {
    const double share = bar.range.share(bar.ticks.values[i]), at = box.bottom() - share * box.height;
    if (!has_room_beside_arrows(bar, share)) continue;
    sheet.line({box.right() + 1.0, at}, {box.right() + 1.0 + kBarTick, at}, {kInk, 1.0});
    sheet.text({label_left, at + down}, bar.ticks.labels[i], kBarLabel);
  }
  const double middle = box.centre().x;
  if (!bar.above.empty()) {
    sheet.polygon({{box.left, top - 2.0}, {box.right(), top - 2.0}, {middle, top - kArrowLength}},
                  colour_at(colours, 1.0));
    sheet.text({label_left, top - 0.5 * kArrowLength + down}, bar.above, kBarLabel);
  }
  if (!bar.below.empty()) {
    sheet.polygon({{box.left, bottom + 2.0}, {box.right(), bottom + 2.0}, {middle, bottom + kArrowLength}},
                  colour_at(colours, 0.0));
    sheet.text({label_left, bottom + 0.5 * kArrowLength + down}, bar.below, kBarLabel);
  }
  sheet.text({box.left, corner.y - 0.5 * kBarLabel.size}, bar.unit, kBarLabel);
}

void draw_lying(Sheet& sheet, const ColourBar& bar, ColourMap colours, Point corner) {
  const double left = corner.x + (bar.below.empty() ? 0.0 : kArrowLength);
  const double right = corner.x + bar.length - (bar.above.empty() ? 0.0 : kArrowLength);
  const SheetBox box{left, corner.y, right - left, kThickness};
  const double baseline = box.bottom() + kBarTick + kBarGap + 0.75 * kBarLabel.size, middle = box.centre().y;
  sheet.image(box, colours_of(colours, bar.direction));
  sheet.frame(box, 1.0, kInk);
  TextStyle centred = kBarLabel, from_right = kBarLabel;
  centred.anchor = TextStyle::Anchor::Middle;
  from_right.anchor = TextStyle::Anchor::Right;
  const double below_width = bar.below.empty() ? 0.0 : Sheet::text_width(bar.below, kBarLabel) + kBarLabel.size;
  const double above_width = bar.above.empty() ? 0.0 : Sheet::text_width(bar.above, kBarLabel) + kBarLabel.size;
  for (std::size_t i = 0; i < bar.ticks.values.size(); ++i) {
    const double at = box.left + bar.range.share(bar.ticks.values[i]) * box.width;
    const double half = 0.5 * Sheet::text_width(bar.ticks.labels[i], kBarLabel);
    if (at - half < corner.x + below_width || at + half > corner.x + bar.length - above_width) {
      if (!bar.above.empty() || !bar.below.empty()) continue;
    }
    sheet.line({at, box.bottom() + 1.0}, {at, box.bottom() + 1.0 + kBarTick}, {kInk, 1.0});
    sheet.text({at, baseline}, bar.ticks.labels[i], centred);
  }
  if (!bar.above.empty()) {
    sheet.polygon({{right + 2.0, box.top}, {right + 2.0, box.bottom()}, {right + kArrowLength, middle}},
                  colour_at(colours, 1.0));
    sheet.text({corner.x + bar.length, baseline}, bar.above, from_right);
  }
  if (!bar.below.empty()) {
    sheet.polygon({{left - 2.0, box.top}, {left - 2.0, box.bottom()}, {left - kArrowLength, middle}},
                  colour_at(colours, 0.0));
    sheet.text({corner.x, baseline}, bar.below, kBarLabel);
  }
  sheet.text({corner.x + bar.length + kBarGap + 2.0, middle + kMiddleToBaseline * kBarLabel.size}, bar.unit, kBarLabel);
}

}  // namespace

ColourBar colour_bar(const ColourLimits& limits, const std::string& unit, double length, AxisDirection direction) {
  ColourBar bar{direction, {AxisScale::Linear, limits.lower, limits.upper}, {}, unit, {}, {}, length, 0.0};
  bar.ticks = bar.range.ticks(length, direction, kBarLabel);
  if (limits.clips_below()) bar.below = fmt::format("min {:.4g}", limits.smallest);
  if (limits.clips_above()) bar.above = fmt::format("max {:.4g}", limits.largest);
  const double unit_width = Sheet::text_width(unit, kBarLabel);
  if (direction == AxisDirection::Across) {
    bar.size = length + kBarGap + 2.0 + unit_width;
    return bar;
  }
  double widest = 0.0;
  for (const std::string& label : bar.ticks.labels) widest = std::max(widest, Sheet::text_width(label, kBarLabel));
  for (const std::string& label : {bar.below, bar.above})
    widest = std::max(widest, Sheet::text_width(label, kBarLabel));
  bar.size = std::max(kThickness + kBarTick + kBarGap + widest, unit_width);
  return bar;
}

void draw_colour_bar(Sheet& sheet, const ColourBar& bar, ColourMap colours, Point corner) {
  bar.direction == AxisDirection::Up ? draw_upright(sheet, bar, colours, corner)
                                     : draw_lying(sheet, bar, colours, corner);
}

}  // namespace dwell
