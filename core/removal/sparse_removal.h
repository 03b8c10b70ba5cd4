#pragma once

#include <Eigen/SparseCore>

#include <functional>
#include <vector>

#include "core/motion/tool_path.h"
#include "core/removal/removal_operator.h"
#include "core/tif/removal_kernel.h"

namespace dwell {

/// Removal as an explicit sparse matrix. For removal functions that depend on position (edges, curvature), for small
/// problems, and for tests. Cost of a call and memory: proportional to the number of non-zeros, which is about the
/// number of pixels under the removal function times the strokes.
class SparseRemoval final : public RemovalOperator {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, Index>;

  SparseRemoval(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                const std::vector<Stroke>& strokes, int threads);
  /// kernel_at(j): the removal function of stroke j; it must stay alive during construction only.
  SparseRemoval(const Grid& map, const std::vector<Index>& pixels,
                const std::function<const RemovalKernel&(std::size_t)>& kernel_at, const std::vector<Stroke>& strokes,
                int threads);
  /// Any m x n matrix.
  SparseRemoval(Matrix matrix, int threads);

  const Matrix& matrix() const { return a_; }
  std::string name() const override { return "sparse"; }

 private:
  void do_apply(const Vector& t, Vector& removal) override;
  void do_apply_adjoint(const Vector& residual, Vector& t) override;

  Matrix a_;
  Matrix transposed_;  // row sums both ways: no races, and one order of summation
  int threads_;
};

}  // namespace dwell
