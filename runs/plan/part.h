#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/form/form_terms.h"
#include "core/form/map_statistics.h"
#include "core/map/height_map.h"
#include "core/removal/removal_probe.h"
#include "core/tif/removal_function.h"
#include "core/tif/removal_kernel.h"

namespace dwell {

/// The surface to be worked and the tool to work it, before there is a path. First of the four values of a plan: Part
/// -> LaidPath -> DwellPlan -> MachineProgram, each made by a function of values (docs/tree.md).
struct Part {
  HeightMap map;     // as measured, NaN = outside the part, or does not count [nm]
  HeightMap beside;  // as measured, where it does not count, NaN elsewhere [nm]; empty if all of it counts
  /// Of the map's pixels, one each, > 0 where the map has data: what a pixel's square counts in the fit, as a ratio to
  /// others'. Empty = all the same.
  std::vector<double> weights;
  FormTerms form;        // that the specification does not count
  HeightMap figure;      // the map without the form terms [nm]
  MapStatistics before;  // of the figure
  RemovalFunction tif;
  RemovalKernel kernel;  // the removal function on the map's pixels
  PixelMeanTable exact;  // the same so fine that it serves to judge others
  int threads = 1;       // on which everything made from the part runs
};

/// Makes a part of a map [nm] and a removal function [nm/s]. `threads` = 0 takes one for every processor. Throws
/// InputError if the tool does not fit (check_tool_fits) or the map has no finite pixel, Interrupted. `weights`: one a
/// pixel of the map, finite and >= 0, or empty; a pixel of weight 0 does not count, neither for the fit nor for the
/// form terms, the path or any figure, and goes to Part::beside. Throws InputError if no pixel with data has a weight
/// above 0. Cost: a few passes over the map.
Part make_part(HeightMap map, RemovalFunction tif, const FormTerms& form, int threads = 0,
               const Progress& progress = {}, std::vector<double> weights = {});

/// The part without data at these pixels (linear indices): as if they had not been measured. Throws InputError if no
/// finite pixel is left. Cost: copies, and a few passes over the map.
Part without_pixels(Part part, const std::vector<Index>& pixels);

/// Throws InputError if half of the peak of the tool spans more than three times the longer side of the map, which no
/// tool for the part does: a wrong pitch or unit of length. A tool that only reaches over the part is the path's
/// business.
void check_tool_fits(const RemovalFunction& tif, const Grid& map);

/// A sentence if the tool, which is taken to reach no farther than three times its FWHM across, is wider than the map
/// in x and in y.
std::optional<std::string> wider_than_map(const RemovalFunction& tif, const Grid& map);

}  // namespace dwell
