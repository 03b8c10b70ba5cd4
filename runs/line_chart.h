#pragma once

#include <string>
#include <vector>

#include "runs/canvas.h"
#include "runs/ticks.h"

namespace dwell {

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
  bool marked = false;  // drawn large, with an edge
};

struct ChartLine {
  std::string label;
  Colour colour;
  std::vector<ChartPoint> points;  // joined in this order
};

struct ChartPanel {
  std::string x_label, y_label;  // with units
  std::vector<ChartLine> lines;
};

/// Curves side by side as a PNG file, a panel each, both axes logarithmic; the key below holds the labels of the first
/// panel's lines (of many, a dozen), and `mark` says what a marked point is. Values that are not positive lie on the
/// edge of the panel. ASCII.
std::string draw_line_charts(const std::string& title, const std::string& mark, const std::vector<ChartPanel>& panels);

/// Ticks of a logarithmic axis: 1, 2, 5 times powers of ten, powers of ten alone where these are more than `most`, or
/// round_ticks where the range is too narrow for three of them. Throws std::invalid_argument unless 0 < lower < upper,
/// both finite, and most >= 3.
Ticks log_ticks(double lower, double upper, int most);

}  // namespace dwell
