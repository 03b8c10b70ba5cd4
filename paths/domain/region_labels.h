#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "paths/domain/path_domain.h"

namespace dwell {

/// A part cut into regions that do not overlap. A region is a whole number from 1 on; 0 is outside.
///
/// A pixel's own area (pitch_x by pitch_y about its centre) belongs to the pixel's region. Beyond the part, and in its
/// holes, a point belongs to the region of the valid pixel nearest to the centre of the pixel area it lies in (the
/// map's grid goes on), if it is within that region's reach of some valid pixel centre.
class RegionLabels {
 public:
  /// regions: one a pixel of the map, 1 .. reaches.size() where the map is finite, else 0; reaches [mm], finite and >=
  /// 0, one a region. Throws InputError if the map has no finite pixel or has more than 1e8 pixels with a margin of the
  /// longest reach. `planner` begins the messages. Cost and memory O(pixels with the margin).
  RegionLabels(const HeightMap& map, const std::vector<std::int32_t>& regions, const std::vector<double>& reaches,
               const char* planner, const Progress& progress = {});

  /// The region of a point, 0 outside. Cost O(1), except for points about as far from the part as the reach.
  std::int32_t at(Point p) const {
    const double col = (p.x - origin_.x) * per_pitch_.x, row = (p.y - origin_.y) * per_pitch_.y;
    if (!(col >= 0.0 && row >= 0.0 && col < cols_ && row < rows_)) return 0;
    const std::int32_t label =
        labels_[static_cast<std::size_t>(static_cast<Index>(row) * grid_.cols) + static_cast<std::size_t>(col)];
    return label >= 0 ? label : undecided(p, -label);
  }

 private:
  std::int32_t undecided(Point p, std::int32_t region) const {
    return distance_.within(p, padded_[static_cast<std::size_t>(region)]) ? region : 0;
  }

  Grid grid_;        // with the margin
  Point origin_;     // its lower left corner
  Point per_pitch_;  // 1 / pitch
  double rows_ = 0.0, cols_ = 0.0;
  std::vector<double> padded_;        // reach of a region, points exactly that far away included
  std::vector<std::int32_t> labels_;  // of grid_: the region, minus the region where the reach decides, or 0
  DistanceMap distance_;
};

}  // namespace dwell
