#include "core/numerics/spline_sampling.h"

#include <algorithm>
#include <stdexcept>

#include "core/numerics/bspline.h"

namespace dwell {
namespace {

std::vector<std::array<double, 4>> weights_by_phase(Index factor) {
  std::vector<std::array<double, 4>> weights;
  for (Index k = 0; k < factor; ++k)
    weights.push_back(bspline_weights(static_cast<double>(k) / static_cast<double>(factor)));
  return weights;
}

}  // namespace

Grid SplineSampling::lattice_of(const Grid& map, CoarseFactor factor) {
  Grid lattice;
  lattice.rows = (map.rows - 1) / factor.y + 4;
  lattice.cols = (map.cols - 1) / factor.x + 4;
  lattice.pitch_x = map.pitch_x * static_cast<double>(factor.x);
  lattice.pitch_y = map.pitch_y * static_cast<double>(factor.y);
  lattice.origin = map.origin - Point{lattice.pitch_x, lattice.pitch_y};
  return lattice;
}

SplineSampling::SplineSampling(const Grid& map, CoarseFactor factor, int threads)
    : map_(map),
      lattice_(lattice_of(map, factor)),
      factor_(factor),
      along_x_(weights_by_phase(factor.x)),
      along_y_(weights_by_phase(factor.y)),
      threads_(std::max(threads, 1)) {}

/// Shares the pixels out to threads, whole rows of the map and about equally many pixels; returns to how many.
int SplineSampling::share_out(const std::vector<Index>& pixels) {
  constexpr std::size_t kWorthSharing = 1 << 16;
  const std::size_t count = pixels.size() < kWorthSharing ? 1 : static_cast<std::size_t>(threads_);
  begins_.assign(1, 0);
  for (std::size_t k = 1; k < count; ++k) {
    const Index row = pixels[k * pixels.size() / count] / map_.cols;
    const auto first = std::lower_bound(pixels.begin(), pixels.end(), row * map_.cols);
    begins_.push_back(std::max(begins_.back(), static_cast<std::size_t>(first - pixels.begin())));
  }
  begins_.push_back(pixels.size());
  return static_cast<int>(count);
}

void SplineSampling::sample(const Eigen::VectorXd& nodes, const std::vector<Index>& pixels, Eigen::VectorXd& values) {
  if (nodes.size() != lattice_.size()) throw std::invalid_argument("SplineSampling: one value a node is required");
  values.resize(static_cast<Index>(pixels.size()));
  const int count = share_out(pixels);
  if (lines_.size() < static_cast<std::size_t>(count))
    lines_.resize(static_cast<std::size_t>(count), std::vector<double>(static_cast<std::size_t>(lattice_.cols)));
#pragma omp parallel for num_threads(count) schedule(static, 1)
  for (int k = 0; k < count; ++k) {
    const auto share = static_cast<std::size_t>(k);
    sample_range(nodes.data(), pixels, begins_[share], begins_[share + 1], values.data(), lines_[share]);
  }
}

// Along y once for a row of nodes, then along x for every pixel.
void SplineSampling::sample_range(const double* nodes, const std::vector<Index>& pixels, std::size_t begin,
                                  std::size_t end, double* values, std::vector<double>& line) const {
  for (std::size_t i = begin; i < end;) {
    const Index row = pixels[i] / map_.cols, row_end = (row + 1) * map_.cols;
    const auto& y = along_y_[static_cast<std::size_t>(row % factor_.y)];
    const double* from = nodes + row / factor_.y * lattice_.cols;
    for (Index c = 0; c < lattice_.cols; ++c) {
      line[static_cast<std::size_t>(c)] = y[0] * from[c] + y[1] * from[lattice_.cols + c] +
                                          y[2] * from[2 * lattice_.cols + c] + y[3] * from[3 * lattice_.cols + c];
    }
    while (i < end && pixels[i] < row_end) {
      const Index cell = (pixels[i] - row * map_.cols) / factor_.x, first = row * map_.cols + cell * factor_.x;
      const Index cell_end = std::min(first + factor_.x, row_end);
      const double* at = line.data() + cell;
      for (; i < end && pixels[i] < cell_end; ++i) {
        const auto& x = along_x_[static_cast<std::size_t>(pixels[i] - first)];
        values[i] = x[0] * at[0] + x[1] * at[1] + x[2] * at[2] + x[3] * at[3];
      }
    }
  }
}

void SplineSampling::spread(const std::vector<Index>& pixels, const Eigen::VectorXd& values, Eigen::VectorXd& nodes) {
  if (values.size() != static_cast<Index>(pixels.size()))
    throw std::invalid_argument("SplineSampling: one value a pixel is required");
  nodes.setZero(lattice_.size());
  const int count = share_out(pixels);
  partial_.resize(static_cast<std::size_t>(count - 1));
  for (Eigen::VectorXd& p : partial_) p.setZero(lattice_.size());
#pragma omp parallel for num_threads(count) schedule(static, 1)
  for (int k = 0; k < count; ++k) {
    const auto share = static_cast<std::size_t>(k);
    spread_range(pixels, values.data(), begins_[share], begins_[share + 1],
                 k == 0 ? nodes.data() : partial_[share - 1].data());
  }
  for (const Eigen::VectorXd& p : partial_) nodes += p;
}

void SplineSampling::spread_range(const std::vector<Index>& pixels, const double* values, std::size_t begin,
                                  std::size_t end, double* nodes) const {
  for (std::size_t i = begin; i < end;) {
    const Index row = pixels[i] / map_.cols, cell = (pixels[i] - row * map_.cols) / factor_.x,
                first = row * map_.cols + cell * factor_.x,
                cell_end = std::min(first + factor_.x, (row + 1) * map_.cols);
    std::array<double, 4> sum{};
    for (; i < end && pixels[i] < cell_end; ++i) {
      const auto& x = along_x_[static_cast<std::size_t>(pixels[i] - first)];
      for (std::size_t k = 0; k < 4; ++k) sum[k] += x[k] * values[i];
    }
    const auto& y = along_y_[static_cast<std::size_t>(row % factor_.y)];
    for (std::size_t j = 0; j < 4; ++j) {
      double* to = nodes + (row / factor_.y + static_cast<Index>(j)) * lattice_.cols + cell;
      for (std::size_t k = 0; k < 4; ++k) to[k] += y[j] * sum[k];
    }
  }
}

}  // namespace dwell
