#pragma once

#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// Which pixels lie outside the data: those without data (not finite) that are joined by their sides, over others
/// without data, to the edge of the grid. One a pixel. Cost O(pixels).
std::vector<char> outside_data(const HeightMap& map);

/// For each pixel with data how far it is from the rim of the data, in steps to one of the eight neighbours: 0 for
/// those at the edge of the grid or beside a pixel outside the data (outside_data). -1 for pixels without data. Cost
/// O(pixels).
std::vector<Index> steps_from_rim(const HeightMap& map);

/// The rates at the rim of the data of a removal function, where it should remove nothing.
struct RateRim {
  Index samples = 0;
  double mean = 0.0;     // [nm/s]
  double largest = 0.0;  // [nm/s]
  Point largest_at;      // [mm]
  double scatter = 0.0;  // about the median, from the median absolute deviation [nm/s]
};

/// Cost O(pixels). All zero where no pixel is finite.
RateRim rate_rim(const HeightMap& rates);

}  // namespace dwell
