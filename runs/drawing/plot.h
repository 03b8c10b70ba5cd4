#pragma once

#include <string>

#include "runs/drawing/canvas.h"
#include "runs/drawing/colour_map.h"
#include "runs/drawing/plot_field.h"

namespace dwell {

/// Where the pixels of the field lie on the finished picture, for those who want to find them again.
struct PlotPlace {
  int left = 0;  // of the top left pixel
  int top = 0;
  int width = 0;
  int height = 0;
};

struct Plot {
  Canvas canvas;
  PlotPlace place;
};

/// The field in colour, framed, with axes in mm (+x right, +y up), title, and a colour bar with its unit: at the
/// right, or below a field at least twice as wide as high. Where the limits cut values off, the bar ends in an arrow
/// and says how far the values go. A field without values says "no data" and has no bar.
Plot draw_plot(const PlotField& field, ColourMap map, const ColourLimits& limits, const std::string& title,
               const std::string& unit);

}  // namespace dwell
