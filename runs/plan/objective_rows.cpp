#include "runs/plan/objective_rows.h"

#include <cmath>
#include <numbers>

#include "core/form/form.h"
#include "runs/plan/usual_smoothness.h"

namespace dwell {
namespace {

/// Roots of the weights of slopes [first, first + count), scaled so that their squares sum to `whole`.
void weigh_slopes(const SurfaceRows& rows, const std::vector<double>& roots, Index first, Index count, double whole,
                  Vector& weights) {
  if (count == 0) return;
  auto stretch = weights.segment(rows.heights() + first, count);
  for (Index k = 0; k < count; ++k) {
    const auto [a, b] = rows.pair(first + k);
    const double u = roots.empty() ? 1.0 : roots[static_cast<std::size_t>(a)],
                 v = roots.empty() ? 1.0 : roots[static_cast<std::size_t>(b)];
    stretch[k] = std::sqrt(0.5 * (u * u + v * v));
  }
  stretch *= std::sqrt(whole / stretch.squaredNorm());
}

/// Columns that are dependent on those before them, or zero, are dropped.
Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& columns, double least_norm) {
  constexpr double kDependent = 1e-8;
  Eigen::MatrixXd q(columns.rows(), columns.cols());
  Index rank = 0;
  for (Index k = 0; k < columns.cols(); ++k) {
    Vector v = columns.col(k);
    const double before = v.norm();
    if (!(before > least_norm)) continue;
    for (int pass = 0; pass < 2; ++pass) v -= q.leftCols(rank) * (q.leftCols(rank).transpose() * v);
    const double norm = v.norm();
    if (norm > kDependent * before) q.col(rank++) = v / norm;
  }
  return q.leftCols(rank);
}

}  // namespace

double slope_length(const Part& part) { return kHalfHeldWave * equivalent_fwhm(part) / (2.0 * std::numbers::pi); }

double slope_length(const Part& part, const FitObjective& objective) {
  return objective.length ? *objective.length : slope_length(part);
}

ObjectiveRows objective_rows(const Part& part, const std::vector<Index>& pixels, const std::vector<double>& roots,
                             const FitObjective& objective) {
  const Grid& grid = part.map.grid;
  const double share = objective.slope_share, length = slope_length(part, objective);
  ObjectiveRows result;
  result.rows = std::make_shared<const SurfaceRows>(grid, pixels, share < 1.0);
  const SurfaceRows& rows = *result.rows;
  result.weights.resize(rows.rows());
  for (Index i = 0; i < rows.heights(); ++i) {
    result.weights[i] = std::sqrt(1.0 - share) * (roots.empty() ? 1.0 : roots[static_cast<std::size_t>(i)]);
  }
  const double whole = share * length * length * static_cast<double>(pixels.size());
  weigh_slopes(rows, roots, 0, rows.pairs_x(), whole, result.weights);
  weigh_slopes(rows, roots, rows.pairs_x(), rows.pairs_y(), whole, result.weights);
  const Eigen::MatrixXd terms = form_basis(grid, pixels, part.form, {}, part.threads);
  Eigen::MatrixXd columns(rows.rows(), terms.cols());
  Vector row;
  for (Index k = 0; k < terms.cols(); ++k) {
    rows.apply(terms.col(k), row);
    columns.col(k) = row.cwiseProduct(result.weights);
  }
  // The slope of a piston is rounding, held against that of one pixel alone.
  constexpr double kRounding = 1e-10;
  result.form = orthonormal_columns(columns, kRounding * (1.0 + length / std::min(grid.pitch_x, grid.pitch_y)));
  return result;
}

}  // namespace dwell
