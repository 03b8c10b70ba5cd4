#include "core/removal/sparse_removal.h"

#include "core/motion/stroke_quadrature.h"
#include "core/motion/touched_pixels.h"

namespace dwell {
namespace {

/// Appends column j: the average rate of the stroke at every pixel it reaches. row_of[pixel] is -1 outside.
void append_column(const Grid& map, const std::vector<Index>& row_of, const RemovalKernel& kernel, const Stroke& s,
                   Index j, std::vector<QuadraturePoint>& points, std::vector<Eigen::Triplet<double, Index>>& entries) {
  points.clear();
  const auto beyond_x = static_cast<double>(kernel.half_cols + 2), beyond_y = static_cast<double>(kernel.half_rows + 2);
  const LatticeBox near{-beyond_x, static_cast<double>(map.cols - 1) + beyond_x, -beyond_y,
                        static_cast<double>(map.rows - 1) + beyond_y};
  append_stroke_quadrature(s, map, near, points);
  const Point reach{map.pitch_x * static_cast<double>(kernel.half_cols + 2),
                    map.pitch_y * static_cast<double>(kernel.half_rows + 2)};
  const PixelRange range = touched_pixels(map, s, -1.0 * reach, reach);
  for (Index r = range.first_row; r <= range.last_row; ++r) {
    for (Index c = range.first_col; c <= range.last_col; ++c) {
      const Index row = row_of[static_cast<std::size_t>(map.index(r, c))];
      if (row < 0) continue;
      double sum = 0.0;
      for (const QuadraturePoint& q : points) sum += q.weight * kernel.rate(map.centre(r, c) - q.position);
      if (sum != 0.0) entries.emplace_back(row, j, sum);
    }
  }
}

void multiply(const SparseRemoval::Matrix& a, const Vector& x, Vector& y, int threads) {
  const Index rows = a.rows();
  const auto* begin = a.outerIndexPtr();
  const auto* index = a.innerIndexPtr();
  const double* value = a.valuePtr();
#pragma omp parallel for num_threads(threads) schedule(static)
  for (Index i = 0; i < rows; ++i) {
    double sum = 0.0;
    for (Index k = begin[i]; k < begin[i + 1]; ++k) sum += value[k] * x[index[k]];
    y[i] = sum;
  }
}

}  // namespace

SparseRemoval::SparseRemoval(Matrix matrix, int threads)
    : RemovalOperator(matrix.rows(), matrix.cols()), threads_(threads) {
  a_.swap(matrix);
  a_.makeCompressed();
  transposed_ = a_.transpose();
  transposed_.makeCompressed();
}

SparseRemoval::SparseRemoval(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                             const std::vector<Stroke>& strokes, int threads)
    : SparseRemoval(
          map, pixels, [&kernel](std::size_t) -> const RemovalKernel& { return kernel; }, strokes, threads) {}

SparseRemoval::SparseRemoval(const Grid& map, const std::vector<Index>& pixels,
                             const std::function<const RemovalKernel&(std::size_t)>& kernel_at,
                             const std::vector<Stroke>& strokes, int threads)
    : SparseRemoval(
          [&] {
            std::vector<Index> row_of(static_cast<std::size_t>(map.size()), -1);
            for (std::size_t i = 0; i < pixels.size(); ++i)
              row_of[static_cast<std::size_t>(pixels[i])] = static_cast<Index>(i);
            std::vector<Eigen::Triplet<double, Index>> entries;
            std::vector<QuadraturePoint> points;
            for (std::size_t j = 0; j < strokes.size(); ++j) {
              append_column(map, row_of, kernel_at(j), strokes[j], static_cast<Index>(j), points, entries);
            }
            Matrix a(static_cast<Index>(pixels.size()), static_cast<Index>(strokes.size()));
            a.setFromTriplets(entries.begin(), entries.end());
            return a;
          }(),
          threads) {}

void SparseRemoval::do_apply(const Vector& t, Vector& removal) { multiply(a_, t, removal, threads_); }
void SparseRemoval::do_apply_adjoint(const Vector& residual, Vector& t) {
  multiply(transposed_, residual, t, threads_);
}

}  // namespace dwell
