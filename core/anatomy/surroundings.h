#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// How far a pixel is from its surroundings.
struct Deviation {
  double middle = 0.0;  // of the surroundings: the median of their pair means [nm]
  double sigma = 0.0;   // their robust standard deviation [nm]
  double height = 0.0;  // of the pixel above the middle [nm]
  double step = 0.0;    // the median half difference of the two of a pair [nm]; not of a glance
};

/// The surroundings of a pixel of a map: pairs of pixels that lie opposite each other about it, half to all of `reach`
/// away. The mean of a pair is free of any slope, so that a steep surface is no deviation. Beside an edge of the part,
/// where few pairs have both of their pixels, the pairs are those along the pixel's row and column, so that what runs
/// along the edge of a rectangle is none either; where they are too few as well, those that there are (docs/math.md,
/// "Blemishes"). The median of the pair means is the middle. A pair mean scatters by 1 / sqrt 2 of what a pixel does,
/// so sigma is sqrt 2 times 1.4826 median absolute deviations of them. Either holds while fewer than half of the pairs
/// are spoilt.
class Surroundings {
 public:
  /// Pairs of which a deviation is made, and the fewest that do.
  static constexpr Index kPairs = 64, kFewestPairs = 12;
  /// Most ways to them all round the pixel; besides, there are those along its row and its column, from half of the
  /// reach to kAlongEdge times it.
  static constexpr Index kAllRound = 768;
  static constexpr double kAlongEdge = 1.5;
  /// Pairs of a glance, which must be cheap.
  static constexpr Index kGlancePairs = 8;
  /// Where fewer than two in three of the first ways lead to a pair, the pixel is beside an edge.
  static constexpr Index tries(Index pairs) { return pairs + pairs / 2; }

  /// `reach` [mm] > 0; at least kLeastReach pixels are taken, so that there are pairs enough. The map must outlive
  /// this.
  Surroundings(const HeightMap& map, double reach);
  static constexpr double kLeastReach = 12.0;

  /// Nothing where the pixel has no data or too few pairs have. Cost about 1 us, beside an edge up to 5.
  std::optional<Deviation> deviation(Index row, Index col) const;
  /// The same from eight pairs; sigma from the distance of the third from the sixth of them in order: right to a third
  /// of itself. Cost about 0.1 us.
  std::optional<Deviation> glance(Index row, Index col) const;
  /// glance() at a whole row: heights and sigmas, a value a column, NaN where it gives nothing. Cost about 0.02 us a
  /// pixel away from edges and lost pixels.
  void glance_at_row(Index row, std::span<double> heights, std::span<double> sigmas) const;

  /// The way from a pixel to one of a pair [pixels]; the other lies opposite.
  struct Way {
    Index rows, cols;
  };
  /// All ways, in the order in which they are tried: any first few of them lie evenly about the pixel.
  const std::vector<Way>& ways() const { return ways_; }

 private:
  /// Whether all ways round the pixel end on the map.
  bool is_within(Index row, Index col) const;
  /// Calls take(one, other) for the pairs of which both pixels have data, by the ways `from` to `to` in order, until it
  /// says no; whether it never did.
  template <class Take>
  bool for_pairs(Index row, Index col, Index from, Index to, const Take& take) const;

  const HeightMap& map_;
  Index all_round_ = 0;  // ways that are; those along the row and the column follow
  std::vector<Way> ways_;
  std::vector<Index> steps_;                 // of the ways, in the map's values
  Index most_rows_ = 0, most_cols_ = 0;      // of all ways round the pixel
  Index glance_rows_ = 0, glance_cols_ = 0;  // of those of a glance
};

}  // namespace dwell
