#include "core/tif/models/planetary_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "core/base/errors.h"
#include "core/base/numbers.h"

namespace dwell {
namespace {

constexpr int kPanels = 16;
constexpr int kSteps = 512;
constexpr std::array<double, 2> kNodes{0.3399810435848563, 0.8611363115940526};  // of Gauss-Legendre, 4 points
constexpr std::array<double, 2> kWeights{0.6521451548625461, 0.3478548451374538};

struct Motion {
  double radius, arm, ratio;

  double speed(double rho, double phi) const {
    const double turn = 1.0 + ratio, a = turn * rho, b = ratio * arm;
    return std::sqrt(std::max(0.0, a * a + b * b - 2.0 * a * b * std::cos(phi)));
  }

  /// The half angle of the revolution during which the pad covers a point at rho.
  double half_angle(double rho) const {
    if (rho == 0.0 && arm == radius) return 0.5 * kPi;  // the rim passes over the axis: the limit from beside it
    if (rho + arm <= radius) return kPi;
    if (rho >= radius + arm || arm >= radius + rho) return 0.0;
    return std::acos(std::clamp((rho * rho + arm * arm - radius * radius) / (2.0 * rho * arm), -1.0, 1.0));
  }

  double mean_speed(double rho) const {
    if (ratio == -1.0) return arm * half_angle(rho) / kPi;  // every point of the pad moves at the speed of its centre
    const double panel = half_angle(rho) / kPanels;
    double sum = 0.0;
    for (int k = 0; k < kPanels; ++k) {
      const double middle = panel * (k + 0.5);
      for (std::size_t i = 0; i < 2; ++i) {
        const double step = 0.5 * panel * kNodes[i];
        sum += kWeights[i] * (speed(rho, middle - step) + speed(rho, middle + step));
      }
    }
    return 0.5 * panel * sum / kPi;
  }
};

/// Values over a stretch of radii. The places crowd towards both ends, where the half angle grows like a square root.
struct Stretch {
  double from, to;
  std::vector<double> values;

  Stretch(double a, double b, const Motion& motion) : from(a), to(b) {
    for (int k = 0; k <= kSteps; ++k)
      values.push_back(motion.mean_speed(a + (b - a) * 0.5 * (1.0 - std::cos(kPi * k / kSteps))));
  }

  double operator()(double rho) const {
    const double share = std::clamp(1.0 - 2.0 * (rho - from) / (to - from), -1.0, 1.0);
    const double place = std::acos(share) / kPi * kSteps;
    const std::size_t k = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(kSteps - 1));
    return values[k] + (place - static_cast<double>(k)) * (values[k + 1] - values[k]);
  }
};

}  // namespace

RemovalShape planetary_shape(double radius, double eccentricity, double ratio) {
  const Motion motion{radius, eccentricity * radius, ratio};
  const double inner = std::abs(radius - motion.arm), outer = radius + motion.arm;
  auto stretches = std::make_shared<std::vector<Stretch>>();
  if (inner > 0.0) stretches->emplace_back(0.0, inner, motion);
  if (outer > inner) stretches->emplace_back(inner, outer, motion);
  double peak = 0.0;
  for (const Stretch& s : *stretches) peak = std::max(peak, *std::max_element(s.values.begin(), s.values.end()));
  if (!(peak > 0.0)) {
    throw InputError(
        fmt::format("planetary removal function: radius = {}, eccentricity = {}, ratio = {}: the pad does not move "
                    "over the part; an eccentricity > 0 or a ratio other than -1 is required",
                    radius, eccentricity, ratio));
  }
  return {[stretches, outer](Point p) {
            const double rho = length(p);
            if (rho > outer) return 0.0;
            return rho < stretches->front().to ? stretches->front()(rho) : stretches->back()(rho);
          },
          peak, outer};
}

RemovalModel planetary_model() {
  RemovalModel model;
  model.name = "planetary";
  model.about = "a pad that revolves about the tool axis and spins about its own centre";
  model.preston = true;
  model.parameters = {model_size("radius"),
                      {"eccentricity", "", 0.0, 100.0, false, {}, true, false},
                      {"ratio", "", -1e4, 1e4, false, -1.0, false, false}};
  model.shape = [](std::span<const double> v, double) { return planetary_shape(v[0], v[1], v[2]); };
  model.starts = [](const RemovalMoments& m) {
    std::vector<ModelStart> starts;
    for (const double e : {0.3, 0.8, 1.1, 2.0}) starts.push_back({m.centre, {m.edge / (1.0 + e), e, -1.0}});
    return starts;
  };
  return model;
}

}  // namespace dwell
