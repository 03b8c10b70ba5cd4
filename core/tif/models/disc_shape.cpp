#include "core/tif/models/disc_shape.h"

#include <fmt/format.h>

#include <algorithm>

namespace dwell {

RemovalShape disc_shape(double radius, double blur) {
  const double width = std::max(blur, 1e-6 * radius);
  return {[radius, width](Point p) {
            const double r = length(p);
            return r * std::clamp((radius - r) / width + 0.5, 0.0, 1.0);
          },
          radius, radius + 0.5 * width};
}

RemovalModel disc_model() {
  RemovalModel model;
  model.name = "disc";
  model.about = "a disc that spins about its axis under even pressure";
  model.parameters = {model_size("radius")};
  model.shape = [](std::span<const double> v, double blur) { return disc_shape(v[0], blur); };
  model.starts = [](const RemovalMoments& m) {
    return std::vector<ModelStart>{{m.centre, {0.9 * m.edge}}, {m.centre, {1.0 * m.edge}}};
  };
  model.closed_form = [](const SpecText& spec) {
    spec.accept_only({"slope", "radius"});
    return spinning_disc_removal(spec.number("slope"), spec.number("radius"));
  };
  model.spec = [](double peak, std::span<const double> v) {
    return fmt::format("disc:slope={:.8g},radius={:.8g}", peak / v[0], v[0]);
  };
  return model;
}

}  // namespace dwell
