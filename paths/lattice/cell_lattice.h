#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/map/height_map.h"
#include "paths/domain/path_distance.h"
#include "paths/domain/path_domain.h"

namespace dwell {

/// The options that all planners over a square lattice share.
struct LatticeOptions {
  double pitch = 0.0;             // distance between neighbouring lattice points [mm], finite and > 0; required
  std::optional<double> overrun;  // how far outside the valid pixels points may lie [mm], finite and >= 0; default 0
                                  // (plan_path: TIF radius)
  double angle_deg = 0.0;         // direction of the rows, counter-clockwise from +x; finite
};

/// The keys that parse_lattice_options reads, for SpecText::accept_only, followed by others.
std::vector<std::string> lattice_keys(std::initializer_list<std::string_view> others);
LatticeOptions parse_lattice_options(const SpecText& spec);

/// The distances of tracks and dwell points that these options ask for.
std::vector<PathDistance> lattice_distances(const LatticeOptions& options);

/// A square lattice over a part, and which of its points a path visits.
struct CellLattice {
  double pitch = 1.0;      // [mm]
  Point middle;            // of the lattice, in the turned frame
  Point along{1.0, 0.0};   // unit vector of the rows
  Point across{0.0, 1.0};  // 90 degrees counter-clockwise from it
  Index rows = 0;
  Index cols = 0;
  std::vector<std::uint8_t> kept;  // rows * cols, row-major: 1 = to be visited
  Index kept_cells = 0;
  double reach = 0.0;                // [mm], of the domain in which points are kept
  std::optional<PathDomain> domain;  // absent if all points lie on valid pixels: it is not needed then

  bool keeps(Index row, Index col) const { return kept[static_cast<std::size_t>(row * cols + col)] != 0; }
  Point at(Index row, Index col) const {
    const double u = middle.x + pitch * (static_cast<double>(col) - 0.5 * static_cast<double>(cols - 1));
    const double v = middle.y + pitch * (static_cast<double>(row) - 0.5 * static_cast<double>(rows - 1));
    return u * along + v * across;
  }
  Point at(Index cell) const { return at(cell / cols, cell % cols); }
};

/// The lattice is symmetric about the middle of the bounding box of the valid pixel centres in the turned frame, with
/// as many points as fit into the box widened by the overrun on each side. A point is kept if it lies within
/// max(overrun, pitch / sqrt(2), half a pixel's diagonal) of a valid pixel centre. So every valid pixel centre is
/// within pitch / sqrt(2) of a kept point, whatever the overrun, and a lattice finer than the pixels has no gaps
/// between them.
///
/// `planner` begins the messages of InputError, thrown if an option is out of range, the map has no finite pixel, or
/// the box holds more than 50 million lattice points. Cost and memory O(pixels + lattice points of the box).
CellLattice cell_lattice(const HeightMap& map, const LatticeOptions& options, const char* planner,
                         const Progress& progress = {});

}  // namespace dwell
