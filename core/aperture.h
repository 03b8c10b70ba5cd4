#pragma once

#include <string>

#include "core/height_map.h"

namespace dwell {

/// The part of the map that the specification counts, in the map's coordinates [mm].
struct Aperture {
  enum class Kind { Map, Rectangle, Circle } kind = Kind::Map;
  double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;  // Rectangle, x0 < x1, y0 < y1
  double x = 0.0, y = 0.0, radius = 0.0;          // Circle, radius > 0
};

/// Parses "map", "rect:x0,y0,x1,y1" or "circle:x,y,r" [mm]. Throws InputError naming text and accepted forms.
Aperture parse_aperture(const std::string& text);
std::string to_string(const Aperture& aperture);

/// Copy of the map with every pixel whose centre is outside the aperture (beyond its closed boundary) set to NaN.
/// Throws InputError if no finite pixel is left, saying where the map lies.
HeightMap within(HeightMap map, const Aperture& aperture);

}  // namespace dwell
