#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/point.h"
#include "core/map/height_map.h"

namespace dwell {

/// How a measured removal function is placed on the tool axis: at its centroid, at the middle of its grid, at the apex
/// of its rounded top (core/tif/removal_apex.h), or at a point given in the coordinates of its file.
struct TifCentre {
  enum class Kind { Centroid, Middle, Peak, Given } kind = Kind::Middle;
  Point given;
};

/// What dwell tif ends the history of its files with: their coordinates are relative to the tool axis.
inline constexpr const char* kToolAxisAtOrigin = "tif: tool axis at 0,0";

/// What the file of a removal function says of it, before it is placed on the tool axis and turned.
struct TifFile {
  Point axis;                // of the tool, in the coordinates of the file [mm]
  std::string axis_from;     // where that comes from: "the middle of its grid", "`tif centre` centroid", ...
  double peak = 0.0;         // largest rate, before a pedestal was mended, as the next three [nm/s]
  double rim = 0.0;          // mean rate at the rim of its data [nm/s]
  double rim_largest = 0.0;  // the largest there [nm/s]
  double noise = 0.0;        // robust scatter of the rates there [nm/s]

  /// Of the rates as they are used, where a pedestal was mended.
  struct Mended {
    double peak = 0.0, rim = 0.0, rim_largest = 0.0;  // [nm/s]
  };
  std::optional<Mended> mended{};
};

/// The removal function (tool influence function, TIF): removal rate [nm/s] at a displacement from the tool axis
/// [mm]. Rows are y, columns are x, as in a map: the sample at displacement d acts on the part at p + d when the
/// tool stands at p.
struct RemovalFunction {
  enum class Kind { Gaussian, Disc, Measured, Model };

  Kind kind = Kind::Gaussian;
  double peak = 0.0;    // largest rate [nm/s]
  double volume = 0.0;  // volume rate, integral of the rate over the plane [nm mm^2 / s]
  double fwhm = 0.0;    // diameter of the disc that has the area where rate >= peak / 2 [mm]
  double radius = 0.0;  // no removal farther than this from the axis, along x or y [mm]
  double sigma = 0.0;   // Gaussian only [mm]
  double slope = 0.0;   // Disc only: rate = slope * r [nm/s/mm]
  HeightMap samples;    // Measured and Model: rates on their own grid, NaN read as 0, origin relative to the tool axis
  std::optional<TifFile> file;     // Measured only, where it was read from a file of rates
  std::vector<std::string> notes;  // what its user should know of it (core/tif/tool_questions.h), a sentence each
  std::string model;  // Model only: which formula the samples were computed from (core/tif/models/removal_models.h)
};

/// Gaussian cut off at `radius`: b(r) = peak exp(-r^2 / 2 sigma^2) for r <= radius. peak [nm/s], fwhm and radius
/// [mm], all > 0.
RemovalFunction gaussian_removal(double peak, double fwhm, double radius);

/// Disc of radius R spinning about its axis under uniform pressure (Preston): b(r) = slope r for r <= R
/// (Lin et al. 2014, section 2). slope [nm/s/mm], radius [mm], both > 0.
RemovalFunction spinning_disc_removal(double slope, double radius);

/// Measured rates [nm/s] on a regular grid. Throws InputError if all are NaN, none is positive, the centroid is asked
/// for and the sum is not positive, or the peak is asked for and its top is not rounded.
RemovalFunction measured_removal(const HeightMap& rates, const TifCentre& centre);

/// "gaussian", "disc", "measured", or the name of the model.
std::string kind_of(const RemovalFunction& tif);

}  // namespace dwell
