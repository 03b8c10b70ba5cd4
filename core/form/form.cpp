#include "core/form/form.h"

#include <fmt/format.h>

#include <stdexcept>

#include "core/base/counted.h"
#include "core/form/form_polynomials.h"

namespace dwell {

Eigen::MatrixXd form_basis(const Grid& grid, const std::vector<Index>& pixels, const FormTerms& terms,
                           const std::vector<double>& weights, int threads) {
  if (!weights.empty() && weights.size() != pixels.size()) {
    throw std::invalid_argument(fmt::format("form_basis: {} weights for {}; one a pixel, or none", weights.size(),
                                            counted(pixels.size(), "pixel")));
  }
  return FormPolynomials(grid, pixels, terms, weights, threads).columns();
}

void remove_form(const Eigen::MatrixXd& basis, Eigen::Ref<Eigen::VectorXd> v) {
  // Twice is enough (Giraud et al. 2005): the second pass takes out what rounding in the first left behind.
  for (int pass = 0; pass < 2; ++pass) v -= basis * (basis.transpose() * v);
}

}  // namespace dwell
