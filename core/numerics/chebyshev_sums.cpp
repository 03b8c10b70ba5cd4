#include "core/numerics/chebyshev_sums.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

namespace dwell {
namespace {

/// T_0..T_degree at the middle of each of `count` pixels between -1 and 1; a row a degree.
Eigen::MatrixXd chebyshev_table(int degree, Index count) {
  Eigen::MatrixXd table(degree + 1, count);
  for (Index c = 0; c < count; ++c) {
    const double x = (2.0 * static_cast<double>(c) + 1.0) / static_cast<double>(count) - 1.0;
    table(0, c) = 1.0;
    if (degree > 0) table(1, c) = x;
    for (int a = 2; a <= degree; ++a) table(a, c) = 2.0 * x * table(a - 1, c) - table(a - 2, c);
  }
  return table;
}

double dot(const double* a, const double* b, Index count) {
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (Index c = 0; c < count; ++c) sum += a[c] * b[c];
  return sum;
}

/// Copies a row with zeros for what is not finite, and makes its mask. Returns how many values are finite.
Index fill_row(const double* row, Index count, double* filled, double* mask) {
  double valid = 0.0;
#pragma omp simd reduction(+ : valid)
  for (Index c = 0; c < count; ++c) {
    const bool finite = std::isfinite(row[c]);
    mask[c] = finite ? 1.0 : 0.0;
    filled[c] = finite ? row[c] : 0.0;
    valid += mask[c];
  }
  return static_cast<Index>(valid);
}

}  // namespace

ChebyshevSums::ChebyshevSums(const Grid& grid, Index row0, Index col0, Index rows, Index cols, int degree_x,
                             int degree_y, int degree_total, int threads)
    : grid_(grid),
      row0_(row0),
      col0_(col0),
      rows_(rows),
      cols_(cols),
      degree_x_(degree_x),
      degree_y_(degree_y),
      threads_(std::max(threads, 1)) {
  if (row0 < 0 || col0 < 0 || rows < 1 || cols < 1 || row0 + rows > grid.rows || col0 + cols > grid.cols ||
      degree_x < 0 || degree_y < 0 || degree_total < 0) {
    throw std::invalid_argument("ChebyshevSums: rectangle outside the grid or negative degree");
  }
  for (int sum = 0; sum <= std::min(degree_total, degree_x + degree_y); ++sum) {
    for (int j = std::max(0, sum - degree_x); j <= std::min(sum, degree_y); ++j) products_.emplace_back(sum - j, j);
  }
  along_x_ = chebyshev_table(2 * degree_x, cols);
  along_y_ = chebyshev_table(2 * degree_y, rows).transpose();
}

void ChebyshevSums::project_row(const double* filled, double* out) const {
  for (int i = 0; i <= degree_x_; ++i) out[i] = dot(filled, along_x_.row(i).data(), cols_);
}

ChebyshevSums::Sums ChebyshevSums::sum(std::span<const double> values, bool with_gram) const {
  const Index projections = degree_x_ + 1, moments = with_gram ? 2 * degree_x_ + 1 : 0;
  std::vector<double> projection(static_cast<std::size_t>(rows_ * projections));
  std::vector<double> moment(static_cast<std::size_t>(rows_ * moments));
  std::vector<double> full(static_cast<std::size_t>(moments));  // of a row without holes
  for (Index a = 0; a < moments; ++a) full[static_cast<std::size_t>(a)] = along_x_.row(a).sum();
  Index pixels = 0;
#pragma omp parallel num_threads(threads_) reduction(+ : pixels)
  {
    std::vector<double> filled(static_cast<std::size_t>(cols_)), mask(filled.size());
#pragma omp for schedule(static)
    for (Index r = 0; r < rows_; ++r) {
      const double* row = values.data() + grid_.index(row0_ + r, col0_);
      const Index valid = fill_row(row, cols_, filled.data(), mask.data());
      pixels += valid;
      project_row(filled.data(), projection.data() + r * projections);
      double* out = moment.data() + r * moments;
      for (Index a = 0; a < moments && valid > 0; ++a) {
        out[a] = valid == cols_ ? full[static_cast<std::size_t>(a)] : dot(mask.data(), along_x_.row(a).data(), cols_);
      }
    }
  }
  return {pixels, with_gram ? gram_of(moment) : Eigen::MatrixXd(), fold_projections(projection)};
}

Eigen::VectorXd ChebyshevSums::fold_projections(const std::vector<double>& of_rows) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Index>(products_.size()));
  for (Index r = 0; r < rows_; ++r) {
    const double* row = of_rows.data() + r * (degree_x_ + 1);
    for (std::size_t k = 0; k < products_.size(); ++k) {
      result[static_cast<Index>(k)] += row[products_[k].first] * along_y_(r, products_[k].second);
    }
  }
  return result;
}

Eigen::MatrixXd ChebyshevSums::gram_of(const std::vector<double>& moment_of_rows) const {
  const Index across = 2 * degree_x_ + 1, up = 2 * degree_y_ + 1;
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(across, up);
  for (Index r = 0; r < rows_; ++r) {
    const double* row = moment_of_rows.data() + r * across;
    for (Index b = 0; b < up; ++b) {
      for (Index a = 0; a < across; ++a) moments(a, b) += row[a] * along_y_(r, b);
    }
  }
  const auto count = static_cast<Index>(products_.size());
  Eigen::MatrixXd gram(count, count);
  for (Index k = 0; k < count; ++k) {
    const auto [i, j] = products_[static_cast<std::size_t>(k)];
    for (Index l = 0; l <= k; ++l) {
      const auto [p, q] = products_[static_cast<std::size_t>(l)];
      const int low_x = std::abs(i - p), low_y = std::abs(j - q);
      gram(k, l) = gram(l, k) =
          0.25 * (moments(i + p, j + q) + moments(low_x, j + q) + moments(i + p, low_y) + moments(low_x, low_y));
    }
  }
  return gram;
}

Eigen::VectorXd ChebyshevSums::subtract(const Eigen::VectorXd& coefficients, std::span<double> values) const {
  const Index projections = degree_x_ + 1;
  std::vector<double> projection(static_cast<std::size_t>(rows_ * projections));
#pragma omp parallel num_threads(threads_)
  {
    std::vector<double> filled(static_cast<std::size_t>(cols_)), mask(filled.size()), form(filled.size());
    std::vector<double> in_row(static_cast<std::size_t>(projections));  // coefficients of T_i(x) in this row
#pragma omp for schedule(static)
    for (Index r = 0; r < rows_; ++r) {
      double* row = values.data() + grid_.index(row0_ + r, col0_);
      std::fill(in_row.begin(), in_row.end(), 0.0);
      for (std::size_t k = 0; k < products_.size(); ++k) {
        in_row[static_cast<std::size_t>(products_[k].first)] +=
            coefficients[static_cast<Index>(k)] * along_y_(r, products_[k].second);
      }
      std::fill(form.begin(), form.end(), 0.0);
      double* const sum = form.data();
      for (Index i = 0; i < projections; ++i) {
        const double c = in_row[static_cast<std::size_t>(i)];
        const double* const t = along_x_.row(i).data();
#pragma omp simd
        for (Index col = 0; col < cols_; ++col) sum[col] += c * t[col];
      }
#pragma omp simd
      for (Index col = 0; col < cols_; ++col) row[col] -= sum[col];
      fill_row(row, cols_, filled.data(), mask.data());
      project_row(filled.data(), projection.data() + r * projections);
    }
  }
  return fold_projections(projection);
}

double ChebyshevSums::node(int k, int degree) const { return std::cos(std::numbers::pi * (k + 0.5) / (degree + 1)); }

Eigen::VectorXd ChebyshevSums::expand_samples(const Eigen::MatrixXd& samples) const {
  // c_i = (2 - delta_i0) / (n + 1) sum_k f(x_k) cos(i (k + 1/2) pi / (n + 1)), along both axes.
  const auto transform = [](int degree) {
    Eigen::MatrixXd t(degree + 1, degree + 1);
    for (int i = 0; i <= degree; ++i) {
      for (int k = 0; k <= degree; ++k) {
        t(i, k) = (i == 0 ? 1.0 : 2.0) / (degree + 1) * std::cos(std::numbers::pi * i * (k + 0.5) / (degree + 1));
      }
    }
    return t;
  };
  const Eigen::MatrixXd all = transform(degree_x_) * samples * transform(degree_y_).transpose();
  Eigen::VectorXd result(static_cast<Index>(products_.size()));
  for (std::size_t k = 0; k < products_.size(); ++k) {
    result[static_cast<Index>(k)] = all(products_[k].first, products_[k].second);
  }
  return result;
}

}  // namespace dwell
