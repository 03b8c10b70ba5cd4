#pragma once

#include <Eigen/Core>

#include <vector>

#include "core/map/height_map.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// A tool in planetary motion and one point A of it (Xie et al. 2022, section 3.2): the centre O2 of the tool revolves
/// about the machine's axis O1, which follows the path, and the tool spins about O2. Positive is counter-clockwise.
struct PlanetaryTool {
  double revolution_radius = 5.0;  // rho0, from O1 to O2 [mm], finite and >= 0
  double point_radius = 2.0;       // r1, from O2 to A [mm], >= 0 and at most the radius of the tool
  double tool_radius = 6.25;       // [mm], finite and > 0
  double revolution_rpm = 60.0;    // of O2 about O1 [1/min], finite; the paper does not give one
  double spin_rpm = 150.0;         // of the tool about O2, relative to the arm from O1 to O2 [1/min], finite
  double revolution_deg = 0.0;     // direction from O1 to O2 at the start [deg from +x], finite
  double spin_deg = 0.0;           // beta at the start: angle at O2 from the direction of O1 to that of A [deg], finite

  /// A from O1 after the time t [s]. Its length is equation 7: r^2 = r1^2 + rho0^2 - 2 r1 rho0 cos(beta).
  Point offset(double t) const;

  /// Speed of A over a part at rest under O1 [mm/s], equation 6: v1 = w1 r and v2 = w2 r1 at the angle between O1 A and
  /// O2 A (pi - beta - theta, with theta at O1), so that v^2 = v1^2 + v2^2 + 2 v1 v2 cos(pi - beta - theta), w1 and w2
  /// with their signs. The paper's minus sign is for speeds without sign and rotations in opposite senses.
  double speed(double t) const;
};

/// Where A was, at equal times.
struct TextureTrack {
  std::vector<Point> points;  // [mm]
  double step = 0.0;          // between them [s]
};

/// The track of A while O1 runs along the strokes, each in its time [s] at one speed (minimum_dwell(strokes, {0, feed})
/// gives the times of a constant feed). It has a point every `step` [s], from time 0 to the end. The tool keeps
/// rotating through the whole run; a lifted move takes no time. Throws InputError naming what is out of range: also if
/// there is not one finite time >= 0 for each stroke, if the arm or the tool turns by more than 45 degrees in a step,
/// or above 50 million points. Cost O(strokes + points).
TextureTrack texture_track(const std::vector<Stroke>& strokes, const Eigen::VectorXd& times, const PlanetaryTool& tool,
                           double step);

/// How long A has been at each place: the time per area [s/mm^2] over a grid. The step of each point of the track is
/// shared bilinearly among the four nearest pixel centres, so that the sum over the pixels times the pixel area is the
/// time on the grid. What falls outside is left out. Cost O(pixels + points).
HeightMap texture_density(const TextureTrack& track, const Grid& grid);

}  // namespace dwell
