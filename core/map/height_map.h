#pragma once

#include <string>
#include <vector>

#include "core/base/grid.h"

namespace dwell {

/// What the values of a map are: heights [nm] or removal rates [nm/s].
enum class MapQuantity { Height, Rate };

/// A map of heights over a grid [nm], row-major, NaN = no data (outside the part). Also carries removal functions
/// [nm/s] and residuals: any scalar over the part.
struct HeightMap {
  Grid grid;
  std::vector<double> values;        // grid.size(), row-major
  std::vector<std::string> history;  // how it was made from what was measured, a step each (one line), oldest first
  MapQuantity quantity = MapQuantity::Height;  // files state it as the unit, so that neither is read as the other
  bool unit_assumed = false;  // read from a file that states no unit, without an option that does: nm (nm/s) was taken

  HeightMap() = default;
  /// All pixels NaN. Throws InputError unless rows, cols >= 1 and both pitches are finite and > 0.
  explicit HeightMap(const Grid& grid);
  HeightMap(const Grid& grid, std::vector<double> values);

  double& at(Index row, Index col) { return values[static_cast<std::size_t>(grid.index(row, col))]; }
  double at(Index row, Index col) const { return values[static_cast<std::size_t>(grid.index(row, col))]; }

  /// Number of finite pixels.
  Index valid_pixels() const;
};

/// Linear indices of the finite pixels of a map, ascending.
std::vector<Index> finite_pixels(const HeightMap& map);

}  // namespace dwell
