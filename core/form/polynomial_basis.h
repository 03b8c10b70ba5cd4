#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/form/polynomial_spec.h"
#include "core/map/height_map.h"

namespace dwell {

/// The area of a map on which the polynomials of a spec are defined [mm].
struct PolynomialDomain {
  Point centre;                                   // of the circle: Zernike and form terms
  double radius = 1.0;                            // outer radius of the circle
  double x0 = 0.0, x1 = 1.0, y0 = 0.0, y1 = 1.0;  // rectangle of the valid pixels' outer edges
};

/// One polynomial by name, a function of the place [mm].
struct NamedPolynomial {
  std::string name;  // "Z4 defocus", "L2(x) L0(y)", "tilt x"
  std::function<double(Point)> value;
};

/// The polynomials of a spec on the valid pixels of a map.
///   Form terms   1, x, y, x^2 + y^2, x^2 - y^2, 2 x y about the centroid of the valid pixels, in units of the distance
///                to the farthest one: unit edge value
///   Zernike      on the circle of the spec; Noll and ANSI of unit RMS over it, Fringe of unit edge value
///   Legendre     sqrt((2 i + 1) (2 j + 1)) P_i P_j: unit RMS over the rectangle
///   Chebyshev    T_i T_j: unit edge value
struct PolynomialBasis {
  PolynomialDomain domain;
  std::vector<NamedPolynomial> polynomials;
  std::string normalisation;                         // "unit RMS" or "unit edge value", with what it is over
  int degree_x = 0, degree_y = 0, degree_total = 0;  // largest of them, along each axis and together
};

/// Throws InputError if the map has no valid pixel. Cost O(pixels) for the domain.
PolynomialBasis polynomial_basis(const HeightMap& map, const PolynomialSpec& spec);

}  // namespace dwell
