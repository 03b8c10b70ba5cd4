#pragma once

#include <string>
#include <vector>

namespace dwell::bench {

struct ChartPoint {
  double seconds = 0.0;
  double gap = 0.0;  // objective over that of the reference, less one
};

struct ChartLine {
  std::string label;
  std::vector<ChartPoint> points;  // in order of time
};

struct ChartPanel {
  std::string title;
  std::vector<ChartLine> lines;
};

/// Quality against time as a PNG file: a panel a scenario, both axes logarithmic, time to the right, gap downwards to
/// 1e-4, a line a solver with the same colour in every panel. Steps, since a solver stopped in between would return
/// what it had. Points without a positive, finite gap lie on the lower edge.
std::string draw_chart(const std::vector<ChartPanel>& panels);

}  // namespace dwell::bench
