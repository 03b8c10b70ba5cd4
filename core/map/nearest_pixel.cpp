#include "core/map/nearest_pixel.h"

#include <cmath>
#include <limits>

#include "core/base/errors.h"
#include "core/numerics/lower_envelope.h"

namespace dwell {
namespace {

/// The finite pixel of the same row that is nearest, or -1.
std::vector<Index> nearest_in_row(const HeightMap& map, const Progress& progress) {
  const Grid& g = map.grid;
  std::vector<Index> nearest(map.values.size(), -1);
  for (Index row = 0; row < g.rows; ++row) {
    progress.check();
    Index last = -1;
    for (Index col = 0; col < g.cols; ++col) {
      if (std::isfinite(map.at(row, col))) last = col;
      if (last >= 0) nearest[static_cast<std::size_t>(g.index(row, col))] = g.index(row, last);
    }
    last = -1;
    for (Index col = g.cols - 1; col >= 0; --col) {
      if (std::isfinite(map.at(row, col))) last = col;
      Index& best = nearest[static_cast<std::size_t>(g.index(row, col))];
      if (last >= 0 && (best < 0 || last - col < col - best % g.cols)) best = g.index(row, last);
    }
  }
  return nearest;
}

}  // namespace

std::vector<Index> nearest_pixels(const HeightMap& map, const Progress& progress) {
  if (map.valid_pixels() == 0) throw InputError("map without any finite pixel; at least one is required");
  const Grid& g = map.grid;
  const std::vector<Index> in_row = nearest_in_row(map, progress);
  std::vector<Index> nearest(in_row.size());
  std::vector<double> squared(static_cast<std::size_t>(g.rows));
  LowerEnvelope envelope(g.rows, g.pitch_y);
  for (Index col = 0; col < g.cols; ++col) {
    progress.check();
    const auto candidate = [&](std::size_t row) {
      return in_row[static_cast<std::size_t>(g.index(static_cast<Index>(row), col))];
    };
    for (std::size_t row = 0; row < squared.size(); ++row) {
      const Index pixel = candidate(row);
      const double dx = g.pitch_x * static_cast<double>(pixel % g.cols - col);
      squared[row] = pixel < 0 ? std::numeric_limits<double>::infinity() : dx * dx;
    }
    envelope(squared, [&](std::size_t row, double, std::size_t from) {
      nearest[static_cast<std::size_t>(g.index(static_cast<Index>(row), col))] = candidate(from);
    });
  }
  return nearest;
}

}  // namespace dwell
