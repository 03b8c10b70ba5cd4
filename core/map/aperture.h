#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

/// An area of the part, in the map's coordinates [mm]: what the specification counts, or what a mask keeps or removes.
struct Aperture {
  enum class Kind { Map, Rectangle, Circle, Ellipse, Annulus, Polygon } kind = Kind::Map;
  double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;  // Rectangle, x0 < x1, y0 < y1
  double x = 0.0, y = 0.0;                        // centre of Circle, Ellipse and Annulus
  double radius = 0.0;                            // Circle, Annulus (outer), > 0
  double inner_radius = 0.0;                      // Annulus, 0 <= inner_radius < radius
  double a = 0.0, b = 0.0, degrees = 0.0;         // Ellipse: half axes > 0; a lies `degrees` counter-clockwise of +x
  std::vector<std::vector<Point>> rings;          // Polygon: closed outlines of >= 3 corners, even-odd rule
};

/// Parses "map", "rect:x0,y0,x1,y1", "circle:x,y,r", "ellipse:x,y,a,b[,degrees]", "annulus:x,y,r_inner,r_outer" or
/// "polygon:x1,y1,x2,y2,...[/x1,y1,...]" [mm], each ring of a polygon after a slash being a hole or an island by the
/// even-odd rule. Throws InputError naming text and accepted forms.
Aperture parse_aperture(const std::string& text);
std::string to_string(const Aperture& aperture);

/// Copy of the map with every pixel whose centre is outside the aperture (beyond its closed boundary) set to NaN.
/// Throws InputError if no finite pixel is left, saying where the map lies. Cost O(pixels), for a polygon times the
/// edges that a row of pixels meets.
HeightMap within(HeightMap map, const Aperture& aperture, const Progress& progress = {});

/// Copy of the map with every pixel that `within` keeps set to NaN. Throws likewise.
HeightMap outside(HeightMap map, const Aperture& aperture, const Progress& progress = {});

}  // namespace dwell
