#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "core/formats/map_io.h"
#include "runs/job/job_options.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell::test {

/// A map of 30 x 22 pixels, 15 x 11 mm, with a missing corner, an origin off zero and no symmetry.
inline HeightMap small_map() {
  const double outside = std::numeric_limits<double>::quiet_NaN();
  HeightMap map(Grid{22, 30, 0.5, 0.5, {-4.25, 1.75}});
  for (Index r = 0; r < map.grid.rows; ++r) {
    for (Index c = 0; c < map.grid.cols; ++c) {
      const double x = 0.5 * static_cast<double>(c), y = 0.5 * static_cast<double>(r);
      map.at(r, c) = x + y < 3.0 ? outside : 20.0 * std::sin(0.4 * x) * std::cos(0.3 * y + 0.2) + 0.3 * x * y;
    }
  }
  return map;
}

/// A plan that takes a fraction of a second: the small map in a file, a Gaussian tool, a raster.
struct SmallJob {
  TemporaryFolder folder;
  JobOptions options;

  SmallJob() {
    options.map = (folder.path() / "map.csv").string();
    write_map(options.map, small_map());
    options.tif = "gaussian:peak=10,fwhm=2.5,radius=4";
    options.path = parse_path_spec("raster:pitch=1,overrun=2");
    options.smoothness = {0.01};
    options.time_price_nm2_per_s = {0.0};
    options.threads = 1;
    options.out = (folder.path() / "plan").string();
  }
};

}  // namespace dwell::test
