#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/formats/map_io.h"
#include "runs/campaigns/path_comparison.h"
#include "runs/campaigns/path_comparison_output.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

/// A part of 60 x 60 mm with form alone: whatever of the mid band is left, the path has made.
HeightMap form_alone() {
  HeightMap map(Grid{240, 240, 0.25, 0.25, {-29.875, -29.875}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const double u = map.grid.centre(i).x / 30.0, v = map.grid.centre(i).y / 30.0;
    map.values[static_cast<std::size_t>(i)] =
        300.0 + 150.0 * u + 80.0 * (u * u - v * v) + 60.0 * u * v + 40.0 * u * u * u;
  }
  return map;
}

/// Zha et al. 2020, figure 12: the random path clips the peaks of the spectrum in the mid band. Held at pitches for
/// which both paths leave the same in the whole of it (docs/papers.md, "S2 random direction").
TEST(ZhaRandomPath, ClipsThePeakThatTheRasterLeavesAtEqualMidBandRms) {
  const test::TemporaryFolder folder;
  JobOptions job;
  job.map = (folder.path() / "map.csv").string();
  write_map(job.map, form_alone());
  job.tif = "gaussian:peak=10,fwhm=3,radius=4.5";
  job.remove = {true, false};
  job.max_feed_mm_per_min = 6000.0;
  job.smoothness = {0.1};
  job.time_price_nm2_per_s = {0.0};
  job.threads = 2;
  OutputFolder out(folder.path() / "paths", path_comparison_files());
  const PathComparison paths = compare_paths(job, "raster:pitch=2.5,random:pitch=1.5,random:pitch=2.5", {}, out, {});
  ASSERT_TRUE(std::all_of(paths.paths.begin(), paths.paths.end(), [](const auto& p) { return p.residual_ripple; }));
  const RippleSpectrum &raster = *paths.paths[0].residual_ripple, &random = *paths.paths[1].residual_ripple;
  EXPECT_NEAR(raster.rms, 1.925, 0.02);
  EXPECT_NEAR(random.rms / raster.rms, 1.0, 0.02);
  // The raster: one wave, across the lines, as long as the pitch. The random path: none stands out.
  EXPECT_GT(raster.peaks.at(0).share, 0.99);
  EXPECT_NEAR(raster.peaks[0].wavelength, 2.5, 0.05);
  EXPECT_NEAR(std::abs(raster.peaks[0].direction_deg), 90.0, 2.0);
  EXPECT_LT(random.peaks.at(0).share, 0.15);
  EXPECT_GT(raster.anisotropy, 0.9);
  EXPECT_LT(random.anisotropy, 0.3);
  // What it costs: at the same pitch it leaves several times as much.
  EXPECT_GT(paths.paths[2].residual_ripple->rms, 5.0 * raster.rms);
}

}  // namespace
}  // namespace dwell
