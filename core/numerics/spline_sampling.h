#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "core/base/coarse_factor.h"

namespace dwell {

/// Cubic B-spline surfaces on a lattice that has every factor-th line of a map, at the map's pixels, and the adjoint:
/// (S d)_i = sum_k d_k B3((x_i - x_k) / hx) B3((y_i - y_k) / hy). The lattice has a margin, so that it covers the
/// support of every pixel. Pixels are linear indices into the map, ascending. Cost about five multiply-adds a pixel.
/// The same number of threads gives the same bytes.
class SplineSampling {
 public:
  SplineSampling(const Grid& map, CoarseFactor factor, int threads);

  static Grid lattice_of(const Grid& map, CoarseFactor factor);

  const Grid& lattice() const { return lattice_; }

  /// values = S nodes, one value a pixel. Throws std::invalid_argument if nodes has not the lattice's size.
  void sample(const Eigen::VectorXd& nodes, const std::vector<Index>& pixels, Eigen::VectorXd& values);
  /// nodes = S' values. Throws std::invalid_argument if there is not one value a pixel.
  void spread(const std::vector<Index>& pixels, const Eigen::VectorXd& values, Eigen::VectorXd& nodes);

 private:
  int share_out(const std::vector<Index>& pixels);
  void sample_range(const double* nodes, const std::vector<Index>& pixels, std::size_t begin, std::size_t end,
                    double* values, std::vector<double>& line) const;
  void spread_range(const std::vector<Index>& pixels, const double* values, std::size_t begin, std::size_t end,
                    double* nodes) const;

  Grid map_, lattice_;
  CoarseFactor factor_;
  std::vector<std::array<double, 4>> along_x_, along_y_;  // weights by pixel within a coarse step
  int threads_;
  // Workspace, made at the first call: where the pixels of each thread begin, and the end of the last; a line of nodes
  // for each; sums of all threads but the first.
  std::vector<std::size_t> begins_;
  std::vector<std::vector<double>> lines_;
  std::vector<Eigen::VectorXd> partial_;
};

}  // namespace dwell
