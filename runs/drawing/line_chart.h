#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runs/drawing/axis.h"
#include "runs/drawing/colour.h"
#include "runs/drawing/figure_format.h"

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
  bool dots = true;                // a disc at every point
  bool dashed = false;
  bool steps = false;  // from point to point first to the right, then up or down
};

/// A shaded range of x, labelled at the top.
struct ChartBand {
  std::string label;
  double from = 0.0, to = 0.0;
  Colour colour;
};

/// The range of an axis, in place of the one that its lines need.
struct ChartLimits {
  double lower = 0.0, upper = 1.0;
};

struct ChartPanel {
  std::string x_label, y_label;  // with units
  std::vector<ChartLine> lines;
  AxisScale x_scale = AxisScale::Logarithmic, y_scale = AxisScale::Logarithmic;
  std::vector<ChartBand> bands{};
  std::string title{};  // above the panel
  std::optional<ChartLimits> y_limits{};
};

/// Draws panels of curves as a figure, two panels side by side. The key below holds every label of a line once, except
/// empty ones; of more than a dozen labels it holds a dozen, the first and the last among them. `mark` says what a
/// marked point is (empty: not in the key). On a logarithmic axis, values that are not positive lie on the edge of the
/// panel; on a linear one, a line is cut where a value is not finite.
std::string draw_line_charts(const std::string& title, const std::string& mark, const std::vector<ChartPanel>& panels,
                             FigureFormat format = FigureFormat::Png);

}  // namespace dwell
