#pragma once

#include "core/tif/models/removal_model.h"
#include "core/tif/removal_shape.h"

namespace dwell {

/// The removal of a pad of radius r. Its centre revolves about the tool axis at the distance d = eccentricity * r with
/// angular velocity w, and the pad spins about its own centre at ratio * w relative to the arm; the pressure is even
/// (dual rotation, "planetary"; Zha et al. 2020, section 3.2, has ratio -1, eccentricity 0.8). Preston's rate, averaged
/// over a revolution: with the point at distance rho from the axis, c(phi) the centre of the pad and v = w z x ((1 +
/// ratio) P - ratio c),
///   value = 1/(2 pi) integral of |v| / w over the phi with |P - c(phi)| <= r   [mm].
/// At ratio = -1 the pad does not turn, every point of it moves at w d, and value / d is the share of the revolution
/// spent under the pad. Eccentricity 0 is the spinning disc. The integral is taken by 4-point Gauss-Legendre quadrature
/// on 16 panels at 2 x 512 radii, which lie closer where the pad's rim passes; between them the value is linear (error
/// about 1e-5 of the peak). The peak is the largest of these values. Throws InputError if nothing moves (ratio -1 with
/// eccentricity 0). radius > 0, eccentricity >= 0. Cost of the table: about 2 ms.
RemovalShape planetary_shape(double radius, double eccentricity, double ratio);

/// Its row in removal_models().
RemovalModel planetary_model();

}  // namespace dwell
