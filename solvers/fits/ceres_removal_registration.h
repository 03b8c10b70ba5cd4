#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/form/form_terms.h"
#include "core/map/height_map.h"
#include "core/numerics/plane_transform.h"
#include "solvers/fits/ceres_map_registration.h"

namespace dwell {

/// A removal that a simulation predicts, for tools of several widths.
struct PredictedRemoval {
  std::vector<double> widths;       // over that of the tool as it is known, ascending; one or three
  std::vector<HeightMap> removals;  // [nm] for each, on one grid that reaches beyond the measured one
};

/// What a fit may change of it.
struct RemovalRegistrationOptions {
  bool rate = true;      // how much the tool removes in a second
  bool shift = true;     // where it removed
  bool rotation = true;  // how that lies against the measured part, turned about the middle of the prediction's data
  bool scale = false;    // and magnified
  bool width = true;     // of the tool; needs three widths
  /// Form terms that may differ between the measurements.
  FormTerms level{true, true};
  /// Errors that lie closer than this are not independent: about the width of the tool [mm]. 0 = all are.
  double correlated_mm = 0.0;
};

/// How a removal that was measured lies against the predicted one, and by how much it differs from it.
struct RemovalRegistration {
  Estimate rate{1.0, 0.0};    // volume that the tool takes in a second, over what was thought
  Estimate width{1.0, 0.0};   // of the tool, over what was thought
  Estimate x, y;              // shift of the removal on the part [mm]
  Estimate degrees;           // counter-clockwise about `about`
  Estimate scale{1.0, 0.0};   // magnification about it
  Point about;                // [mm]
  PlaneTransform transform;   // from where removal was predicted to where it was measured
  double measured_rms = 0.0;  // of the measured removal at these pixels, level taken out if it is free [nm]
  DifferenceSize before;      // measured less predicted, level taken out if it is free [nm]
  DifferenceSize after;       // the same with all that was fitted
  Index spikes = 0;           // pixels of the measured map that were left out
  Index points = 0;           // compared
  int iterations = 0;
};

/// Fits measured(p) = rate P(T^-1 p; width) + level by robust least squares (Ceres, Cauchy's loss as in register_maps),
/// with P the predicted removal: cubic B-splines between its pixels and a parabola between its widths. T shifts,
/// rotates and magnifies about the middle of the prediction's data. Standard errors are the larger of those for
/// independent errors of equal size and of those by sums over squares of `correlated_mm` (the sandwich estimate of
/// White 1980, by clusters), which hold, but for a tenth where clusters are few, where errors are alike over the width
/// of a tool: drift, metrology, the tool's own shape. The start is as predicted: a shift beyond about half of the
/// finest waves needs coarse_registration before. Throws InputError for maps that do not overlap or a prediction that
/// says nothing about a free number, Interrupted. Cost O(points) an iteration; at most kRemovalPoints points.
RemovalRegistration register_removal(const PredictedRemoval& predicted, const HeightMap& measured,
                                     const RemovalRegistrationOptions& options, int threads = 1,
                                     const Progress& progress = {});

inline constexpr Index kRemovalPoints = 40000;

}  // namespace dwell
