#pragma once

#include <string>
#include <vector>

#include "core/form/polynomial_basis.h"

namespace dwell {

struct PolynomialTerm {
  std::string name;
  double coefficient = 0.0;  // of the named polynomial [nm]; 0 if dropped
  /// Its coefficient once the terms are orthonormalised on the valid pixels in this order [nm]: the RMS of what it adds
  /// to those before it, signed. The squares add up to the mean square of the form.
  double contribution = 0.0;
  bool dropped = false;  // depends on the terms before it on these pixels
};

/// The least-squares form of a map.
struct PolynomialFit {
  PolynomialDomain domain;
  std::string normalisation;
  std::vector<PolynomialTerm> terms;
  /// Of the terms kept, each scaled to one size: largest over smallest singular value of the matrix pixels x terms. 1
  /// where they are orthogonal on these pixels; where it is large, a coefficient depends on what else was fitted.
  double condition = 1.0;
  Index pixels = 0;
};

/// Takes the least-squares form out of the map's finite pixels (all others stay) and says what it was. A term is
/// dropped if the terms before it account for all of it on these pixels but 1e-6 of its RMS.
///
/// The polynomials are expanded in products of Chebyshev polynomials, whose inner products over the valid pixels follow
/// from few sums (core/numerics/chebyshev_sums.h), and orthonormalised there; a second step on the residual takes out
/// what rounding has left (corrected seminormal equations, Bjorck 1987, Linear Algebra Appl. 88/89, 31). The same for
/// any number of threads. Cost O(pixels * degree); the basis is never held. Throws InputError if the map has no finite
/// pixel.
PolynomialFit remove_polynomials(HeightMap& map, const PolynomialSpec& spec, int threads = 1);

}  // namespace dwell
