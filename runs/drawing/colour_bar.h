#pragma once

#include <string>

#include "runs/drawing/axis.h"
#include "runs/drawing/colour_map.h"
#include "runs/drawing/sheet.h"

namespace dwell {

/// The scale of the colours of a field. It stands upright to the right of the field, or lies horizontally below it.
struct ColourBar {
  AxisDirection direction = AxisDirection::Up;
  AxisRange range;
  AxisTicks ticks;
  std::string unit;
  std::string below, above;  // how far the values go that the limits cut off; empty: nothing is cut off there
  double length = 0.0;       // of bar and arrows [units]
  double size = 0.0;         // how wide the bar is with its labels; of a horizontal bar, how far they reach
};

/// `length` is the edge of the field that the bar stands at [units].
ColourBar colour_bar(const ColourLimits& limits, const std::string& unit, double length, AxisDirection direction);

/// `corner` is the top left one. That of an upright bar is the corner of its arrow, and the unit stands above it; a
/// horizontal bar has its labels below.
void draw_colour_bar(Sheet& sheet, const ColourBar& bar, ColourMap colours, Point corner);

/// The height of a horizontal bar with its labels [units].
inline constexpr double kColourBarBelowHeight = 42.0;

}  // namespace dwell
