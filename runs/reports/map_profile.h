#pragma once

#include <string>
#include <vector>

#include "core/map/height_map.h"
#include "runs/drawing/figure_format.h"

namespace dwell {

/// A line over a map, as a user gives it:
///   y=MM          along x, through the row of pixels nearest to this y
///   x=MM          along y, through the column nearest to this x
///   X0,Y0,X1,Y1   straight from one point to the other [mm], by bilinear interpolation at points one smaller pitch
///   apart
struct ProfileSpec {
  enum class Kind { AlongX, AlongY, Line } kind = Kind::AlongX;
  double at = 0.0;  // AlongX: y; AlongY: x [mm]
  Point from, to;   // Line
};

/// Throws InputError naming the text and what is accepted.
ProfileSpec parse_profile_spec(const std::string& text);

struct MapProfile {
  std::string name;             // "y = 3.25 mm": the row taken, not the place asked for
  std::string position;         // what `places` are: "x", "y", "distance"
  std::vector<double> places;   // ascending [mm]
  std::vector<double> heights;  // [nm], NaN where the map has no data

  double pv() const;   // of the finite heights [nm]
  double rms() const;  // of the finite heights about their mean [nm]
};

/// Throws InputError if the line does not lie on the map, saying where the map lies, or if it meets no finite pixel.
MapProfile map_profile(const HeightMap& map, const ProfileSpec& spec);

/// Heights against place as a figure, linear axes.
std::string profile_picture(const MapProfile& profile, const std::string& title,
                            FigureFormat format = FigureFormat::Png);

}  // namespace dwell
