#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "core/tif/removal_kernel.h"
#include "runs/plan/part.h"
#include "solvers/fits/ceres_removal_registration.h"

namespace dwell {

/// The widths over which a registration fits: the known one, and a little narrower and wider.
inline const std::vector<double> kRegisteredWidths{0.93, 1.0, 1.07};

/// What motions remove of a part with its tool, or with one of other rate and width. All are on one lattice, as fine as
/// the part's own tool needs; it holds tools of nearly that width as well. Refers to the part.
class ToolRemoval {
 public:
  /// Chooses the lattice for a motion. Throws InputError for a tool that is too narrow for the pixels, Interrupted.
  ToolRemoval(const Part& part, const Program& motion, const Progress& progress = {});
  /// On the lattice of a kernel.
  ToolRemoval(const Part& part, RemovalKernel kernel);

  /// On the part's pixels with data [nm], NaN elsewhere. Cost: a simulation.
  HeightMap of(const Program& motion, double rate = 1.0, double width = 1.0) const;

  /// For tools of several widths over the part's, on the pixels of the part's map and `margin` [mm] around all of them,
  /// also where the map has no data: a measured removal that lies elsewhere is to find it. Throws Interrupted. Cost: a
  /// simulation for each width.
  PredictedRemoval predict(const Program& motion, const std::vector<double>& widths, double margin,
                           const Progress& progress = {}) const;

 private:
  RemovalKernel kernel_of(double rate, double width) const;

  const Part& part_;
  RemovalKernel kernel_;
};

}  // namespace dwell
