#pragma once

#include "core/base/point.h"

namespace dwell {

/// How the coordinates of a machine program lie against those of the part. A place p of the part is in the program
///
///   q = S R (p - zero)
///
/// with R the turn by `degrees`, counter-clockwise seen from +z with x to the right and y up, and S, where `swapped`,
/// the exchange of the two axes, after the turn. So `zero` is the place of the part at the program's origin. A default
/// frame changes no bit of a place; turns by multiples of 90 degrees are exact, but for the rounding of a sum.
class ProgramFrame {
 public:
  ProgramFrame() = default;
  ProgramFrame(Point zero, double degrees, bool swapped);

  Point zero() const { return zero_; }         // [mm]
  double degrees() const { return degrees_; }  // [degrees]
  bool swapped() const { return swapped_; }
  bool is_of_part() const { return *this == ProgramFrame(); }

  Point to_program(Point part) const;
  Point to_part(Point program) const;
  /// A direction of the part, as the program's axes see it.
  Point direction_to_program(Point part) const;

  bool operator==(const ProgramFrame&) const = default;

 private:
  Point zero_;
  double degrees_ = 0.0;
  bool swapped_ = false;
  double cos_ = 1.0, sin_ = 0.0;
};

}  // namespace dwell
