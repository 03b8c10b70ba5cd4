#pragma once

#include <optional>
#include <string>

#include "core/base/point.h"
#include "core/form/form_terms.h"
#include "core/form/zernike.h"

namespace dwell {

/// Which polynomials describe or take out the form of a map.
struct PolynomialSpec {
  enum class Kind { Terms, Zernike, Legendre, Chebyshev } kind = Kind::Terms;

  FormTerms terms;  // Terms

  ZernikeOrdering ordering = ZernikeOrdering::Noll;  // Zernike: numbers first..last of this ordering
  int first = 1, last = 1;
  std::optional<Point> centre;   // of the circle [mm]; default the middle of the valid pixels' bounding box
  std::optional<double> radius;  // of the circle [mm]; default out to the farthest valid pixel's centre
  double obscuration = 0.0;      // inner over outer radius, 0 <= obscuration < 1

  int degree_x = 0, degree_y = 0;  // Legendre, Chebyshev: degree along each axis; `total`: x and y together
  bool total = true;

  bool any() const { return kind != Kind::Terms || terms.any(); }
};

/// Parses
///   piston,tilt,power,astigmatism | none                       form terms (core/form/form_terms.h)
///   zernike-noll:1-36 | zernike-fringe:1-37 | zernike-ansi:0-35  [,x=MM,y=MM][,radius=MM][,obscuration=RATIO]
///   legendre:4 | chebyshev:4       all products of total degree <= 4, the rectangle of the valid pixels on [-1, 1]^2
///   legendre:4x3 | chebyshev:4x3   all products of degree <= 4 along x and <= 3 along y
/// Throws InputError naming the text and what is accepted.
PolynomialSpec parse_polynomial_spec(const std::string& text);

/// The same in the words of the parser, without blanks.
std::string to_string(const PolynomialSpec& spec);

}  // namespace dwell
