#pragma once

#include <string>
#include <vector>

namespace dwell {

/// How Zernike polynomials are numbered. Angles run from the +x axis towards +y; cosine terms have m > 0, sine m < 0.
///   Noll    1..120, R. J. Noll 1976, J. Opt. Soc. Am. 66, 207, table I: even numbers are the cosines
///   Fringe  1..37, the University of Arizona set (Wyant and Creath 1992, table III): by n + |m|; 37 is the
///           spherical one of degree 12
///   Ansi    0..119, ANSI Z80.28 and ISO 24157: number (n (n + 2) + m) / 2
enum class ZernikeOrdering { Noll, Fringe, Ansi };

std::string to_string(ZernikeOrdering ordering);  // "noll", "fringe", "ansi"
int first_zernike(ZernikeOrdering ordering);
int last_zernike(ZernikeOrdering ordering);

/// Degree n >= 0 and azimuthal frequency m, |m| <= n, n - |m| even.
struct ZernikeIndex {
  int n = 0;
  int m = 0;

  friend bool operator==(const ZernikeIndex&, const ZernikeIndex&) = default;
};

/// Throws std::invalid_argument unless first_zernike <= number <= last_zernike.
ZernikeIndex zernike_index(ZernikeOrdering ordering, int number);

/// "defocus", "coma x" (along x), "astigmatism 45", ... as interferometrists say it; from degree 6 on "(n, m)".
std::string zernike_name(ZernikeIndex index);

/// One Zernike polynomial on the annulus obscuration <= rho <= 1; with no obscuration the circle polynomial.
///   cosine  N R(rho) cos(m theta),   sine  N R(rho) sin(|m| theta)
/// R = rho^|m| P(rho^2) with P the polynomials orthogonal on [obscuration^2, 1] with weight t^|m| (V. N. Mahajan 1981,
/// J. Opt. Soc. Am. 71, 75), so that all of them are orthogonal over the annulus, whichever are used.
class Zernike {
 public:
  enum class Normalisation {
    UnitRms,  // mean square over the annulus is 1 (Noll, ANSI)
    UnitEdge  // R(1) = 1 (Fringe)
  };

  /// Throws std::invalid_argument unless 0 <= obscuration < 1 and the index is one.
  Zernike(ZernikeIndex index, double obscuration, Normalisation normalisation);

  /// At (x, y) in units of the outer radius. Cost O(n).
  double operator()(double x, double y) const;

 private:
  ZernikeIndex index_;
  double scale_;
  std::vector<double> alpha_, beta_;  // P_(k+1)(t) = (t - alpha_k) P_k(t) - beta_k P_(k-1)(t)

  double radial(double t) const;
};

}  // namespace dwell
