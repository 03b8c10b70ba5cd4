#pragma once

#include <vector>

namespace dwell {

/// The cubic spline through values at increasing places, "not a knot": its third derivative is continuous at the second
/// and the last but one place too, so that a cubic polynomial is reproduced exactly, up to both ends. The equations of
/// its first derivatives are those of C. de Boor, A Practical Guide to Splines (1978), chapter IV.
class CubicSpline {
 public:
  /// Throws std::invalid_argument for fewer than four places, or another number of values. Places must increase, which
  /// is the caller's to see to. Cost O(places).
  CubicSpline(std::vector<double> places, std::vector<double> values);

  /// The first derivative at every place.
  const std::vector<double>& derivatives() const { return derivatives_; }

  /// The value at a place within the first and the last one; beyond these, the outermost cubic goes on. Cost
  /// O(log places).
  double value(double place) const;

  /// The integral from the first place to every place, exact for the spline. Cost O(places).
  std::vector<double> integrals() const;

 private:
  std::vector<double> places_, values_, derivatives_;
};

}  // namespace dwell
