#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "core/tif/removal_function.h"
#include "paths/domain/path_distance.h"

namespace dwell {

struct MultiPitchOptions {
  int ranges = 4;               // of removal depth, 1 .. 100 (3 to 6 in the paper); not with pitches or depths
  std::vector<double> pitches;  // of the ranges, shallowest first [mm], finite and > 0; default: by eq. 10
  std::vector<double> depths;   // between the ranges [nm above the lowest], ascending, > 0; default: equal ranges
  /// Narrowest [mm], > 0; not with pitches. Default: a sixtieth of the TIF's size, because narrower pitches remove
  /// hardly any more ripple while the path grows without bound; and at least 0.01, as finely as a machine positions.
  std::optional<double> min_pitch;
  std::optional<double> max_pitch;  // widest [mm], >= min_pitch; default: a sixth of the TIF's size; not with pitches
  std::optional<double> step;       // between dwell points of a line [mm], > 0; default: a twelfth of the TIF's size
  double angle_deg = 0.0;           // direction of the lines, counter-clockwise from +x; finite
  std::optional<double> overrun;    // beyond the part's edge [mm], finite and >= 0; default: the TIF's radius
  double lift = 5.0;  // moves and gaps longer than lift * max(pitch, step) are made lifted, >= 1; infinity = never
  std::optional<double> smooth;  // square over which depth is averaged before it is cut into ranges [mm], finite, >= 0;
                                 // default: a sixth of the TIF's size
};

/// From "multi-pitch:..." or "multi-pitch" alone; throws InputError as SpecText does.
MultiPitchOptions parse_multi_pitch_options(const SpecText& spec);

/// The distances of tracks and dwell points that these options ask for.
std::vector<PathDistance> multi_pitch_distances(const MultiPitchOptions& options);

/// Neighbouring ranges of removal depth that have one pitch, and their part of the path.
struct PitchRegion {
  enum class Limit { None, Narrowest, Widest, Given };  // what made the pitch differ from eq. 10

  double from = 0.0, to = 0.0;  // removal depth [nm above the lowest]
  double depth = 0.0;           // r_k of eq. 9: the depth that the pitch is for [nm]
  double pitch = 0.0;           // [mm]
  Limit limit = Limit::None;
  std::size_t pixels = 0;       // of the map
  std::size_t first_point = 0;  // in the path
  std::size_t points = 0;
  Index lifts = 0;  // within the region
};

struct MultiPitchPath {
  ToolPath path;
  std::vector<PitchRegion> regions;  // in path order, shallowest first; those without a pixel left out
  double lowest = 0.0;               // height of the target that counts as depth 0 [nm]
  double step = 0.0;                 // [mm]

  /// The distance between lines at every dwell point [mm].
  std::vector<double> pitch_of_points() const;
};

/// The depths r_k and pitches d_k of eq. 9 and 10 from the depths between ranges, 0 = borders[0] < ... < borders[m]
/// (all equal to 0 allowed: nothing to remove): r_1 = borders[1] / 2, r_k = borders[k - 1]; d_k = volume / (r_k
/// max_feed) within [min_pitch, max_pitch]. volume [nm mm^2/s], max_feed [mm/s].
std::vector<PitchRegion> pitches_by_depth(const std::vector<double>& borders, double volume, double max_feed,
                                          double min_pitch, double max_pitch);

/// Raster whose pitch follows the removal depth (Hou, Liao, Wang 2017, section "Development of the multi-pitch tool
/// path"): deep regions get narrow pitches, which leave little ripple, and shallow ones wide pitches, so that the tool
/// need not run faster than max_feed.
///
/// The removal depth of a pixel is the target minus the lowest target, both after averaging over `smooth` (a mean over
/// the valid pixels of a square): noise of single pixels then neither sets the zero nor breaks up the regions. Depths
/// up to the highest are cut into `ranges` of equal width (eq. 4-5) or at `depths`; a pixel belongs to the range in
/// which its depth lies, and to the deeper one if it lies on a border. Pitches by pitches_by_depth, or given.
/// Neighbouring ranges of equal pitch make one region. Every region is a raster of its own
/// (paths/lines/region_raster.h: coverage, gaps, lifts), one after the other from the shallowest, with a lift between.
/// Regions do not overlap; beyond the part's edge, within max(overrun, half the diagonal of pitch and step, half that
/// of a pixel), a point belongs to the region of the nearest valid pixel.
///
/// max_feed [mm/s]: needed unless pitches are given. Size of the TIF = 2 radius. Throws InputError naming the option,
/// its value and what is required; also above 50 million points. Cost O(pixels + lattice points of the regions' boxes).
MultiPitchPath multi_pitch_path(const HeightMap& map, const RemovalFunction& tif, double max_feed,
                                const MultiPitchOptions& options, const Progress& progress = {});

}  // namespace dwell
