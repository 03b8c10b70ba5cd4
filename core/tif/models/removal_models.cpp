#include "core/tif/models/removal_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/tif/models/bonnet_shape.h"
#include "core/tif/models/disc_shape.h"
#include "core/tif/models/gaussian_shapes.h"
#include "core/tif/models/planetary_shape.h"
#include "core/tif/removal_kernel.h"

namespace dwell {
namespace {

std::vector<double> values_of(const RemovalModel& model, const SpecText& spec) {
  std::vector<double> values;
  for (const ModelParameter& p : model.parameters) {
    values.push_back(p.fallback ? spec.number(p.name, *p.fallback) : spec.number(p.name));
    check_model_parameter(model, p, values.back());
  }
  return values;
}

void accept_keys(const RemovalModel& model, const SpecText& spec) {
  std::vector<std::string> keys{"peak"};
  if (model.preston) keys.insert(keys.end(), {"preston", "pressure", "rpm"});
  for (const ModelParameter& p : model.parameters) keys.push_back(p.name);
  spec.accept_only(keys);
}

double positive(const SpecText& spec, const char* key, const char* unit) {
  const double value = spec.number(key);
  if (!(std::isfinite(value) && value > 0.0)) {
    throw InputError(
        fmt::format("{} \"{}\": {} = {} {}; required finite and > 0", spec.field, spec.text, key, value, unit));
  }
  return value;
}

/// The factor from the shape's values to nm/s.
double scale_of(const RemovalModel& model, const SpecText& spec, const RemovalShape& shape) {
  if (!model.preston || spec.has("peak")) {
    if (spec.has("preston") || spec.has("pressure") || spec.has("rpm")) {
      throw InputError(fmt::format("{} \"{}\": give either peak, or preston, pressure and rpm", spec.field, spec.text));
    }
    return spec.number("peak", ranges::kRate) / shape.peak;
  }
  const double turns = positive(spec, "rpm", "1/min") / units::kSecondsPerMinute;
  return positive(spec, "preston", "1/Pa") * positive(spec, "pressure", "Pa") * 2.0 * std::numbers::pi * turns *
         units::kNmPerMm;
}

/// Samples of the shape from -half to +half pitches about the axis; zero beyond the reach.
HeightMap sample(const RemovalShape& shape, double scale, Index half) {
  const double pitch = shape.reach / static_cast<double>(half);
  HeightMap map(Grid{2 * half + 1, 2 * half + 1, pitch, pitch, {-shape.reach, -shape.reach}});
  map.quantity = MapQuantity::Rate;
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p{pitch * static_cast<double>(i % map.grid.cols - half),
                  pitch * static_cast<double>(i / map.grid.cols - half)};
    map.values[static_cast<std::size_t>(i)] = length(p) <= shape.reach ? scale * shape.value(p) : 0.0;
  }
  return map;
}

/// RMS of spline minus formula at points between the samples, as a share of the formula's RMS there.
double interpolation_error(const HeightMap& samples, const RemovalShape& shape, double scale) {
  const SplineSurface spline(samples.grid, samples.values);
  const Grid& g = samples.grid;
  const Index step = std::max<Index>(1, g.rows / 96);
  double error = 0.0, square = 0.0;
  for (Index r = 0; r + 1 < g.rows; r += step) {
    for (Index c = r % 2; c + 1 < g.cols; c += step) {
      const Point p{g.x(c) + 0.5 * g.pitch_x, g.y(r) + 0.4 * g.pitch_y};
      const double truth = length(p) <= shape.reach ? scale * shape.value(p) : 0.0;
      error += std::pow(spline(p) - truth, 2);
      square += truth * truth;
    }
  }
  return std::sqrt(error / square);
}

}  // namespace

const std::vector<RemovalModel>& removal_models() {
  static const std::vector<RemovalModel> kModels{gaussian_model(), elliptic_gaussian_model(), super_gaussian_model(),
                                                 disc_model(),     planetary_model(),         mrf_model(),
                                                 bonnet_model()};
  return kModels;
}

bool is_removal_model(const std::string& name) {
  return std::any_of(removal_models().begin(), removal_models().end(), [&](const auto& m) { return m.name == name; });
}

const RemovalModel& removal_model(const std::string& name) {
  std::string names;
  for (const RemovalModel& model : removal_models()) {
    if (model.name == name) return model;
    names += (names.empty() ? "" : ", ") + model.name;
  }
  throw InputError(fmt::format("'{}' is no model of a removal function; accepted: {}", name, names));
}

void check_model_parameter(const RemovalModel& model, const ModelParameter& p, double value) {
  const bool in = std::isfinite(value) && (p.open ? value > p.least : value >= p.least) && value <= p.most;
  if (in && !(p.whole && value != std::round(value))) return;
  throw InputError(fmt::format("{} removal function: {} = {}{}{}; required{} {} {} and <= {}", model.name, p.name,
                               value, p.unit.empty() ? "" : " ", p.unit, p.whole ? " a whole number" : "",
                               p.open ? ">" : ">=", p.least, p.most));
}

RemovalFunction sampled_removal(const RemovalShape& shape, double scale, const std::string& model) {
  constexpr double kEnough = 1e-3;
  constexpr Index kFewest = 48, kMost = 384;
  HeightMap samples;
  double error = 0.0;
  for (Index half = kFewest; half <= kMost; half *= 2) {
    samples = sample(shape, scale, half);
    error = interpolation_error(samples, shape, scale);
    if (error <= kEnough) break;
  }
  samples.history.push_back(fmt::format(
      "tif: model {}, {} x {} samples of {:.6g} mm; its spline differs from the formula by {:.2g} of the formula's RMS",
      model, samples.grid.rows, samples.grid.cols, samples.grid.pitch_x, error));
  RemovalFunction tif = measured_removal(samples, {TifCentre::Kind::Given, {}});
  tif.kind = RemovalFunction::Kind::Model;
  tif.model = model;
  return tif;
}

RemovalFunction removal_of_spec(const SpecText& spec) {
  const RemovalModel& model = removal_model(spec.kind);
  if (model.closed_form != nullptr) return model.closed_form(spec);
  accept_keys(model, spec);
  const RemovalShape shape = model.shape(values_of(model, spec), 0.0);
  return sampled_removal(shape, scale_of(model, spec, shape), model.name);
}

HeightMap removal_samples(const RemovalFunction& tif) {
  using Kind = RemovalFunction::Kind;
  if (tif.kind == Kind::Measured || tif.kind == Kind::Model) return tif.samples;
  constexpr Index kHalf = 128;
  const double pitch = tif.radius / static_cast<double>(kHalf);
  HeightMap map(Grid{2 * kHalf + 1, 2 * kHalf + 1, pitch, pitch, {-tif.radius, -tif.radius}});
  map.quantity = MapQuantity::Rate;
  const auto rate = rate_at_pixel(tif, pitch, pitch);
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Index row = i / map.grid.cols - kHalf, col = i % map.grid.cols - kHalf;
    map.values[static_cast<std::size_t>(i)] =
        rate({pitch * static_cast<double>(col), pitch * static_cast<double>(row)});
  }
  return map;
}

}  // namespace dwell
