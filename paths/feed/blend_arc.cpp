#include "paths/feed/blend_arc.h"

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

constexpr double kQuarter = 0.25;  // of the shorter move, by which an arc leaves the corner at most

}  // namespace

BlendArc blend_arc(const BlendMove& before, const BlendMove& after, double turn, double tolerance,
                   const Machine& machine) {
  const double phi = std::abs(turn), half = std::tan(0.5 * phi), shorter = std::min(before.length, after.length);
  const double a = acceleration_everywhere(machine), across = machine.across_share * a, along = machine.along_share * a;
  const double leaves = std::min(tolerance, kQuarter * shorter);
  const double cut = std::min(leaves / std::tan(0.25 * phi), 0.5 * shorter);
  BlendArc arc{cut / half, turn, cut, speed_everywhere(machine), along};
  if (!std::isfinite(a)) {
    return machine.blend_size == BlendSize::Largest ? arc : BlendArc{};
  }
  arc.max_speed = std::min(arc.max_speed, std::sqrt(across * arc.radius));
  if (machine.blend_size == BlendSize::Largest) return arc;
  const double v = std::min(arc.max_speed, std::max(before.feed, after.feed));
  const double seconds = std::min(v, std::sqrt(2.0 * along * cut)) / along;
  arc.radius = std::max(v * v / across, std::min(arc.radius, v * seconds / phi));
  arc.cut = arc.radius * half;
  arc.max_speed = v;
  return arc;
}

BlendedStep::BlendedStep(const ProgramStep& step, const BlendArc& in, const BlendArc& out)
    : step_(step),
      in_(in),
      out_(out),
      along_((1.0 / step.length()) * (step.finish - step.start)),
      straight_(std::max(0.0, step.length() - in.cut - out.cut)) {}

/// A place on an arc, by the way from where it touches the step; direction 1 = onwards, -1 = back.
Point BlendedStep::on_arc(const BlendArc& arc, Point touch, double way, double direction) const {
  const double turned = way / arc.radius, side = arc.turn > 0.0 ? 1.0 : -1.0;
  const Point across{-along_.y, along_.x};
  return touch + (direction * arc.radius * std::sin(turned)) * along_ +
         (side * arc.radius * (1.0 - std::cos(turned))) * across;
}

Point BlendedStep::place(double s) const {
  const double in = in_.half_length(), beyond = s - in - straight_;
  if (s < in) return on_arc(in_, step_.start + in_.cut * along_, in - s, -1.0);
  if (beyond > 0.0 && out_.radius > 0.0) return on_arc(out_, step_.finish - out_.cut * along_, beyond, 1.0);
  return step_.start + (in_.cut + std::min(s - in, straight_)) * along_;
}

}  // namespace dwell
