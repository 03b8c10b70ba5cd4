#pragma once

#include <optional>

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "paths/domain/path_domain.h"
#include "paths/lines/scan_lines.h"

namespace dwell {

/// The options that all curves about a centre share.
struct CentredCurveOptions {
  double pitch = 0.0;             // distance between neighbouring turns [mm], finite and > 0; required
  std::optional<double> step;     // distance of dwell points along the curve [mm], finite and > 0; default = pitch
  std::optional<double> overrun;  // how far the curve goes on beyond the valid pixels [mm], finite and >= 0; default 0
                                  // (plan_path: TIF radius)
  std::optional<Point> centre;    // [mm], finite; default: middle of the box of the valid pixel centres
  bool from_edge = false;         // the same path in reverse order, from the edge to the centre
  bool clockwise = false;         // sense in which the curve turns on its way outwards, as seen with +y up
};

/// The keys pitch, step, overrun, centre, from and turn; no other is accepted.
CentredCurveOptions parse_centred_curve(const SpecText& spec);

/// Where a curve about a centre may go. With dwell points up to g apart along the curve, a point of the curve is wanted
/// if it lies within max(overrun, (pitch + g) / 2) of a valid pixel centre: the dwell point nearest to where the curve
/// passes a valid pixel within pitch/2 is then wanted too. The distance is at least half the diagonal of a pixel, so
/// that there are no gaps between pixels.
struct CentredDomain {
  double pitch = 0.0;
  double step = 0.0;
  Point centre;
  PathDomain domain;
  Interval radius;  // distances of its points from the centre lie within this [mm]

  /// g = longest_step * step. Throws InputError "PLANNER: OPTION = VALUE mm; required ...", and if the map has no
  /// finite pixel. Cost O(pixels).
  CentredDomain(const HeightMap& map, const CentredCurveOptions& options, double longest_step, const char* planner,
                const Progress& progress = {});

  /// Throws InputError if `points` dwell points, including those outside, are more than a path may have.
  void check_size(double points, const char* planner) const;
  /// An upper estimate of the dwell points in the domain at this pitch and step, for reserving memory.
  std::size_t about_points(double points) const;
};

/// The interval [mm] that holds the distances from `centre` of all points within `reach` of a valid pixel centre. Cost
/// O(pixels).
Interval radial_range(const HeightMap& map, Point centre, double reach);

/// Reverses a path: the same moves are lifted. Cost O(points).
void reverse(ToolPath& path);

}  // namespace dwell
