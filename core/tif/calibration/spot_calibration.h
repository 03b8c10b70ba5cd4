#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/map/height_map.h"
#include "core/tif/calibration/spot_registration.h"

namespace dwell {

/// Where the tool axis is in a calibrated spot.
enum class SpotCentre {
  Centroid,  // of what is above a tenth of the peak
  Peak,      // apex of the paraboloid fitted to what is above 70 % of the peak
  Given      // the positions that the tool was sent to (`at`), on the mean over the spots
};

struct SpotOptions {
  double dwell_time = 0.0;       // that the tool stood on each spot [s], finite and > 0
  std::vector<Point> at;         // where the spots are, about [mm]; empty: found (core/tif/calibration/spot_finder.h)
  std::optional<double> radius;  // how far a spot reaches [mm]; default: 2.25 times as far as 30 % of the peak, less
                                 // where edge or neighbour are nearer
  double noise_cut = 0.01;       // share of the peak below which a rate is set to 0, 0 .. 0.5
  double noise_sigmas = 0.0;     // scatters of the surroundings below which it is, >= 0
  SpotCentre centre = SpotCentre::Centroid;
  SpotBaseline baseline = SpotBaseline::Plane;
  SpotRegistration registration = SpotRegistration::LeastSquares;
};

/// "centroid", "peak", "at"; "plane", "constant", "none"; "centroid", "least-squares". Throw InputError.
SpotCentre parse_spot_centre(const std::string& text);
SpotBaseline parse_spot_baseline(const std::string& text);
SpotRegistration parse_spot_registration(const std::string& text);

/// One of the spots of a calibration.
struct CalibratedSpot {
  Point position;        // as registered [mm in the map]
  double peak = 0.0;     // [nm/s]
  double volume = 0.0;   // within the radius [nm mm^2/s]
  double scatter = 0.0;  // of the surroundings [nm/s]
};

/// A removal function measured as spots in a surface.
struct SpotCalibration {
  HeightMap rates;      // mean over the spots [nm/s], cut and centred: origin relative to the tool axis, history
  HeightMap deviation;  // standard deviation over the spots at each pixel [nm/s]; zero for one spot
  std::vector<CalibratedSpot> spots;
  double radius = 0.0;      // [mm]
  double volume_cut = 0.0;  // share of the volume within the radius that the noise cut took away (negative: it added)
  Index filled_pixels = 0;  // without data within the radius, filled from their neighbours
};

/// Removed depth: before - after, positive where the surface went down. NaN where either has no data. Throws InputError
/// if the grids differ in size, or by more than 1e-6 pitches in pitch or a hundredth of a pixel in origin.
HeightMap removed_depth(const HeightMap& before, const HeightMap& after);

/// The removal function from the removed depth [nm] (removed_depth, or minus the map after where the surface was flat
/// before: level and tilt go with the baseline). Each spot is cut out and its baseline taken off; the spots are
/// registered to each other, averaged and divided by the dwell time; the mean is set to zero below the noise and beyond
/// the radius, and centred. Throws InputError naming the spot or the option: also if before and after seem to be
/// swapped (the volume is not positive), and if a spot is registered too far from its place in `at`, by more than a
/// pixel plus half the diameter of the disc that has its area above half its peak. Cost O(pixels of the map + 100 times
/// those of the spots).
SpotCalibration calibrate_spots(const HeightMap& depth, const SpotOptions& options);

}  // namespace dwell
