#include "core/motion/program_frame.h"

#include <cmath>
#include <numbers>

namespace dwell {
namespace {

constexpr double kFullTurn = 360.0, kQuarter = 90.0;

/// Cosine and sine of an angle in degrees, exact for whole quarters of a turn.
Point unit_vector(double degrees) {
  const double rest = std::remainder(degrees, kFullTurn);  // exact, from -180 to 180
  if (rest == 0.0) return {1.0, 0.0};
  if (rest == kQuarter) return {0.0, 1.0};
  if (rest == -kQuarter) return {0.0, -1.0};
  if (std::abs(rest) == 2.0 * kQuarter) return {-1.0, 0.0};
  const double angle = rest * std::numbers::pi / (2.0 * kQuarter);
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

ProgramFrame::ProgramFrame(Point zero, double degrees, bool swapped)
    : zero_(zero), degrees_(degrees), swapped_(swapped) {
  const Point direction = unit_vector(degrees);
  cos_ = direction.x;
  sin_ = direction.y;
}

Point ProgramFrame::direction_to_program(Point part) const {
  const Point turned{cos_ * part.x - sin_ * part.y, sin_ * part.x + cos_ * part.y};
  return swapped_ ? Point{turned.y, turned.x} : turned;
}

Point ProgramFrame::to_program(Point part) const { return is_of_part() ? part : direction_to_program(part - zero_); }

Point ProgramFrame::to_part(Point program) const {
  if (is_of_part()) return program;
  const Point turned = swapped_ ? Point{program.y, program.x} : program;
  return zero_ + Point{cos_ * turned.x + sin_ * turned.y, cos_ * turned.y - sin_ * turned.x};
}

}  // namespace dwell
