#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/removal/removal_probe.h"
#include "core/tif/removal_kernel.h"
#include "runs/plan/part.h"

namespace dwell {

/// The lattice on which a plan's removal is a spline, and how well it holds the removal function on a path.
struct LatticeChoice {
  RemovalKernel kernel;
  double error = 0.0;   // RMS of the removal of random dwell by it, less the exact one, relative to the latter's RMS
  bool finest = false;  // no finer one is tried: it would take too many nodes
};

/// What the lattice is: "1 x 1 cells a pixel", or "one node in 20 x 20 pixels".
std::string lattice_words(const RemovalKernel& kernel);

/// Largest error with which a solve is begun.
inline constexpr double kLatticeError = 0.002;

/// The coarsest lattice, from the map's own pixels on, on which the error is at most kLatticeError; or the finest.
/// Where pixels are many and the removal function is much wider than one, a lattice of every so many pixels, if the
/// removal of random dwell by it, the mean left out, is within 3e-3 of the exact. Cost: for each lattice tried, one
/// removal_once; and a RemovalProbe at 96 pixels.
LatticeChoice choose_lattice(const Part& part, const std::vector<Stroke>& strokes, const Progress& progress);

/// The next finer one of about half the pitch. error is not set. Nothing finer: the same, with `finest`.
LatticeChoice finer_lattice(const Part& part, const LatticeChoice& lattice);

}  // namespace dwell
