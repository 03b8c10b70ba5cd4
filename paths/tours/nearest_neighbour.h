#pragma once

#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "paths/domain/path_distance.h"

namespace dwell {

struct NearestOptions {
  double cell = 0.0;           // side of the square cells [mm], finite, at least the map's pixel pitch; required
  double critical = 0.0;       // cells of mean below this [nm] are left alone; finite, or -infinity to keep every cell
  double lift = 1.5;           // moves longer than lift * cell are made lifted, > 0; infinity = never
  std::optional<Point> start;  // the path starts at the dwell point nearest to it; default: lowest row, leftmost cell
  bool improve = false;        // shorten the path by improve_tour ("improve=2opt"); it keeps a start that was given
};

struct NearestPath {
  ToolPath path;
  std::vector<double> eigenvalues;  // mean of the pixels of the cell of each dwell point [nm], in path order
  Index cells_total = 0;            // cells that have a valid pixel, kept or not
  Index blocks_searched = 0;        // work done: blocks of the search pyramid looked into
};

/// From "nearest:cell=MM,..."; throws InputError as SpecText does.
NearestOptions parse_nearest_options(const SpecText& spec);

/// The distances of tracks and dwell points that these options ask for.
std::vector<PathDistance> nearest_distances(const NearestOptions& options);

/// The path goes from the start to the nearest unvisited dwell point, and on until none is left. Among equally near
/// ones it takes that of the highest eigenvalue, then that of the lowest row and column ("improved Prim", Xie et al.
/// 2022, section 2, eq. 1-5).
///
/// Square cells of side `cell` cover the bounding box of the valid pixels' areas: as few as are needed, and the tiling
/// is centred on the box. A pixel belongs to the cell that holds its centre (on a common edge: to the upper or right
/// one). The eigenvalue of a cell is the mean of its valid pixels; its centre is a dwell point if it has one and the
/// eigenvalue is >= critical. Distances are compared as integers, so that ties are exact.
///
/// This greedy order leaves long moves back to cells that it passed by. `improve` shortens the whole path afterwards by
/// 2-opt and Or-opt moves (tour_improvement.h, its default work and seed); its ends are then free unless the start is
/// given. The path's notes say both lengths and that of the minimum spanning tree, which no path through the points can
/// undercut.
///
/// Throws InputError naming the option, its value and what is required, or the largest eigenvalue if no cell reaches
/// the critical value. Memory O(cells of the box); about O(n log n) time: each search descends a pyramid of blocks in
/// which finished areas are empty at every scale. With `improve` as improve_tour: 16 to 45 s for 10^5 points.
NearestPath nearest_path(const HeightMap& map, const NearestOptions& options, const Progress& progress = {});

}  // namespace dwell
