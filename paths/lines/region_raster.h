#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/tool_path.h"
#include "paths/domain/region_labels.h"

namespace dwell {

/// How a region is rastered.
struct RegionLines {
  std::int32_t region = 1;
  double pitch = 1.0;      // between lines [mm]
  double step = 1.0;       // between the points of a line [mm]
  double angle_deg = 0.0;  // of the lines
  double anchor = 0.0;     // points lie whole steps from here along the lines [mm]; all regions share it
  double reach = 0.0;      // of the region beyond the part, as given to RegionLabels; >= hypot(pitch, step) / 2 [mm]
  double link = 0.0;       // longest move that is made on the part [mm]
  double most_points = 0;  // refused beyond
};

/// Appends a raster over one region, of any shape, with holes and of any number of pieces.
///
/// Lines and points lie on one lattice, symmetric about the middle of the bounding box of the region's pixel centres,
/// as in paths/lines/raster.h. A lattice point is taken if it lies in the region; so is, for a pixel centre that would
/// otherwise have no lattice point within max(pitch, step) (on a sliver between two lines), the one nearest to it.
/// Every pixel centre of the region is therefore within max(pitch, step) of a point and, except next to another region,
/// within pitch / 2 of a line.
///
/// A run is a stretch of a line; gaps of up to `link` within a line are crossed on the part, longer ones end the run.
/// From the end of a run the path goes on, with the tool down, to the nearest end of a run on the same or a
/// neighbouring line that is within `link` (among equally near ends, one on the next line in the present direction). If
/// there is none, it goes lifted to the nearest of all ends that are left. The move to the first point is lifted.
///
/// `pixels`: the region's, linear indices into the map's grid. Returns the number of lifted moves after the first
/// point. Throws InputError above most_points. Cost O(lattice points of the bounding box + runs log runs).
Index append_region(const RegionLabels& labels, const Grid& grid, const std::vector<Index>& pixels,
                    const RegionLines& lines, ToolPath& path, const Progress& progress = {});

}  // namespace dwell
