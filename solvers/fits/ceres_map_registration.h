#pragma once

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/numerics/plane_transform.h"
#include "solvers/fits/registration_start.h"
#include "solvers/fits/spike_removal.h"

namespace dwell {

struct RegistrationOptions {
  bool rotation = true;     // whether the fit may rotate the moving map
  bool scale = false;       // whether it may magnify the moving map
  bool level = true;        // whether it may add piston and tilt to it, in which two measurements nearly always differ
  RegistrationRange range;  // of the coarse search for a start; zero range = start where the maps lie
};

/// A number that was fitted and its standard error; 0 and 0 (scale: 1 and 0) if it was not free.
struct Estimate {
  double value = 0.0, error = 0.0;
};

/// How large the difference of two maps is at the pixels compared, without spikes.
struct DifferenceSize {
  double rms = 0.0;      // [nm]
  double scatter = 0.0;  // 1.4826 times the median absolute one: what the RMS would be without dust [nm]
};

struct MapRegistration {
  Estimate x, y;             // shift of the moving map's middle [mm]
  Estimate degrees;          // counter-clockwise about it
  Estimate scale{1.0, 0.0};  // lateral magnification about it
  PlaneTransform transform;  // from places on the moving map to places on the fixed one
  DifferenceSize before;     // of the maps as they lie, level taken out if it is free; NaN if they do not overlap there
  DifferenceSize after;      // of the registered maps
  Index spikes_moving = 0;   // pixels left out of the moving map
  Index spikes_fixed = 0;    // and of the fixed one
  Index points = 0;          // compared
  int iterations = 0;        // of the fit
};

/// Brings `moving` onto `fixed`: minimises sum rho(fixed(p) - moving(T^-1 p) - level) over pixels p of the fixed map
/// with data in both. T is a shift, rotation and scale about the middle of the moving map's pixel centres; between its
/// pixels the moving map is a cubic B-spline. rho is Cauchy's loss with a scale of 2.3849 robust standard deviations of
/// the residual (95 % efficiency, Holland and Welsch 1977), so that dust and dropouts hardly count. First, lone spikes
/// are left out of both maps: pixels that differ from the median of kSpikeWindow x kSpikeWindow around by more than
/// kSpikeSigmas robust standard deviations of that window (core/map/map_outliers.h) and by more than kLeastSpike robust
/// standard deviations of the whole map from its plane. Features three pixels wide or more at half height stay. The fit
/// is by Ceres (Levenberg-Marquardt); the pixels and the scale of rho are chosen anew, up to ten times, until the fit
/// no longer changes. At most kRegistrationPoints pixels, evenly chosen. Standard errors: sigma^2 (J' W J)^-1 for
/// independent errors of equal size; where neighbouring errors are correlated (nearly always) the true ones are larger.
/// Throws InputError if the maps do not overlap or say nothing about a free number (flat, or alike under a rotation),
/// Interrupted. Cost: the start, then O(points) an iteration.
MapRegistration register_maps(const HeightMap& moving, const HeightMap& fixed, const RegistrationOptions& options,
                              int threads = 1, const Progress& progress = {});

inline constexpr Index kRegistrationPoints = 200000;

}  // namespace dwell
