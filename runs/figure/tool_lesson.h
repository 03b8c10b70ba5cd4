#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/base/point.h"
#include "solvers/fits/ceres_removal_registration.h"

namespace dwell {

/// What a measurement may teach about tool and machine.
enum class LessonSubject { Rate, Width, Shift, Rotation };
inline constexpr std::size_t kLessonSubjects = 4;

/// When a figure that was found is taken over.
struct LessonPolicy {
  double errors = 3.0;        // of its standard errors that a change must exceed (not the rate's: it is always taken)
  double least_shift = 0.05;  // [mm] below it is not worth moving the program
  double least_mrad = 0.5;    // likewise of rotations
  double least_rate = 0.5, most_rate = 2.0;     // what a rate changes by at most in one run
  double least_width = 0.8, most_width = 1.25;  // likewise a width
  double orientation_share = 0.25;              // of the tool's FWHM: a shift beyond it is an error of orientation
  double most_degrees = 3.0;                    // a rotation beyond it is an error of orientation as well
  /// By how much the rate is expected to change from what is known of it, as a share: a finding whose error is of this
  /// size counts half. Infinite before the first run.
  double expected_rate_change = std::numeric_limits<double>::infinity();
  std::vector<LessonSubject> taken, left;  // whatever the rule says
  std::string fixed;                       // why shift and rotation cannot be taken over; empty: they can
};

/// What became of one figure.
struct LessonDecision {
  LessonSubject subject = LessonSubject::Rate;
  Estimate found;          // rate and width over what was thought; shift [mm], its size; rotation [mrad]
  double threshold = 0.0;  // that the change had to exceed, in the same unit
  bool applied = false;
  bool overridden = false;  // applied or left because the user said so
  bool clipped = false;
  double used = 0.0;     // of rate and width: 1 if not applied; of shift and rotation: 0
  bool weighed = false;  // with what was known before
  std::string why;       // it was left; empty: by the rule

  /// "rate      1.131 +- 0.004 of what was thought: taken", with threshold and unit.
  std::string sentence() const;
};

/// What is taken over from a measured removal, for the next run.
struct ToolLesson {
  std::vector<LessonDecision> decisions;  // in the order of LessonSubject
  double rate = 1.0, width = 1.0;         // to multiply those that were thought
  Point shift;                            // where the machine removes, against where it was meant to [mm]
  double degrees = 0.0;                   // counter-clockwise about the registration's `about`
  /// Not empty: the part or the map lies otherwise than thought, and nothing is taken over.
  std::string orientation_fault;
};

/// Decides by the policy what of a registration is taken over (rate after every run; shift and
/// rotation only if certain and large enough to matter; width only if certain). fwhm: of the tool [mm], > 0. A shift
/// beyond a share of the FWHM is not absorbed: it is an error of orientation or origin. Cost O(1).
ToolLesson learn_from(const RemovalRegistration& registration, double fwhm, const LessonPolicy& policy = {});

}  // namespace dwell
