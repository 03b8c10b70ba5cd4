#include "runs/plan/expected_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/grid_limit.h"
#include "core/tif/kernel_change.h"

namespace dwell {
namespace {

/// Mean squares of x and y about the middle of the map, over the pixels with data [mm^2].
Point mean_squares_about_middle(const HeightMap& map) {
  const Point middle = middle_of(map.grid);
  Point sum;
  const std::vector<Index> pixels = finite_pixels(map);
  for (const Index pixel : pixels) {
    const Point p = map.grid.centre(pixel) - middle;
    sum = sum + Point{p.x * p.x, p.y * p.y};
  }
  return (1.0 / static_cast<double>(pixels.size())) * sum;
}

/// Sum over the map's pixels of the squared slope of the rate that an end between two strokes like this one shifts
/// [nm^2/s^2/mm^2]: each counts by how near its place is to the end.
double squared_slope_at_end(const RemovalKernel& kernel, Point stroke) {
  constexpr int kParts = 4;  // of a stroke, on either side of the end
  const Grid& grid = kernel.surface.grid();
  double squares = 0.0;
  for (Index i = 0; i < grid.size(); ++i) {
    double by_x = 0.0, by_y = 0.0;
    for (int k = 1 - kParts; k < kParts; ++k) {
      const double u = static_cast<double>(k) / kParts, weight = (1.0 - std::abs(u)) / kParts;
      const SplineSurface::Jet jet = kernel.surface.jet(grid.centre(i) + u * stroke);
      by_x += weight * jet.by_x, by_y += weight * jet.by_y;
    }
    squares += by_x * by_x + by_y * by_y;
  }
  return squares / static_cast<double>(kernel.division.x * kernel.division.y);
}

/// The mean over some strokes, evenly along the path.
double mean_squared_slope(const RemovalGeometry& g) {
  constexpr std::size_t kMost = 16;
  const std::size_t step = std::max<std::size_t>(1, g.strokes.size() / kMost);
  double sum = 0.0, count = 0.0;
  for (std::size_t j = 0; j < g.strokes.size(); j += step, count += 1.0)
    sum += squared_slope_at_end(g.kernel, g.strokes[j].finish - g.strokes[j].start);
  return sum / std::max(1.0, count);
}

}  // namespace

ExpectedRows::ExpectedRows(const Part& part, const std::shared_ptr<const RemovalGeometry>& geometry,
                           RemovalOperator& removal, const UncertaintySpec& unsure) {
  std::vector<ExpectedRemoval::Block> blocks{{&removal, 1.0}};
  const auto add = [&](RemovalKernel kernel, double deviation) {
    auto changed = std::make_shared<RemovalGeometry>(*geometry);
    changed->kernel = std::move(kernel);
    operators_.push_back(make_removal_operator(*changed));
    changes_.push_back({std::move(changed), deviation});
    blocks.push_back({operators_.back().get(), deviation});
  };
  if (unsure.tif_rate > 0.0) {
    changes_.push_back({geometry, unsure.tif_rate});
    blocks.push_back({&removal, unsure.tif_rate});
  }
  const Grid& map = part.map.grid;
  if (unsure.tif_width > 0.0)
    add(kernel_by_width(part.tif, geometry->kernel, map.pitch_x, map.pitch_y), unsure.tif_width);
  const double radians = unsure.rotation * std::numbers::pi / 180.0;
  const Point squares = radians > 0.0 ? mean_squares_about_middle(part.map) : Point{};
  const double shift_x = std::hypot(unsure.offset, radians * std::sqrt(squares.y));
  const double shift_y = std::hypot(unsure.offset, radians * std::sqrt(squares.x));
  if (shift_x > 0.0) add(kernel_by_shift(geometry->kernel, ShiftAxis::X), shift_x);
  if (shift_y > 0.0) add(kernel_by_shift(geometry->kernel, ShiftAxis::Y), shift_y);
  if (unsure.position > 0.0) beta_ = unsure.position * unsure.position * mean_squared_slope(*geometry);
  rows_ = std::make_unique<ExpectedRemoval>(std::move(blocks));
}

}  // namespace dwell
