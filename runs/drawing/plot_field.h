#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// A scalar over a rectangle of the part, already on the pixels of the figure that will show it.
struct PlotField {
  int cols = 0;
  int rows = 0;
  std::vector<double> values;                               // row-major, row 0 = smallest y; NaN = nothing there
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;  // outer edges [mm]

  double& at(int row, int col) { return values[index(row, col)]; }
  double at(int row, int col) const { return values[index(row, col)]; }
  std::size_t index(int row, int col) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(col);
  }
};

/// Longest edge of a field on the figure [pixels].
struct FieldEdges {
  int square = 1040;   // of square-ish ones, so that the whole figure fits a page
  int longest = 1280;  // at kLongAspect : 1 and beyond
};
inline constexpr double kLongAspect = 2.0;

/// A map at the resolution of the figure, true to its pitches. Small maps are enlarged by an integer (the finer pitch,
/// if they differ). Of large ones, each pixel of the figure shows the mean of a block without its NaN. Where one height
/// of the block stands out (it is farther from the mean than kPeakOverTypical times what is usual in other blocks, and
/// than kPeakOverSpan of the span of the means), the pixel shows that height instead, because dust must not vanish in a
/// mean. An edge that would come out thinner than 8 pixels is stretched to that. Throws Interrupted. Cost O(map +
/// figure).
PlotField field_of_map(const HeightMap& map, const FieldEdges& edges = {}, const Progress& progress = {});

inline constexpr double kPeakOverTypical = 5.0;
inline constexpr double kPeakOverSpan = 0.02;

/// Dwell at the places of a path: each pixel of the picture shows the nearest dwell point among those whose square
/// covers it. The side of a point's square is 1.75 times its spacing. The spacing is the third smallest of the
/// distances to the nearest point in each quadrant: on a raster that is the larger of step and line pitch, inside, on
/// the edge and in a corner, so that the squares leave no holes. Points that share a pixel show their mean. Points
/// whose dwell is not finite are not shown. Throws InputError if the path is invalid or dwell has another size,
/// Interrupted. Cost O(points + figure).
PlotField field_of_dwell(const ToolPath& path, const std::vector<double>& dwell, const FieldEdges& edges = {},
                         const Progress& progress = {});

}  // namespace dwell
