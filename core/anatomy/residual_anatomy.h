#pragma once

#include <vector>

#include "core/anatomy/blemishes.h"
#include "core/anatomy/edge_zone.h"
#include "core/form/form_terms.h"
#include "core/form/map_statistics.h"
#include "core/map/height_map.h"

namespace dwell {

/// Parts of a mean square [nm^2]. Each pixel counts in one of the first two, or in the interior, which its wavelengths
/// divide; so the five add up to the whole.
struct ResidualShares {
  double blemishes = 0.0;  // and what they add to the form terms of the others
  double edge = 0.0;       // the zone at the edge, without blemishes
  double shorter = 0.0;    // interior: wavelengths up to the tool's FWHM
  double middle = 0.0;     // from one to three times the FWHM
  double longer = 0.0;     // from three times on, and the interior's mean

  double interior() const { return shorter + middle + longer; }
  double whole() const { return blemishes + edge + interior(); }
};

inline constexpr double kLongInFwhm = 3.0;

/// What a residual consists of, for a tool of a FWHM.
struct ResidualAnatomy {
  double fwhm = 0.0;               // [mm]
  ResidualShares mean_square;      // parts of the mean square about zero over all pixels
  std::vector<Blemish> blemishes;  // the one with the most squares first
  std::vector<double> of_blemish;  // the mean square that each holds [nm^2]
  bool searched = true;            // for blemishes
  EdgeZone edge;
  Index pixels = 0;  // with data
  Index blemish_pixels = 0;
  Index edge_pixels = 0;  // of the zone, without blemishes
  MapStatistics without;  // of the other pixels alone, the form terms removed from these anew

  /// A part of the whole, from 0 to 1; 0 of nothing.
  double share(double part) const;
  /// The mean squares of an edge pixel and of one of the interior [nm^2]; 0 where there is none.
  double edge_density() const;
  double interior_density() const;
};

enum class BlemishSearch { On, Off };

/// Splits the mean square of a residual map [nm], form terms removed. `form` is that for `without`. The interior's
/// waves are weighed by the power spectrum of the interior under a Hann window, blemishes replaced by the level of
/// their surroundings, and scaled to its mean square (docs/math.md, "What is left"). Throws InputError if no pixel is
/// finite or `fwhm` is not > 0, Interrupted. Cost: find_blemishes and one FFT of the interior.
ResidualAnatomy residual_anatomy(const HeightMap& residual, double fwhm, const FormTerms& form, int threads = 1,
                                 BlemishSearch search = BlemishSearch::On, const Progress& progress = {});

}  // namespace dwell
