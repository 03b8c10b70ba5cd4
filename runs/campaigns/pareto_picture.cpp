#include "runs/campaigns/pareto_picture.h"

#include <fmt/format.h>

#include "runs/drawing/colour_map.h"
#include "runs/drawing/line_chart.h"

namespace dwell {
namespace {

ChartPanel panel_of(const ParetoSweep& sweep, double TradeOff::*x, const std::string& x_label) {
  ChartPanel panel{x_label, "residual RMS [nm]", {}};
  const std::size_t rows = sweep.ranges.smoothnesses.size(), columns = sweep.ranges.time_prices.size();
  for (std::size_t row = 0; row < rows; ++row) {
    // Short of the palest yellow, which does not show on paper.
    const double share = rows == 1 ? 0.0 : 0.9 * static_cast<double>(row) / static_cast<double>(rows - 1);
    ChartLine line{
        fmt::format("smoothness {:.3g}", sweep.ranges.smoothnesses[row]), colour_at(ColourMap::Sequential, share), {}};
    for (std::size_t column = 0; column < columns; ++column) {
      const ParetoPoint& p = sweep.points[row * columns + column];
      line.points.push_back({p.trade_off.*x, p.exact_rms, p.on_front});
    }
    panel.lines.push_back(std::move(line));
  }
  return panel;
}

}  // namespace

std::string pareto_picture(const ParetoSweep& sweep, FigureFormat format) {
  const std::vector<double>& prices = sweep.ranges.time_prices;
  const std::string title = fmt::format(
      "Residual against total and step, time price {:.3g} to {:.3g} nm²/s along a line", prices.front(), prices.back());
  return draw_line_charts(
      title, "on the Pareto front",
      {panel_of(sweep, &TradeOff::total, "total dwell [s]"), panel_of(sweep, &TradeOff::step_rms, "step RMS [s]")},
      format);
}

}  // namespace dwell
