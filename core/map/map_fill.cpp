#include "core/map/map_fill.h"

#include <cmath>
#include <vector>

#include "core/base/errors.h"
#include "core/numerics/laplace.h"

namespace dwell {
namespace {

/// The pixels without data that are joined by their sides with `start`, marked in `seen`.
std::vector<Index> joined_with(const HeightMap& map, Index start, std::vector<unsigned char>& seen, bool& at_edge) {
  const Grid& g = map.grid;
  std::vector<Index> pixels{start};
  seen[static_cast<std::size_t>(start)] = 1;
  at_edge = false;
  const auto visit = [&](Index row, Index col) {
    if (row < 0 || col < 0 || row >= g.rows || col >= g.cols) {
      at_edge = true;
      return;
    }
    unsigned char& mark = seen[static_cast<std::size_t>(g.index(row, col))];
    if (mark != 0 || std::isfinite(map.at(row, col))) return;
    mark = 1;
    pixels.push_back(g.index(row, col));
  };
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Index row = pixels[i] / g.cols, col = pixels[i] % g.cols;
    visit(row - 1, col), visit(row + 1, col), visit(row, col - 1), visit(row, col + 1);
  }
  return pixels;
}

}  // namespace

FillSummary fill_holes(HeightMap& map, const FillOptions& options, const Progress& progress) {
  if (map.valid_pixels() == 0) throw InputError("fill: the map has no finite pixel; at least one is required");
  const double pixel_area = map.grid.pitch_x * map.grid.pitch_y;
  std::vector<unsigned char> seen(map.values.size(), 0), unknown(map.values.size(), 0);
  FillSummary summary;
  for (Index start = 0; start < map.grid.size(); ++start) {
    const auto pixel = static_cast<std::size_t>(start);
    if (seen[pixel] != 0 || std::isfinite(map.values[pixel])) continue;
    bool at_edge = false;
    const std::vector<Index> hole = joined_with(map, start, seen, at_edge);
    if (at_edge && !options.all) continue;
    const auto size = static_cast<Index>(hole.size());
    if (options.largest > 0.0 && pixel_area * static_cast<double>(size) > options.largest) {
      ++summary.left;
      continue;
    }
    ++summary.holes;
    summary.pixels += size;
    for (const Index i : hole) unknown[static_cast<std::size_t>(i)] = 1;
  }
  solve_laplace(map.grid, unknown, map.values, progress);
  return summary;
}

}  // namespace dwell
