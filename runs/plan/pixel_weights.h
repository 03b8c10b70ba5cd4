#pragma once

#include <vector>

#include "core/map/height_map.h"

namespace dwell {

// Rules that give the pixels of a part weights by their place, one a pixel of the map; what they say where there is no
// data is 1.

/// `weight` in the zone at the edge (core/anatomy/edge_zone.h): at pixels whose centre is at most `width` [mm] from the
/// nearest place without data, holes narrower than twice the width being none; 1 elsewhere. Cost O(pixels).
std::vector<double> weights_at_edge(const HeightMap& part, double width, double weight, int threads = 1);

/// `weight` in the middle of the box around the pixels with data, falling smoothly to 1 on the ellipse that touches its
/// sides, and 1 beyond: 1 + (weight - 1) cos^2(pi rho / 2) with rho^2 = (x / a)^2 + (y / b)^2 from the middle, a and b
/// half of the box's sides. On a disc that is a radial Hann window. Cost O(pixels).
std::vector<double> weights_in_centre(const HeightMap& part, double weight);

}  // namespace dwell
