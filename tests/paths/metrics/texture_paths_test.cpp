#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/base/units.h"
#include "core/spectra/psd_regularity.h"
#include "paths/feed/feed.h"
#include "paths/lines/raster.h"
#include "paths/metrics/tool_texture.h"
#include "paths/tours/nearest_neighbour.h"

/// The texture that a raster and the nearest-neighbour path leave (Xie et al. 2022, section 3.2, figures 9 and 10): the
/// table of docs/papers.md, S1.
namespace dwell {
namespace {

/// A part of 150 x 150 mm, high in the middle: a dome, and on it a sum of waves of 20 to 80 mm.
HeightMap rough_part() {
  const Grid grid{75, 75, 2.0, 2.0, {1.0, 1.0}};
  HeightMap map(grid);
  for (Index i = 0; i < grid.size(); ++i) {
    const Point p = grid.centre(i) - Point{72.0, 78.0};
    map.values[static_cast<std::size_t>(i)] = 30.0 * (std::exp(-(p.x * p.x + p.y * p.y) / (2.0 * 50.0 * 50.0)) - 0.5);
  }
  std::mt19937_64 random(3);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int k = 0; k < 40; ++k) {
    const double angle = 2.0 * std::numbers::pi * uniform(), phase = 2.0 * std::numbers::pi * uniform();
    const double wave = 2.0 * std::numbers::pi / (20.0 + 60.0 * uniform());
    for (Index i = 0; i < grid.size(); ++i) {
      const Point p = grid.centre(i);
      map.values[static_cast<std::size_t>(i)] +=
          std::cos(wave * (p.x * std::cos(angle) + p.y * std::sin(angle)) + phase);
    }
  }
  return map;
}

/// Of the track over the middle 50 x 50 mm, in wavelengths from 1 to 25 mm.
PsdRegularity texture_of(const ToolPath& path, double feed_mm_per_min, const PlanetaryTool& tool) {
  const auto strokes = moving_strokes(path);
  const TextureTrack track =
      texture_track(strokes, minimum_dwell(strokes, {0.0, units::mm_per_s(feed_mm_per_min)}), tool, 0.01);
  HeightMap density = texture_density(track, Grid{125, 125, 0.4, 0.4, {50.2, 50.2}});
  double mean = 0.0;
  for (const double v : density.values) mean += v / static_cast<double>(density.grid.size());
  for (double& v : density.values) v = v / mean - 1.0;
  return psd_regularity(areal_psd(density, {}), 1.0, 25.0);
}

TEST(TexturePaths, NearestNeighbourIsLessRegularThanTheRaster) {
  const HeightMap part = rough_part();
  RasterOptions raster;
  raster.pitch = 10.0;
  NearestOptions nearest;
  nearest.cell = 10.0;
  const ToolPath lines = raster_path(part, raster), greedy = nearest_path(part, nearest).path;
  ASSERT_EQ(lines.size(), 225u);
  EXPECT_EQ(greedy.size(), 116u);
  PlanetaryTool tool;
  tool.revolution_rpm = 20.0;
  tool.spin_rpm = 50.0;
  struct Row {
    double feed;  // [mm/min]
    const ToolPath& path;
    double peak_over_mean, peak, rms, anisotropy, sector_over_mean, wavelength;
  };
  for (const Row& row : {Row{10.0, lines, 958.0, 42.0, 0.371, 0.964, 9.71, 10.0},
                         Row{10.0, greedy, 234.0, 20.5, 0.523, 0.472, 6.97, 10.0 / 3.0},
                         Row{50.0, lines, 177.0, 42.0, 0.863, 0.046, 1.79, 10.0},
                         Row{50.0, greedy, 72.0, 21.3, 0.962, 0.118, 2.34, 10.0 / 3.0}}) {
    SCOPED_TRACE(testing::Message() << row.path.kind << " at " << row.feed);
    const PsdRegularity r = texture_of(row.path, row.feed, tool);
    EXPECT_NEAR(r.peak_over_mean(), row.peak_over_mean, 0.02 * row.peak_over_mean);
    EXPECT_NEAR(r.peak, row.peak, 0.02 * row.peak);
    EXPECT_NEAR(r.rms, row.rms, 0.02 * row.rms);
    EXPECT_NEAR(r.anisotropy, row.anisotropy, 0.01);
    EXPECT_NEAR(r.sector_over_mean, row.sector_over_mean, 0.05);
    EXPECT_NEAR(r.wavelength(), row.wavelength, 0.02);
  }
}

}  // namespace
}  // namespace dwell
