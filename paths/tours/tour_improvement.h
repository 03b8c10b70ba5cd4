#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/grid.h"
#include "core/base/point.h"
#include "core/base/progress.h"

namespace dwell {

struct TourOptions {
  bool fixed_start = false;    // the first point of the order stays the first; else both ends are free
  std::optional<Index> kicks;  // work after the local search, >= 0; default one a point
  std::uint64_t seed = 1;      // of the kicks
  std::function<bool()> stop;  // asked now and then; true ends the search with what has been reached (`progress` ends
                               // it with Interrupted)
};

struct ImprovedTour {
  std::vector<Index> order;    // indices into the points, each once
  double length_before = 0.0;  // of the open path in the order given [mm]
  double length_after = 0.0;   // [mm], never more than before
  Index moves = 0;             // moves that shortened the path
  Index kicks = 0;             // kicks tried
  Index kicks_kept = 0;        // of which the path became no longer
  bool stopped = false;        // by the callback
};

/// Shortens an open path through given points by local search.
///
/// Moves are chains of up to five 2-opt moves whose partial gains stay positive (Lin and Kernighan 1973), and the
/// insertion of up to 12 consecutive points elsewhere, either way round (Or 1976). They join points to one of their 8
/// nearest, from a queue of the points whose neighbourhood has changed (Bentley's don't-look bits; Johnson and McGeoch
/// 1997, "The traveling salesman problem: a case study in local optimization"). When no move shortens the path any
/// more, it is kicked: two neighbouring stretches of up to 50 points change places, and the local search runs again
/// around them. The kick is undone if the path became longer. A path of equal length is kept, because most moves on a
/// lattice tie and only such drift leads off a plateau. Kicks begin at a move that is longer than the distance to the
/// nearest neighbour if a few draws find one, because only such moves can be shortened.
///
/// Lengths are compared as integers (2^-36 of the extent of the points), so that gains cannot cycle by rounding and the
/// search ends; the same points, order, options and kicks give the same result. NaN, infinite points and an order that
/// is not a permutation are refused with InputError, as are more than 50 million points. Memory O(n). On one core 10^5
/// cells of a lattice take 16 to 45 s with the default kicks and 1.5 s without, 10^6 cells 140 s and 6 s.
ImprovedTour improve_tour(const std::vector<Point>& points, const std::vector<Index>& order,
                          const TourOptions& options = {}, const Progress& progress = {});

/// Length of the open path through points in this order [mm].
double tour_length(const std::vector<Point>& points, const std::vector<Index>& order);

}  // namespace dwell
