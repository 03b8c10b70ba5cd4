#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/removal/exact_removal.h"
#include "core/spectra/psd_regularity.h"
#include "tests/core/removal/disc_oracle.h"

/// Scan lines, Archimedean spiral and Hilbert curve at constant speed under a spinning disc: mean, fluctuation and
/// direction of what they remove, over the interval L of the tracks (Lin et al. 2014). The table of docs/papers.md, S4.
/// The paths are those of the textbook, not of the planners.
namespace dwell {
namespace {

/// 96 pixels square of at most half the interval; R = 1. Eight radii wide, but four for the closest tracks.
Grid window_about(Point centre, double interval) {
  constexpr Index kPixels = 96;
  const double pitch = interval < 0.2 ? 1.0 / 24.0 : 1.0 / 12.0, half = 0.5 * pitch * static_cast<double>(kPixels - 1);
  return {kPixels, kPixels, pitch, pitch, {centre.x - half, centre.y - half}};
}

struct Figures {
  double mean = 0.0;  // over the 2 pi slope R^3 / (3 speed L) of a uniform covering
  double rms = 0.0;   // standard deviation over the mean
  double pv = 0.0;    // peak to valley over the mean
  PsdRegularity spectrum;
};

Figures figures_of(const std::vector<Point>& nodes, const Grid& window, double interval) {
  std::vector<Stroke> strokes;
  for (std::size_t k = 1; k < nodes.size(); ++k) {
    if (std::isnan(nodes[k].x) || std::isnan(nodes[k - 1].x)) continue;  // lifted
    strokes.push_back({nodes[k - 1], midpoint(nodes[k - 1], nodes[k]), nodes[k]});
  }
  Vector t(static_cast<Index>(strokes.size()));
  for (Index j = 0; j < t.size(); ++j) t[j] = strokes[static_cast<std::size_t>(j)].length();
  std::vector<Index> pixels;
  for (Index i = 0; i < window.size(); ++i) pixels.push_back(i);
  const Vector removal = exact_removal_once(window, pixels, spinning_disc_removal(1.0, 1.0), strokes, t, 2);
  const double mean = removal.mean();
  HeightMap ripple(window);
  for (Index i = 0; i < window.size(); ++i) ripple.values[static_cast<std::size_t>(i)] = removal[i] / mean - 1.0;
  Figures figures;
  figures.mean = mean * interval / (2.0 * std::numbers::pi / 3.0);
  figures.rms = std::sqrt((removal.array() / mean - 1.0).square().mean());
  figures.pv = (removal.maxCoeff() - removal.minCoeff()) / mean;
  figures.spectrum = psd_regularity(areal_psd(ripple, {}), 2.2 * window.pitch_x, 0.5 * window.width());
  return figures;
}

Figures scan_lines(double interval) {
  const Grid window = window_about({0.0, 0.0}, interval);
  std::vector<Point> nodes;
  const auto half = static_cast<int>(std::ceil(6.0 / interval));
  for (int k = -half; k <= half; ++k) {
    const double y = (k + 0.37) * interval;
    nodes.insert(nodes.end(), {{-6.0, y}, {6.0, y}, {std::nan(""), 0.0}});
  }
  return figures_of(nodes, window, interval);
}

/// Ten radii off the centre of the spiral.
Figures spiral(double interval) {
  const oracle::Spiral curve{interval, 2.0 * std::numbers::pi * 18.0 / interval};
  const double length = curve.arc(curve.last);
  const auto count = static_cast<long>(length / 0.05);
  std::vector<Point> nodes;
  for (long k = 0; k <= count; ++k) {
    nodes.push_back(curve.at(curve.theta_at(length * static_cast<double>(k) / static_cast<double>(count))));
  }
  return figures_of(nodes, window_about({9.2, 4.1}, interval), interval);
}

Figures hilbert(double interval) {
  const auto order = static_cast<int>(std::ceil(std::log2(10.4 / interval)));
  const double side = interval * static_cast<double>((1L << order) - 1);
  return figures_of(oracle::hilbert_nodes(order, interval, {-0.5 * side + 0.11, -0.5 * side - 0.13}),
                    window_about({0.0, 0.0}, interval), interval);
}

struct Row {
  double interval;          // L / R
  Figures (*path)(double);  // at constant speed
  double rms, pv;           // over the mean
  double anisotropy, sector_over_mean;
};

class ThreePaths : public testing::TestWithParam<Row> {};

TEST_P(ThreePaths, FluctuateAsTheTableSays) {
  const Row row = GetParam();
  const Figures f = row.path(row.interval);
  EXPECT_NEAR(f.mean, 1.0, 6e-3);  // of the window: it holds no whole number of intervals
  EXPECT_NEAR(f.rms, row.rms, 0.01 * row.rms + 1e-4);
  EXPECT_NEAR(f.pv, row.pv, 0.01 * row.pv + 1e-4);
  EXPECT_NEAR(f.spectrum.anisotropy, row.anisotropy, 6e-3);
  EXPECT_NEAR(f.spectrum.sector_over_mean, row.sector_over_mean, 6e-2);
}

INSTANTIATE_TEST_SUITE_P(
    Of, ThreePaths,
    testing::Values(Row{0.1, scan_lines, 0.0056, 0.0197, 0.999, 11.93}, Row{0.1, spiral, 0.0052, 0.0227, 0.789, 6.90},
                    Row{0.1, hilbert, 0.0066, 0.0416, 0.048, 3.95}, Row{0.2, scan_lines, 0.0157, 0.0549, 0.999, 11.93},
                    Row{0.2, spiral, 0.0144, 0.0624, 0.792, 5.90}, Row{0.2, hilbert, 0.0181, 0.1199, 0.023, 3.52},
                    Row{0.3, scan_lines, 0.0350, 0.0869, 0.999, 11.93}, Row{0.3, spiral, 0.0351, 0.0904, 0.930, 6.51},
                    Row{0.3, hilbert, 0.0376, 0.2103, 0.010, 3.41}, Row{0.4, scan_lines, 0.0369, 0.1267, 0.998, 11.92},
                    Row{0.4, spiral, 0.0378, 0.1656, 0.926, 6.60}, Row{0.4, hilbert, 0.0565, 0.4580, 0.032, 3.27},
                    Row{0.5, scan_lines, 0.0497, 0.1414, 0.998, 11.94}, Row{0.5, spiral, 0.0558, 0.2385, 0.938, 5.97},
                    Row{0.5, hilbert, 0.0728, 0.4771, 0.126, 4.22}, Row{0.6, scan_lines, 0.0574, 0.1684, 0.997, 11.94},
                    Row{0.6, spiral, 0.0573, 0.1822, 0.937, 6.66}, Row{0.6, hilbert, 0.1121, 0.6879, 0.014, 3.01},
                    Row{0.7, scan_lines, 0.1185, 0.3391, 0.996, 11.93}, Row{0.7, spiral, 0.1174, 0.3437, 0.962, 5.80},
                    Row{0.7, hilbert, 0.1394, 0.8136, 0.104, 3.71}, Row{0.8, scan_lines, 0.1263, 0.3121, 0.994, 11.94},
                    Row{0.8, spiral, 0.1264, 0.3281, 0.960, 6.51}, Row{0.8, hilbert, 0.1624, 0.8276, 0.050, 2.61},
                    Row{0.9, scan_lines, 0.0582, 0.2330, 0.998, 11.93}, Row{0.9, spiral, 0.0604, 0.2641, 0.921, 5.93},
                    Row{0.9, hilbert, 0.1635, 1.1950, 0.027, 1.77}, Row{1.0, scan_lines, 0.1624, 0.5719, 0.992, 11.44},
                    Row{1.0, spiral, 0.1490, 0.6469, 0.958, 6.47}, Row{1.0, hilbert, 0.1985, 1.0064, 0.129, 2.86}));

// The reason why the fluctuation does not grow steadily: of the lines' removal, the Fourier series has the transform of
// the disc's removal function at k / L, whose sign changes. B(f) = 2 pi integral of r^2 J_0(2 pi f r) over 0 < r < R.
TEST(ScanLines, FluctuateAsTheTransformOfTheDisc) {
  const oracle::Disc disc{1.0, 1.0};
  const auto transform = [](double f) {
    return 2.0 * std::numbers::pi *
           oracle::integrate([f](double r) { return r * r * std::cyl_bessel_j(0.0, 2.0 * std::numbers::pi * f * r); },
                             0.0, 1.0, 1e-8);
  };
  for (const double interval : {0.2, 0.35, 0.6, 0.9, 1.0, 1.7}) {
    double series = 0.0;
    for (int k = 1; k <= 30; ++k) series += 2.0 * std::pow(transform(k / interval) / transform(0.0), 2);
    constexpr int kSamples = 20000;
    double mean = 0.0, square = 0.0;
    const int lines = 2 * static_cast<int>(std::ceil(1.0 / interval)) + 3;
    for (int k = 0; k < kSamples; ++k) {
      const double z = disc.lines(interval * (k + 0.5) / kSamples, -interval * (lines / 2), interval, lines);
      mean += z / kSamples;
      square += z * z / kSamples;
    }
    EXPECT_NEAR(mean, 2.0 * std::numbers::pi / 3.0 / interval, 1e-4 * mean);
    EXPECT_NEAR(std::sqrt(square - mean * mean) / mean, std::sqrt(series), 0.01 * std::sqrt(series)) << interval;
  }
}

}  // namespace
}  // namespace dwell
