#pragma once

#include <optional>

#include "core/map/height_map.h"
#include "core/spectra/transfer_function.h"
#include "core/tif/removal_function.h"

namespace dwell {

/// What a removal function is like, from its samples [nm/s].
struct RemovalAnalysis {
  double peak = 0.0;    // largest rate [nm/s]
  double volume = 0.0;  // [nm mm^2/s]
  Point peak_at;        // where the largest sample is, from the tool axis [mm]
  Point centroid;       // from the tool axis [mm]
  double fwhm = 0.0;    // diameter of the disc of the area above half the peak [mm]
  double fwhm_x = 0.0;  // distance between the outermost points at half the peak on the line through the centroid along
  double fwhm_y = 0.0;  // x (y); 0 if the line stays below half [mm]
  double radius = 0.0;  // of the disc about the centroid that holds 99 % of the volume [mm]
  double sigma_major = 0.0, sigma_minor = 0.0;  // roots of the second moments along their main axes [mm]
  double angle = 0.0;                           // of the major axis, -90 .. 90, counter-clockwise from +x [deg]
  /// RMS difference from the mean over all directions about the centroid, over the RMS: 0 for rotational symmetry.
  double asymmetry = 0.0;
  TransferFunction transfer;
  struct Waves {
    std::optional<double> x, y, radial;  // wavelength down to which the response is at least the share [mm]
  };
  Waves at_half, at_tenth;  // 50 %; 10 %: the finest error that it can correct
};

/// Throws InputError if no sample is finite, if none is positive, or if the volume is not positive. NaN counts as zero.
/// Cost: that of transfer_function.
RemovalAnalysis analyse_removal(const HeightMap& rates, int threads = 1);

/// The same without the transfer function and its waves. Cost O(samples), and 180 places of a spline for every half
/// pitch of radius.
RemovalAnalysis analyse_shape(const HeightMap& rates);

/// The analysis of the samples of a removal function, with the figures that its formula gives exactly in the place of
/// those of the samples: of a Gaussian and a spinning disc peak, volume, widths, and that they are symmetric about the
/// axis. Others are returned as they are. The width of equal area of a disc is that of the ring above half the peak,
/// sqrt(3) times its radius.
RemovalAnalysis with_exact_figures(RemovalAnalysis analysis, const RemovalFunction& tif);

}  // namespace dwell
