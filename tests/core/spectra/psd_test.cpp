#include "core/spectra/psd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <random>

#include "core/form/map_statistics.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using std::numbers::pi;

HeightMap rough(const Grid& grid, bool disc) {
  HeightMap map(grid);
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, 2.0);
  for (Index r = 0; r < grid.rows; ++r) {
    for (Index c = 0; c < grid.cols; ++c) {
      const double u = (2.0 * static_cast<double>(c) + 1.0) / static_cast<double>(grid.cols) - 1.0;
      const double v = (2.0 * static_cast<double>(r) + 1.0) / static_cast<double>(grid.rows) - 1.0;
      const double z = 5.0 * std::sin(4.0 * u + 1.0) + normal(random);
      if (!disc || u * u + v * v <= 1.0) map.at(r, c) = z;
    }
  }
  return map;
}

double integral(const ArealPsd& psd) {
  double sum = 0.0;
  for (Index row = 0; row < psd.rows; ++row) {
    for (Index col = 0; col < psd.half_cols(); ++col) {
      sum += psd.multiplicity(col) * psd.density[static_cast<std::size_t>(row * psd.half_cols() + col)];
    }
  }
  return sum * psd.step_x * psd.step_y;
}

double integral(const PsdCurve& curve, double step) {
  return std::accumulate(curve.density.begin(), curve.density.end(), 0.0) * step;
}

PsdOptions with(const std::string& window, Index longest_gap = 4) {
  return {parse_spectral_window(window), longest_gap, 2};
}

// A size with large prime factors is padded; odd and even sizes have other multiplicities.
const Grid kPrime{37, 52, 0.3, 0.45, {20.0, -4.0}};

TEST(Psd, IntegratesToTheMeanSquareThatTheWindowSees) {
  for (const Grid& grid : {kPrime, Grid{40, 63, 0.2, 0.1, {}}}) {
    for (const bool disc : {false, true}) {
      const HeightMap map = rough(grid, disc);
      for (const char* window : {"hann", "none", "tukey:0.3"}) {
        const ArealPsd psd = areal_psd(map, with(window));
        EXPECT_NEAR(integral(psd), psd.mean_square, 1e-12 * psd.mean_square) << window << disc;
        const PsdCurve x = psd_along_x(psd), y = psd_along_y(psd);
        double constant_x = 0.0, constant_y = 0.0;  // what lies at fx = 0 and at fy = 0
        for (Index row = 0; row < psd.rows; ++row) {
          constant_x += psd.density[static_cast<std::size_t>(row * psd.half_cols())];
        }
        for (Index col = 0; col < psd.half_cols(); ++col) {
          constant_y += psd.multiplicity(col) * psd.density[static_cast<std::size_t>(col)];
        }
        const double cell = psd.step_x * psd.step_y;
        EXPECT_NEAR(integral(x, psd.step_x) + constant_x * cell, psd.mean_square, 1e-12 * psd.mean_square);
        EXPECT_NEAR(integral(y, psd.step_y) + constant_y * cell, psd.mean_square, 1e-12 * psd.mean_square);
      }
    }
  }
}

TEST(Psd, WithoutAWindowIntegratesToTheMeanSquareOfTheMap) {
  for (const bool disc : {false, true}) {
    const HeightMap map = rough(kPrime, disc);
    const double rms = map_statistics(map, {}).rms_about_zero();
    EXPECT_NEAR(std::sqrt(areal_psd(map, with("none", 0)).mean_square), rms, 1e-12 * rms);
  }
}

TEST(Psd, IsTheDiscreteFourierTransformSquared) {
  HeightMap map = rough(Grid{9, 14, 0.5, 0.2, {3.0, 1.0}}, true);
  map.at(4, 7) = std::nan("");
  const ArealPsd psd = areal_psd(map, with("none", 0));
  ASSERT_EQ(psd.rows, 9);
  ASSERT_EQ(psd.cols, 14);
  EXPECT_NEAR(psd.step_x, 1.0 / 7.0, 1e-15);
  EXPECT_NEAR(psd.step_y, 1.0 / 1.8, 1e-15);
  const auto valid = static_cast<double>(map.valid_pixels());
  for (Index row = 0; row < 9; ++row) {
    for (Index col = 0; col < psd.half_cols(); ++col) {
      std::complex<double> sum = 0.0;
      for (const Index i : finite_pixels(map)) {
        const Point p = map.grid.centre(i);
        const double phase = psd.step_x * static_cast<double>(col) * p.x + psd.frequency_y(row) * p.y;
        sum += map.values[static_cast<std::size_t>(i)] * std::polar(1.0, -2.0 * pi * phase);
      }
      const double expected = 0.5 * 0.2 * std::norm(sum) / valid;
      EXPECT_NEAR(psd.density[static_cast<std::size_t>(row * psd.half_cols() + col)], expected,
                  1e-12 * (1.0 + expected));
    }
  }
}

TEST(Psd, OfAWaveLiesAtItsFrequency) {
  HeightMap map(Grid{60, 80, 0.25, 0.5, {2.0, 2.0}});  // 20 mm x 30 mm
  for (Index i = 0; i < map.grid.size(); ++i) {
    map.values[static_cast<std::size_t>(i)] = 3.0 * std::sin(2.0 * pi * 0.4 * map.grid.centre(i).x);  // 2.5 mm
  }
  const ArealPsd psd = areal_psd(map, with("hann"));
  const PsdCurve x = psd_along_x(psd);
  const auto peak = std::max_element(x.density.begin(), x.density.end()) - x.density.begin();
  EXPECT_NEAR(x.frequency[static_cast<std::size_t>(peak)], 0.4, 0.5 * psd.step_x);
  EXPECT_NEAR(psd.mean_square, 4.5, 1e-3);
  EXPECT_NEAR(integral(x, psd.step_x), 4.5, 0.02);
  // Nothing runs along y: what the window leaves of it lies at fy = 0 and in its first two side lobes.
  const PsdCurve y = psd_along_y(psd);
  for (std::size_t k = 2; k < y.frequency.size(); ++k) EXPECT_LE(y.density[k], 1e-3) << y.frequency[k];
  const std::vector<double> bands = band_mean_squares(psd, {0.3, 0.5});
  EXPECT_NEAR(bands[1], 4.5, 0.01);
  EXPECT_LE(bands[0] + bands[2], 0.01);
}

TEST(Psd, BandsAddUpToTheWhole) {
  const ArealPsd psd = areal_psd(rough(kPrime, true), with("hann"));
  for (const std::vector<double>& edges :
       {std::vector<double>{}, {0.1}, {0.05, 0.2, 0.7}, {1e-9, 1e9}, {psd.step_x, 2.0 * psd.step_x}}) {
    const std::vector<double> bands = band_mean_squares(psd, edges);
    ASSERT_EQ(bands.size(), edges.size() + 1);
    EXPECT_NEAR(std::accumulate(bands.begin(), bands.end(), 0.0), psd.mean_square, 1e-12 * psd.mean_square);
  }
  const std::vector<double> all = band_mean_squares(psd, {1e-9, 1e9});
  EXPECT_NEAR(all[0], psd.density[0] * psd.step_x * psd.step_y, 1e-15);
  EXPECT_EQ(all[2], 0.0);
}

/// A map of the spectrum a f^-b [nm^2 mm^2], of random phases, on a periodic square, without a fast transform.
HeightMap synthetic(Index size, double pitch, double a, double b, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double step = 1.0 / (static_cast<double>(size) * pitch);
  const auto n = static_cast<std::size_t>(size);
  std::vector<std::complex<double>> turn(n);
  for (std::size_t k = 0; k < n; ++k)
    turn[k] = std::polar(1.0, 2.0 * pi * static_cast<double>(k) / static_cast<double>(n));
  std::vector<std::complex<double>> column(n * n);  // after the sum over fy: [fx][y]
  for (std::size_t p = 0; p < n / 2; ++p) {
    for (std::size_t q = 0; q < n; ++q) {
      const double fx = step * static_cast<double>(p),
                   fy = step * (static_cast<double>(q) - (q > n / 2 ? static_cast<double>(n) : 0.0));
      const double f = std::hypot(fx, fy), density = f > 0.0 ? a * std::pow(f, -b) : 0.0;
      // Half of each pair +-f is summed: twice its share, as a mean square, of a real wave.
      const double size_of = std::sqrt(density) * step * (p == 0 ? 1.0 / std::numbers::sqrt2 : 1.0);
      const std::complex<double> c{size_of * normal(random), size_of * normal(random)};
      for (std::size_t y = 0; y < n; ++y) column[p * n + y] += c * turn[q * y % n];
    }
  }
  HeightMap map(Grid{size, size, pitch, pitch, {}});
  for (std::size_t y = 0; y < n; ++y) {
    for (std::size_t x = 0; x < n; ++x) {
      double z = 0.0;
      for (std::size_t p = 0; p < n / 2; ++p) z += (column[p * n + y] * turn[p * x % n]).real();
      map.values[y * n + x] = std::numbers::sqrt2 * z;
    }
  }
  return map;
}

/// Mean ratio of the radial spectrum to a f^-b on a disc with a hole and lost pixels, over octaves from 4 periods on.
std::vector<double> bias_on_disc(double b, const char* window) {
  constexpr Index kSize = 150;
  std::vector<double> ratio(4), count(4);
  for (unsigned seed = 1; seed <= 6; ++seed) {
    HeightMap map = synthetic(kSize, 0.2, 3.0, b, seed);
    for (Index r = 0; r < kSize; ++r) {
      for (Index c = 0; c < kSize; ++c) {
        const double rho = std::hypot(static_cast<double>(r) - 70.0, static_cast<double>(c) - 65.0) / 60.0;
        if (rho > 1.0 || (31 * r + 17 * c) % 211 == 0) map.at(r, c) = std::nan("");
      }
    }
    const PsdCurve radial = radial_psd(areal_psd(without_form(map, {true, true}), with(window)));
    for (std::size_t k = 0; k < radial.frequency.size(); ++k) {
      const double f = radial.frequency[k], octave = std::log2(f * 24.0 / 4.0);  // 24 mm across
      if (octave < 0.0 || octave >= 4.0 || f > 0.8 * radial.resolved_to) continue;
      ratio[static_cast<std::size_t>(octave)] += radial.density[k] / (3.0 * std::pow(f, -b));
      count[static_cast<std::size_t>(octave)] += 1.0;
    }
  }
  for (std::size_t k = 0; k < ratio.size(); ++k) ratio[k] /= count[k];
  return ratio;
}

TEST(Psd, OnADiscIsThatOfTheSurface) {
  for (const double b : {0.0, 1.5, 3.0}) {
    for (const double ratio : bias_on_disc(b, "hann")) EXPECT_NEAR(ratio, 1.0, 0.12) << b;
  }
  // What the window is for: without it the edge leaks into the high frequencies of a steep spectrum.
  EXPECT_GT(bias_on_disc(4.0, "none")[3], 3.0 * bias_on_disc(4.0, "hann")[3]);
}

TEST(Psd, LinesAreTheSpectrumOfTheRows) {
  // White noise of variance s^2: one-sided 2 s^2 h along a line, s^2 hx hy over the plane.
  HeightMap map(Grid{200, 300, 0.5, 0.2, {}});
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, 4.0);
  for (double& z : map.values) z = normal(random);
  const ArealPsd psd = areal_psd(map, with("hann"));
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  EXPECT_NEAR(mean(psd_along_x(psd).density), 2.0 * 16.0 * 0.5, 0.05 * 16.0);
  EXPECT_NEAR(mean(psd_along_y(psd).density), 2.0 * 16.0 * 0.2, 0.05 * 6.4);
  EXPECT_NEAR(mean(radial_psd(psd).density), 16.0 * 0.5 * 0.2, 0.05 * 1.6);
  EXPECT_EQ(psd_along_x(psd).resolved_to, 1.0);
  EXPECT_EQ(radial_psd(psd).resolved_to, 1.0);
  EXPECT_NEAR(psd_along_y(psd).resolved_from, 2.0 / 40.0, 1e-15);
}

TEST(Psd, NeedsAFinitePixelAndTakesOne) {
  HeightMap map(Grid{3, 4, 0.5, 0.25, {}});
  test::expect_input_error([&] { areal_psd(map, {}); }, {"no finite pixel"});
  map.at(1, 2) = 3.0;
  const ArealPsd psd = areal_psd(map, {});
  EXPECT_NEAR(psd.mean_square, 9.0, 1e-12);
  EXPECT_TRUE(radial_psd(psd).frequency.empty());
  EXPECT_TRUE(psd_along_x(psd).frequency.empty());
}

TEST(Psd, IsTheSameForAnyNumberOfThreads) {
  const HeightMap map = rough(kPrime, true);
  PsdOptions one, three;
  three.threads = 3;
  const ArealPsd a = areal_psd(map, one), b = areal_psd(map, three);
  for (std::size_t i = 0; i < a.density.size(); ++i)
    ASSERT_NEAR(a.density[i], b.density[i], 1e-13 * (1 + a.density[i]));
}

TEST(SpectralWindow, FollowsTheNearestEdgeWhereThereAreHoles) {
  HeightMap map(Grid{7, 12, 0.5, 0.75, {}}, std::vector<double>(84, 1.0));
  map.at(2, 3) = map.at(6, 11) = std::nan("");
  const std::vector<double> weights = window_weights(map, parse_spectral_window("hann"), 2);
  std::vector<double> distance(84, 0.0);
  double most = 0.0;
  for (Index r = 0; r < 7; ++r) {
    for (Index c = 0; c < 12; ++c) {
      if (std::isnan(map.at(r, c))) continue;
      double nearest = 1e9;
      for (Index i = -1; i <= 7; ++i) {
        for (Index j = -1; j <= 12; ++j) {
          const bool missing = i < 0 || j < 0 || i > 6 || j > 11 || std::isnan(map.at(i, j));
          if (missing)
            nearest =
                std::min(nearest, std::hypot(0.5 * static_cast<double>(j - c), 0.75 * static_cast<double>(i - r)));
        }
      }
      distance[static_cast<std::size_t>(12 * r + c)] = nearest - 0.25;
      most = std::max(most, nearest - 0.25);
    }
  }
  for (std::size_t i = 0; i < 84; ++i) {
    EXPECT_NEAR(weights[i], std::pow(std::sin(0.5 * pi * distance[i] / most), 2), 1e-12) << i;
  }
}

TEST(SpectralWindow, OfAFullMapIsAProduct) {
  const HeightMap map(Grid{3, 4, 0.5, 0.75, {}}, std::vector<double>(12, 1.0));
  const std::vector<double> w = window_weights(map, parse_spectral_window("tukey:0.5"));
  // Along x t = 1/4, 3/4, 3/4, 1/4; along y 1/3, 1, 1/3.
  EXPECT_NEAR(w[0], std::pow(std::sin(pi / 4) * std::sin(pi / 3), 2), 1e-15);
  EXPECT_NEAR(w[1], std::pow(std::sin(pi / 3), 2), 1e-15);
  EXPECT_NEAR(w[5], 1.0, 1e-15);
}

TEST(SpectralWindow, TextIsReadAndWritten) {
  for (const char* text : {"hann", "none", "tukey:0.25"}) EXPECT_EQ(to_string(parse_spectral_window(text)), text);
  for (const char* text : {"", "hamming", "tukey", "tukey:0", "tukey:1.5", "tukey:nan", "hann:1"}) {
    test::expect_input_error([&] { parse_spectral_window(text); }, {text, "tukey:R"});
  }
}

TEST(BridgeGaps, FillsShortOnesOnly) {
  const double n = std::nan("");
  HeightMap map(Grid{2, 8, 1.0, 1.0, {}}, {n, 1, n, n, 7, n, n, n, 2, n, n, n, n, n, n, 5});
  EXPECT_EQ(bridge_gaps(map, 2), 2);
  EXPECT_EQ(map.at(0, 2), 3.0);
  EXPECT_EQ(map.at(0, 3), 5.0);
  EXPECT_TRUE(std::isnan(map.at(0, 0)));
  EXPECT_TRUE(std::isnan(map.at(0, 5)));
  EXPECT_TRUE(std::isnan(map.at(1, 1)));
  HeightMap column(Grid{4, 1, 1.0, 1.0, {}}, {1, n, n, 4});
  EXPECT_EQ(bridge_gaps(column, 2), 2);
  EXPECT_EQ(column.at(1, 0), 2.0);
}

}  // namespace
}  // namespace dwell
