#include "runs/figure/predicted_removal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/removal/simulate.h"
#include "core/tif/removal_kernel.h"
#include "core/tif/scaled_removal.h"

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

PredictedRemoval predict_removal(const HeightMap& map, const RemovalFunction& tif, const Program& motion,
                                 const std::vector<double>& widths, double margin, int threads,
                                 const Progress& progress) {
  const HeightMap wide = wider_grid(map.grid, margin);
  PredictedRemoval predicted;
  for (const double width : widths) {
    progress.step(fmt::format("predicted removal of a tool {:g} times as wide", width));
    const RemovalKernel kernel = pixel_kernel(scaled_removal(tif, 1.0, width), map.grid.pitch_x, map.grid.pitch_y);
    predicted.widths.push_back(width);
    predicted.removals.push_back(simulate(motion, wide, kernel, threads));
  }
  return predicted;
}

}  // namespace dwell
