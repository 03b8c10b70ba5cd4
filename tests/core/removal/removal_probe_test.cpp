#include "core/removal/removal_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/base/errors.h"
#include "core/removal/stroke_average.h"

namespace dwell {
namespace {

const Grid kMap{9, 12, 0.8, 0.5, {-3.0, 6.0}};

/// A bent stroke, a straight one, a halt, one that only passes by the map, one out of reach and one of no time.
std::vector<Stroke> some_strokes() {
  return {{{-2.5, 7.0}, {-1.5, 7.9}, {0.2, 7.7}},
          {{0.0, 6.1}, {2.0, 8.1}, {4.0, 10.1}},
          {{1.2, 8.3}, {1.2, 8.3}, {1.2, 8.3}},
          {{-30.0, 5.5}, {0.0, 5.0}, {50.0, 4.5}},
          {{900.0, 900.0}, {901.0, 900.0}, {902.0, 900.0}},
          {{1.0, 7.0}, {1.1, 7.0}, {1.2, 7.0}}};
}
const std::vector<double> kSeconds{3.0, 2.0, 1.5, 40.0, 7.0, 0.0};

RemovalFunction measured_lobe() {
  HeightMap rates(Grid{25, 31, 0.2, 0.3, {-3.0, -3.6}});
  for (Index i = 0; i < rates.grid.size(); ++i) {
    const Point p = rates.grid.centre(i) - Point{0.5, -0.3};
    rates.values[static_cast<std::size_t>(i)] = 4.0 * std::exp(-1.3 * p.x * p.x - 0.8 * p.y * p.y);
  }
  return measured_removal(rates, {TifCentre::Kind::Given, {}});
}

/// The oracle: closed averages along the strokes at n x n midpoints of the pixel.
double mean_by_strokes(const RemovalFunction& tif, Point centre, int n) {
  const StrokeAverage average(tif);
  const std::vector<Stroke> strokes = some_strokes();
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Point p = centre + Point{kMap.pitch_x * ((j + 0.5) / n - 0.5), kMap.pitch_y * ((i + 0.5) / n - 0.5)};
      for (std::size_t k = 0; k < strokes.size(); ++k) sum += kSeconds[k] * average(strokes[k], p);
    }
  }
  return sum / (n * n);
}

void expect_probe(const RemovalFunction& tif, double tolerance) {
  const PixelMeanTable table = tabulate_pixel_mean(tif, kMap);
  const RemovalProbe probe(kMap, table, some_strokes(), kSeconds);
  double largest = 0.0;
  for (Index i = 0; i < kMap.size(); i += 5) {
    const Point centre = kMap.centre(i);
    const double expected = mean_by_strokes(tif, centre, 40);
    largest = std::max(largest, expected);
    EXPECT_NEAR(probe.mean_over_pixel(centre), expected, tolerance * 10.0 * tif.peak) << kind_of(tif) << " " << i;
    EXPECT_NEAR(probe.at(centre), mean_by_strokes(tif, centre, 1), 20.0 * tolerance * 10.0 * tif.peak) << i;
  }
  EXPECT_GT(largest, tif.peak);
}

TEST(RemovalProbe, IntegratesTheRemovalFunctionItself) {
  expect_probe(gaussian_removal(3.0, 2.0, 4.0), 5e-5);
  expect_probe(measured_lobe(), 5e-5);
  expect_probe(spinning_disc_removal(0.8, 2.0), 1e-3);
}

TEST(RemovalProbe, GivesPixelsInOrderForAnyNumberOfThreads) {
  const PixelMeanTable table = tabulate_pixel_mean(measured_lobe(), kMap);
  const RemovalProbe probe(kMap, table, some_strokes(), kSeconds);
  const std::vector<Index> pixels{3, 90, 41};
  const Vector one = mean_removal(probe, kMap, pixels, 1), two = mean_removal(probe, kMap, pixels, 2);
  EXPECT_EQ(one, two);
  for (Index k = 0; k < 3; ++k)
    EXPECT_EQ(one[k], probe.mean_over_pixel(kMap.centre(pixels[static_cast<std::size_t>(k)])));
}

TEST(RemovalProbe, OfNothingRemovesNothing) {
  const PixelMeanTable table = tabulate_pixel_mean(measured_lobe(), kMap);
  const RemovalProbe probe(kMap, table, {}, {});
  EXPECT_EQ(probe.mean_over_pixel(kMap.centre(4)), 0.0);
  EXPECT_EQ(probe.at(kMap.centre(4)), 0.0);
  EXPECT_EQ(mean_removal(probe, kMap, {}, 2).size(), 0);
}

TEST(RemovalProbe, WantsATimeAStrokeAndStops) {
  const std::vector<double> one{1.0};
  const PixelMeanTable table = tabulate_pixel_mean(measured_lobe(), kMap);
  EXPECT_THROW(RemovalProbe(kMap, table, some_strokes(), one), std::invalid_argument);
  const RemovalProbe probe(kMap, table, some_strokes(), kSeconds);
  EXPECT_THROW(mean_removal(probe, kMap, {1}, 1, Progress{{}, [] { return true; }}), Interrupted);
}

}  // namespace
}  // namespace dwell
