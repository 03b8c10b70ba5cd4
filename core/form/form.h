#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "core/base/grid.h"

namespace dwell {

/// Form terms that a specification does not count: piston (constant), tilt (x and y), power (x^2 + y^2), astigmatism
/// (x^2 - y^2 and 2 x y).
struct FormTerms {
  bool piston = false;
  bool tilt = false;
  bool power = false;
  bool astigmatism = false;

  bool any() const { return piston || tilt || power || astigmatism; }
  friend bool operator==(const FormTerms&, const FormTerms&) = default;
};

/// Parses "piston,tilt,power,astigmatism" in any order, some of them, or "none". Throws InputError naming the unknown
/// word and the accepted ones.
FormTerms parse_form_terms(const std::string& text);
std::string to_string(const FormTerms& terms);  // "piston,tilt", or "none"

/// Basis of the form terms on the given pixels, orthonormal in the weighted sense: with w the weights (empty = all
/// one), B = diag(w) [1, x, y, x^2 + y^2, x^2 - y^2, 2 x y restricted to `terms`] and the result Q has orthonormal
/// columns spanning B. Columns that are dependent on these pixels (one pixel, one row) are dropped. Size pixels.size()
/// x (0..6). Cost O(pixels).
Eigen::MatrixXd form_basis(const Grid& grid, const std::vector<Index>& pixels, const FormTerms& terms,
                           const std::vector<double>& weights = {}, int threads = 1);

/// v - Q (Q' v), twice, in place: removes the form terms to rounding. v has one value a pixel of the basis.
void remove_form(const Eigen::MatrixXd& basis, Eigen::Ref<Eigen::VectorXd> v);

}  // namespace dwell
