#include "paths/tours/nearest_neighbour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "paths/domain/cell_pyramid.h"
#include "paths/domain/point_limit.h"
#include "paths/domain/rounding.h"
#include "paths/tours/spanning_tree.h"
#include "paths/tours/tour_improvement.h"

namespace dwell {
namespace {

void check(const NearestOptions& o, const Grid& grid) {
  const double pitch = std::max(grid.pitch_x, grid.pitch_y);
  if (!(o.cell > 0.0)) throw InputError(fmt::format("nearest: cell = {} mm; required > 0", o.cell));
  if (!std::isfinite(o.cell)) throw InputError(fmt::format("nearest: cell = {} mm; required finite", o.cell));
  if (!(o.cell >= pitch * (1.0 - kRounding))) {
    throw InputError(fmt::format("nearest: cell = {} mm; required >= the map's pixel pitch, {} mm", o.cell, pitch));
  }
  if (!(o.critical < std::numeric_limits<double>::infinity())) {
    throw InputError(fmt::format("nearest: critical = {} nm; required finite, or -inf to keep every cell", o.critical));
  }
  if (!(o.lift > 0.0)) throw InputError(fmt::format("nearest: lift = {}; required > 0, or inf to lift never", o.lift));
  if (o.start && !(std::isfinite(o.start->x) && std::isfinite(o.start->y))) {
    throw InputError(fmt::format("nearest: start = {}/{} mm; required finite", o.start->x, o.start->y));
  }
}

/// The tiling, one axis.
struct Tiles {
  double low = 0.0;
  double side = 1.0;
  double count = 1.0;  // integral

  Tiles(double first_centre, double last_centre, double pixel, double cell) : side(cell) {
    count = std::max(1.0, std::ceil((last_centre - first_centre + pixel) / cell - kRounding));
    low = 0.5 * (first_centre + last_centre) - 0.5 * count * cell;
  }
  double centre(Index i) const { return low + side * (static_cast<double>(i) + 0.5); }
  Index holding(double v) const {
    return static_cast<Index>(std::clamp(std::floor((v - low) / side + kRounding), 0.0, count - 1.0));
  }
};

struct Cells {
  Tiles x, y;
  Index rows, cols;
  std::vector<double> mean;  // rows * cols, row-major; NaN = no valid pixel, or left alone
  Index with_pixels = 0;

  Point centre(Index cell) const { return {x.centre(cell % cols), y.centre(cell / cols)}; }
};

Cells tile(const Grid& grid, const std::vector<Index>& pixels, double cell) {
  Index first_col = grid.cols, last_col = -1;
  for (const Index i : pixels) {
    first_col = std::min(first_col, i % grid.cols);
    last_col = std::max(last_col, i % grid.cols);
  }
  const Index first_row = pixels.front() / grid.cols, last_row = pixels.back() / grid.cols;
  const Tiles x(grid.x(first_col), grid.x(last_col), grid.pitch_x, cell);
  const Tiles y(grid.y(first_row), grid.y(last_row), grid.pitch_y, cell);
  if (!(x.count * y.count <= kMaxPathPoints)) {
    throw InputError(fmt::format("nearest: cell = {} mm makes {:.0f} x {:.0f} cells; at most {:.0e} accepted", cell,
                                 x.count, y.count, kMaxPathPoints));
  }
  return {x, y, static_cast<Index>(y.count), static_cast<Index>(x.count), {}, 0};
}

/// Eq. 1: the mean of the valid pixels of every cell.
Cells average(const HeightMap& map, const std::vector<Index>& pixels, double cell, const Progress& progress) {
  Poll poll(progress);
  Cells cells = tile(map.grid, pixels, cell);
  const auto size = static_cast<std::size_t>(cells.rows * cells.cols);
  std::vector<std::int32_t> count(size, 0);
  cells.mean.assign(size, 0.0);
  for (const Index i : pixels) {
    poll.step();
    const Point p = map.grid.centre(i);
    const auto k = static_cast<std::size_t>(cells.y.holding(p.y) * cells.cols + cells.x.holding(p.x));
    cells.mean[k] += map.values[static_cast<std::size_t>(i)];
    ++count[k];
  }
  for (std::size_t k = 0; k < size; ++k) {
    cells.mean[k] = count[k] > 0 ? cells.mean[k] / count[k] : std::numeric_limits<double>::quiet_NaN();
    if (count[k] > 0) ++cells.with_pixels;
  }
  return cells;
}

void drop_below(Cells& cells, double critical) {
  double highest = -std::numeric_limits<double>::infinity();
  bool any = false;
  for (double& mean : cells.mean) {
    if (std::isnan(mean)) continue;
    highest = std::max(highest, mean);
    if (mean >= critical) {
      any = true;
    } else {
      mean = std::numeric_limits<double>::quiet_NaN();
    }
  }
  if (!any) {
    throw InputError(
        fmt::format("nearest: critical = {} nm keeps no cell; the highest mean of the {} cells is {:.6g} nm", critical,
                    cells.with_pixels, highest));
  }
}

Index start_cell(const Cells& cells, const std::optional<Point>& start) {
  Index best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < static_cast<Index>(cells.mean.size()); ++k) {
    if (std::isnan(cells.mean[static_cast<std::size_t>(k)])) continue;
    if (!start) return k;
    const double d = distance(*start, cells.centre(k));
    if (best < 0 || d < best_distance) {
      best = k;
      best_distance = d;
    }
  }
  return best;
}

/// Reorders the cells; returns what to say of it. Works in cells, so that lattice distances are exact.
std::vector<std::string> shorten(std::vector<Index>& order, const Cells& cells, const NearestOptions& nearest,
                                 const Progress& progress) {
  std::vector<Point> points;
  points.reserve(order.size());
  for (const Index k : order) {
    points.push_back({static_cast<double>(k % cells.cols), static_cast<double>(k / cells.cols)});
  }
  std::vector<Index> identity(order.size());
  std::iota(identity.begin(), identity.end(), Index{0});
  TourOptions options;
  options.fixed_start = nearest.start.has_value();
  const ImprovedTour tour = improve_tour(points, identity, options, progress);
  const std::vector<Index> greedy = order;
  for (std::size_t j = 0; j < order.size(); ++j) order[j] = greedy[static_cast<std::size_t>(tour.order[j])];
  const double side = cells.x.side;
  return {
      fmt::format("2-opt and Or-opt moves shortened the nearest-neighbour path from {:.6g} to {:.6g} mm; no path "
                  "through its points is shorter than their minimum spanning tree, {:.6g} mm",
                  side * tour.length_before, side * tour.length_after, side * spanning_tree_length(points, progress))};
}

void append_points(const std::vector<Index>& order, const Cells& cells, double lift, NearestPath& result) {
  Index before = order.front();
  for (const Index k : order) {
    const double dr = static_cast<double>(k / cells.cols - before / cells.cols);
    const double dc = static_cast<double>(k % cells.cols - before % cells.cols);
    const bool first = result.path.points.empty();
    result.path.points.push_back(cells.centre(k));
    result.path.lifted.push_back(first || dr * dr + dc * dc > lift * lift ? 1 : 0);
    result.eigenvalues.push_back(cells.mean[static_cast<std::size_t>(k)]);
    before = k;
  }
}

}  // namespace

NearestOptions parse_nearest_options(const SpecText& spec) {
  spec.accept_only({"cell", "critical", "lift", "start", "improve"});
  NearestOptions options;
  options.cell = spec.number("cell");
  options.critical = spec.number("critical", options.critical);
  options.lift = spec.number("lift", options.lift);
  options.start = spec.optional_point("start");
  options.improve = spec.choice("improve", {"none", "2opt"}) == "2opt";
  return options;
}

std::vector<PathDistance> nearest_distances(const NearestOptions& options) { return {{"cell", options.cell}}; }

NearestPath nearest_path(const HeightMap& map, const NearestOptions& options, const Progress& progress) {
  Poll poll(progress, 4096);
  check(options, map.grid);
  const std::vector<Index> pixels = finite_pixels(map);
  if (pixels.empty()) throw InputError("nearest: the map has no finite pixel; at least one is required");
  Cells cells = average(map, pixels, options.cell, progress);
  drop_below(cells, options.critical);

  NearestPath result;
  result.path.kind = "nearest";
  result.cells_total = cells.with_pixels;
  CellPyramid unvisited(cells.rows, cells.cols, cells.mean);
  std::vector<Index> order;
  Index row = 0, col = 0;
  for (Index k = start_cell(cells, options.start); k >= 0; k = unvisited.nearest(row, col)) {
    poll.step();
    order.push_back(k);
    row = k / cells.cols;
    col = k % cells.cols;
    unvisited.remove(k);
  }
  result.blocks_searched = unvisited.blocks_searched();
  if (options.improve) result.path.notes = shorten(order, cells, options, progress);
  append_points(order, cells, options.lift, result);
  return result;
}

}  // namespace dwell
