#pragma once

#include "core/base/point.h"
#include "core/motion/program.h"
#include "paths/feed/machine.h"

namespace dwell {

/// The arc on which a machine passes from one move to the next, touching both (CornerRule::Blend).
struct BlendArc {
  double radius = 0.0;        // [mm]; 0 = no arc: the moves meet at their ends
  double turn = 0.0;          // [rad], counter-clockwise positive
  double cut = 0.0;           // what the arc takes of each move [mm]
  double max_speed = 0.0;     // [mm/s]
  double acceleration = 0.0;  // along it [mm/s^2]

  double half_length() const { return 0.5 * radius * (turn < 0.0 ? -turn : turn); }
};

/// A move as the arcs at its ends see it.
struct BlendMove {
  double length = 0.0;  // [mm], > 0
  double feed = 0.0;    // commanded, at most what the machine can [mm/s]
};

/// The arc between two moves that turn by `turn` [rad], not 0 and less than half a circle.
///
/// With phi = |turn|, a the acceleration that the machine has in every direction, and a_n = across_share a and a_t =
/// along_share a: the arc leaves the corner by at most e = min(tolerance, a quarter of the shorter move), so that it
/// takes at most d = min(e / tan(phi / 4), half of the shorter move) of each and has at most the radius R = d /
/// tan(phi / 2). It is run at v <= sqrt(a_n R), the machine's speed in every direction, and its speed changes by at
/// most a_t. BlendSize::Largest has this radius. With BlendSize::AsNeeded v is no higher than the faster feed, and the
/// radius is max(v^2 / a_n, min(R, v t / phi)): the arc takes the time t in which the machine reaches v from rest at
/// a_t, or as far as it gets over d. That is what LinuxCNC 2.9 does, with shares of 0.866 and 0.5 (docs/motion.md).
/// Without a limit of acceleration, an arc as needed has no radius.
BlendArc blend_arc(const BlendMove& before, const BlendMove& after, double turn, double tolerance,
                   const Machine& machine);

/// The way of a step from the middle of the arc at its start to the middle of the one at its finish.
class BlendedStep {
 public:
  BlendedStep(const ProgramStep& step, const BlendArc& in, const BlendArc& out);

  double length() const { return in_.half_length() + straight_ + out_.half_length(); }
  /// The place after a way s [mm], from 0 to length().
  Point place(double s) const;

 private:
  Point on_arc(const BlendArc& arc, Point touch, double way, double direction) const;

  ProgramStep step_;
  BlendArc in_, out_;
  Point along_;
  double straight_;
};

}  // namespace dwell
