#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

/// What is not of the surface's form but on it or in it: dust, a scratch, a fiducial, a pit.
struct Blemish {
  Point place;                // the mean of its pixels' centres [mm]
  double length = 0.0;        // of the line along which it is longest, pixels included [mm]
  double width = 0.0;         // where it is thickest (blemish_width) [mm]
  double height = 0.0;        // of its highest or lowest pixel over its surroundings [nm]: below zero for a pit
  std::vector<Index> pixels;  // linear indices, ascending
  std::vector<double> level;  // of the surroundings at each of them [nm]
};

struct BlemishOptions {
  double width = 0.0;   // blemishes are narrower than this: the tool's FWHM [mm]; > 0
  double sigmas = 8.0;  // how far a pixel of one is from its surroundings, in their robust standard deviations; > 0
  bool of_fit = false;  // the map is what a fit has left (kHigherThanItsHalo)
};

/// Of what a fit leaves, a cluster is no blemish if it lies on the other side of its surroundings than a blemish this
/// many times as high whose middle is less than `width` away: a fit that cannot remove the one makes the other around
/// it.
inline constexpr double kHigherThanItsHalo = 2.0;

/// Of the sigmas, what a pixel needs to belong to a blemish if it touches one that is beyond all of them, and lies on
/// the same side of the surroundings.
inline constexpr double kBlemishSkirt = 0.5;

/// How far a pixel of a blemish must be from its surroundings, in half of what opposite pixels of these typically
/// differ. A pixel beside a step, as where maps were stitched, is one such half from them, and no blemish.
inline constexpr double kBeyondStep = 1.5;

/// The least standard deviation of surroundings that is assumed, of the median one of the whole map. What stands out of
/// a quiet stretch alone, by less than this, is not looked for: it counts for next to nothing.
inline constexpr double kQuietest = 0.5;

/// Clusters of pixels that touch each other, also by a corner, of which one at least lies beyond `sigmas` robust
/// standard deviations of its surroundings (core/anatomy/surroundings.h, reach = width), and that are narrower than
/// `width`. They come in the order of their squares: the one with the most first. Throws InputError for options out of
/// range, Interrupted. Deterministic, whatever the number of threads. Cost O(pixels), some 0.1 us each.
std::vector<Blemish> find_blemishes(const HeightMap& map, const BlemishOptions& options, int threads = 1,
                                    const Progress& progress = {});

/// The largest, over the pixels of a cluster, of the least length of the runs through it along its row, its column and
/// both diagonals [mm]: the diameter of a disc, the thickness of a scratch, however long or bent it is. `pixels`
/// ascending.
double blemish_width(const Grid& grid, const std::vector<Index>& pixels);

/// The map without the pixels of blemishes.
HeightMap without_blemishes(HeightMap map, const std::vector<Blemish>& blemishes);

}  // namespace dwell
