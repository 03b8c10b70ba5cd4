#include "core/removal/exact_residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace dwell {
namespace {

/// A part with a missing corner and holes, a wide tool that runs along lines, and what is left after it.
struct WorkedPart {
  HeightMap map;
  RemovalFunction tif = gaussian_removal(5.0, 3.0, 6.0);
  std::vector<Stroke> strokes;
  std::vector<double> seconds;
  PixelMeanTable table;

  WorkedPart(Index rows, Index cols) : map(Grid{rows, cols, 0.25, 0.35, {3.0, -8.0}}) {
    for (Index i = 0; i < map.grid.size(); ++i) {
      if (i / cols + i % cols < 5 || i % 97 == 3) continue;
      const Point p = map.grid.centre(i) - map.grid.origin;
      map.values[static_cast<std::size_t>(i)] = 200.0 + 30.0 * std::sin(0.4 * p.x) * std::cos(0.3 * p.y) + 2.0 * p.x;
    }
    table = tabulate_pixel_mean(tif, map.grid);
    const double width = map.grid.width(), height = map.grid.height();
    for (double y = -2.0; y < height + 2.0; y += 0.9) {
      for (double x = -2.0; x < width + 2.0; x += 0.5) {
        const Point a = map.grid.origin + Point{x, y};
        strokes.push_back({a, a + Point{0.25, 0.0}, a + Point{0.5, 0.0}});
        seconds.push_back(0.6 + 0.2 * std::sin(0.4 * x));
      }
    }
  }

  RemovalProbe probe() const { return {map.grid, table, strokes, seconds}; }
  /// What is left exactly.
  HeightMap left() const {
    const std::vector<Index> pixels = finite_pixels(map);
    const Vector removal = mean_removal(probe(), map.grid, pixels, 1);
    HeightMap result = map;
    for (std::size_t k = 0; k < pixels.size(); ++k)
      result.values[static_cast<std::size_t>(pixels[k])] -= removal[static_cast<Index>(k)];
    return result;
  }
};

/// A lattice that is wrong by noise and by a tilt, which the form terms take.
HeightMap wrong_by(const HeightMap& left, double noise, double tilt) {
  std::mt19937_64 random(7);
  HeightMap wrong = left;
  for (Index i = 0; i < left.grid.size(); ++i) {
    const double u = static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
    wrong.values[static_cast<std::size_t>(i)] += noise * std::sqrt(12.0) * u + tilt * left.grid.centre(i).x;
  }
  return wrong;
}

TEST(ExactResidual, IsTheExactOneWhateverTheLatticeSays) {
  const WorkedPart part(40, 50);
  const HeightMap left = part.left();
  for (const FormTerms& form : {FormTerms{}, FormTerms{true, true}}) {
    const MapStatistics expected = map_statistics(left, form);
    const ExactResidual found =
        exact_residual(part.probe(), part.map, wrong_by(left, 0.5, form.any() ? 0.8 : 0.0), form, 2);
    EXPECT_TRUE(found.all);
    EXPECT_EQ(found.checked, part.map.valid_pixels());
    EXPECT_EQ(found.standard_error, 0.0);
    EXPECT_NEAR(found.statistics.rms, expected.rms, 1e-9 * expected.rms);
    EXPECT_NEAR(found.statistics.pv, expected.pv, 1e-9 * expected.pv);
    EXPECT_NEAR(found.statistics.mean, expected.mean, 1e-9 * expected.rms);
    EXPECT_NEAR(found.lattice_error, 0.5, 0.02);
    const HeightMap surface = without_form(left, form);
    for (const Index i : finite_pixels(surface)) {
      const auto k = static_cast<std::size_t>(i);
      ASSERT_NEAR(found.surface.values[k], surface.values[k], 1e-8);
    }
  }
}

// Of many pixels a part does, and the truth lies within three standard errors.
TEST(ExactResidual, OfManyPixelsIsEstimatedToOnePerCent) {
  const WorkedPart part(310, 360);
  const HeightMap left = part.left();
  const FormTerms form{true, true};
  const MapStatistics expected = map_statistics(left, form);
  const HeightMap lattice = wrong_by(left, 0.2 * expected.rms, 0.3);
  const ExactResidual found = exact_residual(part.probe(), part.map, lattice, form, 2);
  EXPECT_FALSE(found.all);
  EXPECT_LT(found.checked, part.map.valid_pixels() / 10);
  EXPECT_GT(found.standard_error, 0.0);
  EXPECT_LE(found.standard_error, 0.01 * found.statistics.rms);
  EXPECT_NEAR(found.statistics.rms, expected.rms, 3.0 * found.standard_error);
  EXPECT_NEAR(found.lattice_error, 0.2 * expected.rms, 0.02 * expected.rms);
  const ExactResidual again = exact_residual(part.probe(), part.map, lattice, form, 1);
  EXPECT_EQ(again.statistics.rms, found.statistics.rms);
  EXPECT_EQ(again.surface.values.size(), found.surface.values.size());
}

TEST(ExactResidual, AllPixelsWhereAsked) {
  const WorkedPart part(310, 360);
  HeightMap left = part.map;
  const ExactResidual found = exact_residual(part.probe(), part.map, left, {}, 2, {}, ExactCheck::EveryPixel);
  EXPECT_TRUE(found.all);
  EXPECT_NEAR(found.statistics.rms_about_zero(), map_statistics(part.left(), {}).rms_about_zero(), 1e-9);
}

// A comb of halts of a narrow tool, one to a column of pixels: the means along x are even, the removal within them is
// not. The mean square of what a line of Gaussians a pitch apart leaves is that of its harmonics.
TEST(ExactResidual, StatesTheRippleWithinPixels) {
  const double pitch = 1.0, sigma = 0.35, fwhm = sigma * std::sqrt(8.0 * std::numbers::ln2);
  HeightMap map(Grid{12, 12, pitch, 0.25, {0.0, 0.0}}, std::vector<double>(144, 0.0));
  const RemovalFunction tif = gaussian_removal(1.0, 2.0, 8.0);  // wide enough for the check, and too wide for ripple
  std::vector<Stroke> strokes;
  for (int c = -12; c < 24; ++c) strokes.push_back({{c * pitch, -20.0}, {c * pitch, 1.0}, {c * pitch, 22.0}});
  const std::vector<double> seconds(strokes.size(), 10.0);
  const PixelMeanTable wide = tabulate_pixel_mean(tif, map.grid);
  const ExactResidual smooth = exact_residual(RemovalProbe(map.grid, wide, strokes, seconds), map, map, {}, 1);
  const double removed = -smooth.statistics.mean;
  EXPECT_LT(smooth.ripple, 2e-3 * removed);

  map.grid.pitch_x = 0.5 * fwhm;  // the narrowest tool that a map may have
  strokes.clear();
  const double spacing = map.grid.pitch_x;
  for (int c = -40; c < 60; ++c)
    strokes.push_back({{4.0 * c * spacing, -20.0}, {4.0 * c * spacing, 1.0}, {4.0 * c * spacing, 22.0}});
  const std::vector<double> more(strokes.size(), 10.0);
  const PixelMeanTable narrow = tabulate_pixel_mean(gaussian_removal(1.0, fwhm, 3.0 * fwhm), map.grid);
  const ExactResidual rough = exact_residual(RemovalProbe(map.grid, narrow, strokes, more), map, map, {}, 1);
  EXPECT_GT(rough.ripple, 0.01 * -rough.statistics.mean);
  EXPECT_GT(rough.ripple_error, 0.0);
  EXPECT_LT(rough.ripple_error, 0.2 * rough.ripple);
  // Whatever the lattice says, and however many pixels are looked at besides: it is that of the program.
  HeightMap other = map;
  for (std::size_t i = 0; i < other.values.size(); ++i) other.values[i] = static_cast<double>(i * i % 37);
  for (const ExactCheck check : {ExactCheck::Figure, ExactCheck::EveryPixel}) {
    const ExactResidual again =
        exact_residual(RemovalProbe(map.grid, narrow, strokes, more), map, other, {true, true}, 1, {}, check);
    EXPECT_EQ(again.ripple, rough.ripple);
    EXPECT_EQ(again.ripple_error, rough.ripple_error);
  }
  EXPECT_DOUBLE_EQ(rough.total(), std::hypot(rough.statistics.rms_about_zero(), rough.ripple));
}

}  // namespace
}  // namespace dwell
