#pragma once

#include <Eigen/Core>

#include <vector>

#include "core/base/grid.h"
#include "core/form/form_terms.h"

namespace dwell {

/// Basis of the form terms on the given pixels, orthonormal in the weighted sense: with w the weights (empty = all
/// one), B = diag(w) [1, x, y, x^2 + y^2, x^2 - y^2, 2 x y restricted to `terms`] and the result Q has orthonormal
/// columns spanning B. Columns that are dependent on these pixels (one pixel, one row) are dropped. Size pixels.size()
/// x (0..6). Cost O(pixels).
Eigen::MatrixXd form_basis(const Grid& grid, const std::vector<Index>& pixels, const FormTerms& terms,
                           const std::vector<double>& weights = {}, int threads = 1);

/// v - Q (Q' v), twice, in place: removes the form terms to rounding. v has one value a pixel of the basis.
void remove_form(const Eigen::MatrixXd& basis, Eigen::Ref<Eigen::VectorXd> v);

}  // namespace dwell
