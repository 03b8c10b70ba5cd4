#include "core/tif/models/bonnet_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/base/errors.h"
#include "core/base/numbers.h"
#include "core/base/rotation.h"

namespace dwell {
namespace {

class Bonnet {
 public:
  explicit Bonnet(const BonnetContact& c)
      : radius_(c.radius),
        exponent_(c.exponent),
        sine_(std::sin(c.precession * kPi / 180.0)),
        cosine_(std::cos(c.precession * kPi / 180.0)),
        height_(std::sqrt(c.cap * c.cap - c.radius * c.radius)) {
    for (int k = 0; k < c.positions; ++k) turns_.emplace_back(c.angle + 360.0 * k / c.positions);
    if (c.positions == 0) tabulate();
  }

  double operator()(Point p) const {
    const double share = (p.x * p.x + p.y * p.y) / (radius_ * radius_);
    if (!(share < 1.0)) return 0.0;
    const double pressure = exponent_ == 0.5 ? std::sqrt(1.0 - share) : std::pow(1.0 - share, exponent_);
    return pressure * (turns_.empty() ? round_speed(std::sqrt(share)) : mean_speed(p));
  }

 private:
  double speed(Point p) const {
    const double along = cosine_ * p.x + height_ * sine_;  // the axis leans towards +x
    return std::hypot(along, cosine_ * p.y);
  }

  double mean_speed(Point p) const {
    double sum = 0.0;
    for (const Rotation& turn : turns_) sum += speed(turn.back(p));
    return sum / static_cast<double>(turns_.size());
  }

  double round_speed(double share) const {
    const double place = share * static_cast<double>(round_.size() - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(place), round_.size() - 2);
    return round_[k] + (place - static_cast<double>(k)) * (round_[k + 1] - round_[k]);
  }

  /// Mean speed all round at 513 radii, by the midpoint rule, which is exact to rounding for a smooth periodic speed.
  void tabulate() {
    constexpr int kRadii = 512, kAngles = 180;
    for (int i = 0; i <= kRadii; ++i) {
      const double r = radius_ * i / kRadii;
      double sum = 0.0;
      for (int k = 0; k < kAngles; ++k) {
        const double phi = kPi * (k + 0.5) / kAngles;
        sum += speed({r * std::cos(phi), r * std::sin(phi)});
      }
      round_.push_back(sum / kAngles);
    }
  }

  double radius_, exponent_, sine_, cosine_, height_;
  std::vector<Rotation> turns_;  // empty: all round
  std::vector<double> round_;    // mean speed over r / a
};

/// The largest value in the contact disc: the best of a polar grid, then steps in four directions, halved when none
/// helps.
double largest(const Bonnet& bonnet, double radius) {
  Point best;
  double value = bonnet(best);
  const auto try_at = [&](Point p) {
    const double v = bonnet(p);
    if (!(v > value)) return false;
    value = v;
    best = p;
    return true;
  };
  for (int i = 1; i < 40; ++i) {
    for (int k = 0; k < 48; ++k) {
      const double r = radius * i / 40.0, phi = 2.0 * kPi * k / 48.0;
      try_at({r * std::cos(phi), r * std::sin(phi)});
    }
  }
  for (double step = radius / 40.0; step > 1e-7 * radius;) {
    const Point from = best;
    bool better = false;
    for (const Point way : {Point{step, 0.0}, {-step, 0.0}, {0.0, step}, {0.0, -step}})
      better = try_at(from + way) || better;
    if (!better) step *= 0.5;
  }
  return value;
}

}  // namespace

RemovalShape bonnet_shape(const BonnetContact& contact) {
  const auto refuse = [](const char* name, double value, const char* required) {
    throw InputError(fmt::format("bonnet removal function: {} = {}; required {}", name, value, required));
  };
  if (!(contact.radius > 0.0)) refuse("radius", contact.radius, "> 0 mm");
  if (!(contact.cap > contact.radius)) refuse("cap", contact.cap, "larger than the radius of the contact");
  if (!(contact.precession >= 0.0 && contact.precession <= 90.0))
    refuse("precession", contact.precession, "0 to 90 deg");
  if (!(contact.exponent > 0.0)) refuse("exponent", contact.exponent, "> 0");
  if (contact.positions < 0) refuse("positions", contact.positions, "0 (continuous), 1, 2, ...");
  auto bonnet = std::make_shared<Bonnet>(contact);
  const double peak = largest(*bonnet, contact.radius);
  if (!(peak > 0.0)) refuse("precession", contact.precession, "such that the cap slides over the part");
  return {[bonnet](Point p) { return (*bonnet)(p); }, peak, contact.radius};
}

RemovalModel bonnet_model() {
  RemovalModel model;
  model.name = "bonnet";
  model.about = "a spinning spherical cap pressed on the part, its axis inclined";
  model.preston = true;
  model.parameters = {model_size("radius"),
                      {"cap", "mm", 0.0, 1e6, true, {}, false, false},
                      {"precession", "deg", 0.0, 90.0, false, {}, true, false},
                      {"positions", "", 0.0, 64.0, false, 4.0, false, true},
                      {"exponent", "", 0.0, 20.0, true, 0.5, false, false},
                      model_angle()};
  model.shape = [](std::span<const double> v, double) {
    return bonnet_shape({v[0], v[1], v[2], static_cast<int>(std::lround(v[3])), v[4], v[5]});
  };
  model.starts = [](const RemovalMoments& m) {
    std::vector<ModelStart> starts;
    for (const double angle : {0.0, 90.0, 180.0, 270.0}) {
      for (const double precession : {6.0, 20.0}) {
        starts.push_back({m.centre, {1.05 * m.edge, 1.0, precession, 4.0, 0.5, m.angle + angle}});
      }
    }
    return starts;
  };
  // All round, the direction of the lean means nothing.
  model.idle = [](std::size_t parameter, std::span<const double> held) { return parameter == 5 && held[3] == 0.0; };
  return model;
}

}  // namespace dwell
