#pragma once

#include "core/form/form_terms.h"
#include "core/form/map_statistics.h"
#include "core/map/height_map.h"
#include "core/removal/removal_probe.h"

namespace dwell {

/// The surface that a program leaves, from the removal function itself.
struct ExactResidual {
  HeightMap surface;            // form terms removed: exact at the pixels looked at, by the lattice at others [nm]
  MapStatistics statistics;     // of the mean over every pixel, form terms removed [nm]
  double standard_error = 0.0;  // of statistics.rms; 0 if every pixel was looked at [nm]
  double lattice_rms = 0.0;     // what the lattice says of the same [nm]
  double lattice_error = 0.0;   // RMS of the lattice's removal less the exact one, form terms removed [nm]
  double ripple = 0.0;          // RMS of the removal within pixels, finer than their means show [nm]
  double ripple_error = 0.0;    // standard error of `ripple`, which is from a few places in some pixels [nm]
  Index checked = 0;            // pixels that were looked at
  bool all = false;             // whether these are all

  /// Pixels and what is within them: sqrt(RMS about zero^2 + ripple^2) [nm].
  double total() const;
};

/// How many pixels are looked at.
enum class ExactCheck {
  Lattice,    // some, by which `lattice_error` is known to a tenth of itself; no ripple
  Figure,     // as many as bring the standard error of `statistics.rms` below 1 % of it, or all where that is cheap
  EveryPixel  // all
};

/// `map` is the surface before, `left` what the lattice says that the program leaves of it, form terms included [nm].
/// Only the difference between the lattice and the probe is estimated, so few pixels do: those with the largest
/// residuals, and others at random. The largest and smallest residual are among the former. The ripple is taken in
/// pixels of its own, which depend on the map alone: the same program has the same, whatever the lattice. `progress`
/// shows the share done; throws Interrupted. The same input gives the same bytes. Cost: mean_removal of the pixels.
ExactResidual exact_residual(const RemovalProbe& probe, const HeightMap& map, const HeightMap& left,
                             const FormTerms& form, int threads, const Progress& progress = {},
                             ExactCheck check = ExactCheck::Figure);

}  // namespace dwell
