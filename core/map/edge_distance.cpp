#include "core/map/edge_distance.h"

#include <algorithm>
#include <cmath>

#include "core/numerics/lower_envelope.h"

namespace dwell {
namespace {

/// Squared distance along its row from every pixel to the nearest missing one; the map is surrounded by missing ones.
void square_in_rows(const HeightMap& map, std::vector<double>& square, int threads) {
  const Grid& g = map.grid;
#pragma omp parallel for num_threads(std::max(threads, 1)) schedule(static)
  for (Index row = 0; row < g.rows; ++row) {
    Index steps = 0;
    for (Index col = 0; col < g.cols; ++col) {
      steps = std::isfinite(map.at(row, col)) ? steps + 1 : 0;
      const double d = g.pitch_x * static_cast<double>(steps);
      square[static_cast<std::size_t>(g.index(row, col))] = d * d;
    }
    steps = 0;
    for (Index col = g.cols - 1; col >= 0; --col) {
      steps = std::isfinite(map.at(row, col)) ? steps + 1 : 0;
      const double d = g.pitch_x * static_cast<double>(steps);
      double& s = square[static_cast<std::size_t>(g.index(row, col))];
      s = std::min(s, d * d);
    }
  }
}

}  // namespace

std::vector<double> edge_distances(const HeightMap& map, int threads) {
  const Grid& g = map.grid;
  std::vector<double> distance(static_cast<std::size_t>(g.size()));
  square_in_rows(map, distance, threads);
  constexpr Index kTogether = 8;  // columns: one cache line of a row
  const auto rows = static_cast<std::size_t>(g.rows + 2);
#pragma omp parallel num_threads(std::max(threads, 1))
  {
    LowerEnvelope envelope(g.rows + 2, g.pitch_y);
    std::vector<std::vector<double>> f(kTogether, std::vector<double>(rows, 0.0));  // missing above and below
    std::vector<double> best(rows);
#pragma omp for schedule(static)
    for (Index first = 0; first < g.cols; first += kTogether) {
      const Index count = std::min(kTogether, g.cols - first);
      for (Index row = 0; row < g.rows; ++row) {
        const double* from = distance.data() + g.index(row, first);
        for (Index k = 0; k < count; ++k) f[static_cast<std::size_t>(k)][static_cast<std::size_t>(row + 1)] = from[k];
      }
      for (Index k = 0; k < count; ++k) {
        envelope(f[static_cast<std::size_t>(k)],
                 [&best](std::size_t row, double squared, std::size_t) { best[row] = squared; });
        f[static_cast<std::size_t>(k)] = best;
      }
      for (Index row = 0; row < g.rows; ++row) {
        double* to = distance.data() + g.index(row, first);
        for (Index k = 0; k < count; ++k) {
          to[k] = std::sqrt(f[static_cast<std::size_t>(k)][static_cast<std::size_t>(row + 1)]);
        }
      }
      for (auto& column : f) column.front() = column.back() = 0.0;
    }
  }
  return distance;
}

}  // namespace dwell
