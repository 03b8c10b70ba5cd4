#pragma once

#include "core/tif/models/removal_model.h"
#include "core/tif/removal_shape.h"

namespace dwell {

/// How a bonnet touches the part.
struct BonnetContact {
  double radius = 0.0;      // a: of the contact disc [mm], > 0
  double cap = 0.0;         // R: of the sphere [mm], > a
  double precession = 0.0;  // of the spin axis from the normal of the part [deg], 0 .. 90
  int positions = 4;        // precession positions taken in turn for equal times; 0 = all round, continuously
  double exponent = 0.5;    // q of the pressure (1 - r^2 / a^2)^q; 0.5 is Hertz's, > 0
  double angle = 0.0;       // towards which the spin axis leans in the first position [deg], counter-clockwise from +x
};

/// The removal of a spinning spherical cap that is pressed on the part until its contact is a disc of radius a. Its
/// spin axis passes through the centre of the sphere and is inclined by the precession angle. Preston's rate is
/// pressure (1 - r^2/a^2)^q times the sliding speed; the centre is h = sqrt(R^2 - a^2) above the part and, with the
/// axis leaning towards +x,
///   |v| / w = sqrt(r^2 cos^2 + h^2 sin^2 + 2 h x sin cos)   [mm], sin and cos of the precession,
/// averaged over the positions (Xie, Gao, Yao, Yuan 2007, https://doi.org/10.1504/IJCAT.2007.015258: Preston in
/// precession). The speed is zero where the spin axis meets the part, at x = -h tan. Throws InputError naming what is
/// out of range, or if nothing slides.
RemovalShape bonnet_shape(const BonnetContact& contact);

/// Its row in removal_models().
RemovalModel bonnet_model();

}  // namespace dwell
