#pragma once

#include <string>
#include <vector>

#include "runs/drawing/canvas.h"
#include "runs/drawing/ticks.h"

namespace dwell {

enum class AxisScale { Logarithmic, Linear };

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
  bool marked = false;  // drawn large, with an edge
};

struct ChartLine {
  std::string label;
  Colour colour;
  std::vector<ChartPoint> points;  // joined in this order
  bool dots = true;                // a square at every point
  bool dashed = false;
};

/// A shaded range of x, labelled at the top.
struct ChartBand {
  std::string label;
  double from = 0.0, to = 0.0;
  Colour colour;
};

struct ChartPanel {
  std::string x_label, y_label;  // with units
  std::vector<ChartLine> lines;
  AxisScale x_scale = AxisScale::Logarithmic, y_scale = AxisScale::Logarithmic;
  std::vector<ChartBand> bands{};
  int width = 560;  // of the axes [pixels]
};

/// Curves side by side as a PNG file, a panel each. The key below holds the different labels of all lines, where not
/// empty (of many, a dozen, first and last among them); `mark` says what a marked point is (empty: not in the key). On
/// a logarithmic axis, values that are not positive lie on the edge of the panel; on a linear one, a line is cut where
/// a value is not finite. ASCII.
std::string draw_line_charts(const std::string& title, const std::string& mark, const std::vector<ChartPanel>& panels);

/// Ticks of a logarithmic axis: 1, 2, 5 times powers of ten, powers of ten alone where these are more than `most`, or
/// round_ticks where the range is too narrow for three of them. Throws std::invalid_argument unless 0 < lower < upper,
/// both finite, and most >= 3.
Ticks log_ticks(double lower, double upper, int most);

}  // namespace dwell
