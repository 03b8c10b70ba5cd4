#include "core/tif/models/gaussian_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/errors.h"
#include "core/base/rotation.h"

namespace dwell {
namespace {

using Values = std::span<const double>;

constexpr double kLn2 = std::numbers::ln2;
constexpr double kReachInWidths = 1.5;  // exp(-9 ln 2) = 0.002 there

RemovalFunction gaussian_of(const SpecText& spec) {
  spec.accept_only({"peak", "fwhm", "sigma", "radius"});
  if (spec.has("fwhm") == spec.has("sigma")) {
    throw InputError(fmt::format("tif '{}': give either fwhm or sigma [mm]", spec.text));
  }
  const double fwhm =
      spec.has("fwhm") ? spec.number("fwhm") : spec.number("sigma") * std::sqrt(8.0 * std::numbers::ln2);
  return gaussian_removal(spec.number("peak", ranges::kRate), fwhm, spec.number("radius", 1.5 * fwhm));
}

}  // namespace

RemovalShape elliptic_gaussian_shape(double fwhm_x, double fwhm_y, double angle) {
  const Rotation turn(angle);
  return {[=](Point p) {
            const Point q = turn.back(p);
            const double u = 2.0 * q.x / fwhm_x, v = 2.0 * q.y / fwhm_y;
            return std::exp(-kLn2 * (u * u + v * v));
          },
          1.0, kReachInWidths * std::max(fwhm_x, fwhm_y)};
}

RemovalShape super_gaussian_shape(double fwhm, double order) {
  return {[=](Point p) { return std::exp(-kLn2 * std::pow(2.0 * length(p) / fwhm, order)); }, 1.0,
          0.5 * fwhm * std::pow(9.0, 1.0 / order)};
}

RemovalShape mrf_shape(double lead, double trail, double width, double angle) {
  const Rotation turn(angle);
  return {[=](Point p) {
            const Point q = turn.back(p);
            const double u = q.x / (q.x < 0.0 ? lead : trail), v = 2.0 * q.y / width;
            return std::exp(-kLn2 * (u * u + v * v));
          },
          1.0, 2.0 * kReachInWidths * std::max({lead, trail, 0.5 * width})};
}

RemovalModel gaussian_model() {
  RemovalModel model;
  model.name = "gaussian";
  model.about = "the same in all directions";
  model.parameters = {model_size("fwhm")};
  model.shape = [](Values v, double) { return elliptic_gaussian_shape(v[0], v[0], 0.0); };
  model.starts = [](const RemovalMoments& m) { return std::vector<ModelStart>{{m.centre, {m.fwhm}}}; };
  model.closed_form = gaussian_of;
  return model;
}

RemovalModel elliptic_gaussian_model() {
  RemovalModel model;
  model.name = "elliptic-gaussian";
  model.about = "of two widths, turned";
  model.parameters = {model_size("fwhm_x"), model_size("fwhm_y"), model_angle()};
  model.shape = [](Values v, double) { return elliptic_gaussian_shape(v[0], v[1], v[2]); };
  model.starts = [](const RemovalMoments& m) {
    return std::vector<ModelStart>{{m.centre, {m.major, m.minor, m.angle}}};
  };
  return model;
}

RemovalModel super_gaussian_model() {
  RemovalModel model;
  model.name = "super-gaussian";
  model.about = "with a flatter top and steeper flanks";
  model.parameters = {model_size("fwhm"), {"order", "", 0.5, 50.0, false, {}, true, false}};
  model.shape = [](Values v, double) { return super_gaussian_shape(v[0], v[1]); };
  model.starts = [](const RemovalMoments& m) {
    return std::vector<ModelStart>{{m.centre, {m.fwhm, 2.0}}, {m.centre, {m.fwhm, 5.0}}};
  };
  return model;
}

RemovalModel mrf_model() {
  RemovalModel model;
  model.name = "mrf";
  model.about = "the D of magnetorheological finishing";
  model.parameters = {model_size("lead"), model_size("trail"), model_size("width"), model_angle()};
  model.shape = [](Values v, double) { return mrf_shape(v[0], v[1], v[2], v[3]); };
  model.starts = [](const RemovalMoments& m) {
    std::vector<ModelStart> starts;
    for (int k = 0; k < 4; ++k) {
      const double along = k % 2 == 0 ? m.major : m.minor, across = k % 2 == 0 ? m.minor : m.major;
      starts.push_back({m.peak_at, {0.65 * along, 0.35 * along, across, m.angle + 90.0 * k}});
    }
    return starts;
  };
  // A D that is turned by 180 degrees and has its steep and its long side exchanged is the same D. The form shown is
  // the one whose long side is upstream.
  model.make_canonical = [](std::span<double> v, const std::vector<bool>& held) {
    if (held[0] || held[1] || held[3] || v[0] >= v[1]) return;
    std::swap(v[0], v[1]);
    v[3] += 180.0;
  };
  return model;
}

}  // namespace dwell
