#include "runs/figure/tool_removal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/removal/simulate.h"
#include "core/tif/scaled_removal.h"
#include "runs/plan/lattice_choice.h"

namespace dwell {
namespace {

/// Zeros on the map's grid and so far around it.
HeightMap wider_grid(const Grid& grid, double margin) {
  const auto more = [margin](double pitch) { return static_cast<Index>(std::ceil(margin / pitch)); };
  const Index columns = more(grid.pitch_x), rows = more(grid.pitch_y);
  Grid wide = grid;
  wide.rows += 2 * rows, wide.cols += 2 * columns;
  wide.origin =
      grid.origin - Point{grid.pitch_x * static_cast<double>(columns), grid.pitch_y * static_cast<double>(rows)};
  HeightMap map(wide);
  std::fill(map.values.begin(), map.values.end(), 0.0);
  return map;
}

}  // namespace

ToolRemoval::ToolRemoval(const Part& part, const Program& motion, const Progress& progress)
    : part_(part), kernel_(choose_lattice(part, removing_steps(motion).strokes, progress).kernel) {}

ToolRemoval::ToolRemoval(const Part& part, RemovalKernel kernel) : part_(part), kernel_(std::move(kernel)) {}

RemovalKernel ToolRemoval::kernel_of(double rate, double width) const {
  if (rate == 1.0 && width == 1.0) return kernel_;
  const Grid& map = part_.map.grid;
  RemovalKernel kernel =
      pixel_kernel(scaled_removal(part_.tif, rate, width), map.pitch_x, map.pitch_y, kernel_.division);
  kernel.coarse = kernel_.coarse;
  return kernel;
}

HeightMap ToolRemoval::of(const Program& motion, double rate, double width) const {
  return simulate(motion, part_.map, kernel_of(rate, width), part_.threads);
}

PredictedRemoval ToolRemoval::predict(const Program& motion, const std::vector<double>& widths, double margin,
                                      const Progress& progress) const {
  const HeightMap wide = wider_grid(part_.map.grid, margin);
  PredictedRemoval predicted;
  for (const double width : widths) {
    progress.step(fmt::format("predicted removal of a tool {:g} times as wide", width));
    predicted.widths.push_back(width);
    predicted.removals.push_back(simulate(motion, wide, kernel_of(1.0, width), part_.threads));
  }
  return predicted;
}

}  // namespace dwell
