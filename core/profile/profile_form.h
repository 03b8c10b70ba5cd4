#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/profile/ellipse_mirror.h"
#include "core/profile/line_profile.h"

namespace dwell {

/// The form of a mirror that is taken out of a profile, as a user gives it:
///   none                        nothing
///   piston | piston,tilt        its mean height; with it, its mean slope
///   polynomial:N                a polynomial of degree N <= 20 of the height
///   sphere[:radius=MM]          a circle, concave for a radius > 0; without a radius it is fitted
///   ellipse:p=MM,q=MM,angle=DEG[,at=MM][,source=low|high][,fit=position|angle|position+angle|none]
/// Piston and tilt are always fitted beside a sphere or an ellipse: how high and how level the mirror lay under the
/// instrument is not its figure. `at` is the x of the pole, else the middle of the profile; unless `at` or `fit` is
/// given, the place of the pole is fitted. `source` is the end of x that looks to the source, low unless given.
struct ProfileForm {
  enum class Kind { None, Polynomial, Sphere, Ellipse } kind = Kind::Polynomial;
  std::string text = "piston,tilt";  // as given
  int degree = 1;                    // Polynomial: of the height
  std::optional<double> radius;      // Sphere [mm]; none: fitted
  EllipseMirror mirror;
  std::optional<double> pole;  // [mm]
  bool source_high = false;
  bool fit_position = false, fit_angle = false;
};

/// Throws InputError naming the text, the key and what is accepted.
ProfileForm parse_profile_form(const std::string& text);

/// What is left of a profile without its form, and what was fitted.
struct ProfileRest {
  LineProfile profile;
  std::optional<double> tilt;    // the constant slope that was taken out with piston and tilt, sphere or ellipse [urad]
  std::optional<double> radius;  // Sphere [mm], infinite of a plane
  std::optional<double> pole;    // Ellipse [mm]
  std::optional<double> angle;   // Ellipse, grazing [rad]
  /// A sentence each: what would fit an ellipse at least twice as well, another sign or end; that the form of a curved
  /// mirror seems to be in heights of which none was taken out (they span over 1 um, mostly of a curve).
  std::vector<std::string> hints;
};

/// Takes the form out of what was measured, by least squares in which every place counts by the length that it stands
/// for, and makes the other quantity of the rest. Sphere and ellipse in closed form, their parameters by Gauss and
/// Newton. Throws InputError if the form does not reach as far as the profile, has as many parameters as there are
/// places, or is not determined. Cost O(places x parameters^2) an iteration.
ProfileRest remove_profile_form(const LineProfile& profile, const ProfileForm& form);

}  // namespace dwell
