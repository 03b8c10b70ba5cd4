#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/spec_text.h"
#include "core/base/value_range.h"
#include "core/tif/removal_function.h"
#include "core/tif/removal_moments.h"
#include "core/tif/removal_shape.h"

namespace dwell {

/// A parameter of the form of a removal function, besides its peak and its place.
struct ModelParameter {
  std::string name;    // the key of a specification: "fwhm"
  std::string unit;    // "mm", "deg", or empty
  double least = 0.0;  // accepted: least <= value <= most (least < value if `open`), finite
  double most = 1e6;
  bool open = true;
  std::optional<double> fallback;  // if the user does not say; none: required
  bool fitted = true;              // a fit varies it, unless it is held
  bool whole = false;              // a whole number
};

/// A length of the form [mm], required.
inline ModelParameter model_size(const char* name) {
  return {name, "mm", ranges::kSize.least, ranges::kSize.most, true, {}, true, false};
}
/// The direction of the form, counter-clockwise from +x [deg]; 0 if not given.
inline ModelParameter model_angle() { return {"angle", "deg", -1e6, 1e6, false, 0.0, true, false}; }

/// Where a fit may start: the place of the tool axis, and the model's parameters in their order.
struct ModelStart {
  Point centre;
  std::vector<double> values;
};

/// A formula for removal functions (docs/removal_functions.md). One record a model, made beside its shape; the table of
/// removal_models.h feeds the specification of a tool, the fits, the documents and the tests (docs/adding.md).
struct RemovalModel {
  std::string name;
  std::string about;  // one line
  std::vector<ModelParameter> parameters;
  bool preston = false;  // its shape is pressure share x speed / angular velocity [mm]: Preston's law gives the rate
  /// The shape of these parameters, in their order. Jumps are ramps of the width `blur` [mm]. Throws InputError.
  RemovalShape (*shape)(std::span<const double> values, double blur);
  /// Starts of a fit; more than one where the moments do not decide (which way a D points, how far a pad lies from the
  /// tool axis).
  std::vector<ModelStart> (*starts)(const RemovalMoments& moments);

  /// The removal function of a specification, for models that have a closed form and keys of their own; null: the
  /// shape is sampled.
  RemovalFunction (*closed_form)(const SpecText& spec) = nullptr;
  /// The specification of fitted values that a user may copy, for models with keys of their own; null: peak and
  /// parameters.
  std::string (*spec)(double peak, std::span<const double> values) = nullptr;
  /// Where two sets of values describe the same form, replaces `values` by the set that is shown to users; null: no
  /// form has two. held: which values may not change.
  void (*make_canonical)(std::span<double> values, const std::vector<bool>& held) = nullptr;
  /// Whether the values that are held (NaN: not held) leave a parameter without meaning; null: never.
  bool (*idle)(std::size_t parameter, std::span<const double> held) = nullptr;

  /// Whether a fit needs the samples alone, because no parameter has to be held.
  bool fits_alone() const {
    for (const ModelParameter& p : parameters) {
      if (!p.fitted && !p.fallback) return false;
    }
    return true;
  }
};

}  // namespace dwell
