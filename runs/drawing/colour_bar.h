#pragma once

#include <string>

#include "runs/drawing/axis.h"
#include "runs/drawing/colour_map.h"
#include "runs/drawing/sheet.h"

namespace dwell {

/// The scale of the colours of a field. It stands upright at the right of the field, or lies below it.
struct ColourBar {
  AxisDirection direction = AxisDirection::Up;
  AxisRange range;
  AxisTicks ticks;
  std::string unit;
  std::string below, above;  // how far the values go that the limits cut off; empty: nothing is cut off there
  double length = 0.0;       // of bar and arrows [units]
  double size = 0.0;         // how wide the bar is with its labels; of a lying one, how far they reach
};

/// `length` is the edge of the field that the bar stands at [units].
ColourBar colour_bar(const ColourLimits& limits, const std::string& unit, double length, AxisDirection direction);

/// The top left corner of an upright bar is that of its arrow, the unit stands above it. A lying bar has its labels
/// below.
void draw_colour_bar(Sheet& sheet, const ColourBar& bar, ColourMap colours, Point corner);

/// Of a lying bar with its labels [units].
inline constexpr double kColourBarBelowHeight = 42.0;

}  // namespace dwell
