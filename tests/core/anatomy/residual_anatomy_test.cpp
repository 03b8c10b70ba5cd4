#include "core/anatomy/residual_anatomy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>

#include "core/base/random_numbers.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

constexpr double kLost = std::numeric_limits<double>::quiet_NaN();
constexpr double kFwhm = 3.0;  // [mm]
const Grid kPart{200, 230, 0.2, 0.25, {-4.0, 3.0}};

HeightMap surface(const Grid& grid, const std::function<double(Point)>& height) {
  HeightMap map(grid);
  for (Index i = 0; i < grid.size(); ++i) map.values[static_cast<std::size_t>(i)] = height(grid.centre(i));
  return map;
}

double mean_square(const HeightMap& map) {
  double sum = 0.0;
  for (const double v : map.values) sum += std::isnan(v) ? 0.0 : v * v;
  return sum / static_cast<double>(map.valid_pixels());
}

/// The shares in per cent: blemishes, edge, shorter, middle, longer.
std::vector<double> shares_of(const HeightMap& map, double fwhm = kFwhm) {
  const ResidualAnatomy a = residual_anatomy(map, fwhm, {}, 2);
  const ResidualShares& s = a.mean_square;
  EXPECT_NEAR(s.whole(), mean_square(map), 1e-12 * mean_square(map));
  std::vector<double> shares;
  for (const double part : {s.blemishes, s.edge, s.shorter, s.middle, s.longer}) {
    EXPECT_GE(part, 0.0);
    shares.push_back(100.0 * a.share(part));
  }
  return shares;
}

/// Whether a pixel lies in the zone at the edge of a map without holes: from the definition.
bool at_edge(Index row, Index col, const Grid& g, double width) {
  const double right = g.pitch_x * static_cast<double>(g.cols - col), left = g.pitch_x * static_cast<double>(col + 1);
  const double up = g.pitch_y * static_cast<double>(g.rows - row), down = g.pitch_y * static_cast<double>(row + 1);
  return std::min({right, left, up, down}) - 0.5 * std::min(g.pitch_x, g.pitch_y) <= width;
}

TEST(ResidualAnatomy, KnowsAPit) {
  for (const double radius : {0.15, 0.4, 0.7}) {
    const auto shares = shares_of(surface(kPart, [&](Point p) {
      return distance(p, {12.0, 23.0}) < radius ? -20.0 : 0.0;
    }));
    EXPECT_GE(shares[0], 98.0) << radius;
  }
}

TEST(ResidualAnatomy, KnowsAnEdge) {
  const double right = kPart.x(kPart.cols - 1), top = kPart.y(kPart.rows - 1);
  const auto shares = shares_of(surface(kPart, [&](Point p) {
    const double from_edge = std::min({p.x - kPart.origin.x, right - p.x, p.y - kPart.origin.y, top - p.y});
    return 40.0 * std::exp(-from_edge * from_edge / 0.5);
  }));
  EXPECT_GE(shares[1], 98.0);
}

TEST(ResidualAnatomy, KnowsARippleByItsWavelength) {
  struct Case {
    double wave;
    std::size_t part;
  };
  for (const Case& c : {Case{0.5 * kFwhm, 2}, Case{0.75 * kFwhm, 2}, Case{1.35 * kFwhm, 3}, Case{2.0 * kFwhm, 3},
                        Case{6.0 * kFwhm, 4}, Case{10.0 * kFwhm, 4}}) {
    for (const double degrees : {0.0, 30.0, 90.0}) {
      const double turn = degrees * std::numbers::pi / 180.0;
      const HeightMap map = surface(kPart, [&](Point p) {
        return 5.0 * std::sin(2.0 * std::numbers::pi * (std::cos(turn) * p.x + std::sin(turn) * p.y) / c.wave + 0.4);
      });
      double edge = 0.0;
      for (Index row = 0; row < kPart.rows; ++row) {
        for (Index col = 0; col < kPart.cols; ++col)
          edge += at_edge(row, col, kPart, 0.5 * kFwhm) ? map.at(row, col) * map.at(row, col) : 0.0;
      }
      edge *= 100.0 / (mean_square(map) * static_cast<double>(kPart.size()));
      const auto shares = shares_of(map);
      EXPECT_EQ(shares[0], 0.0) << c.wave << " " << degrees;
      EXPECT_NEAR(shares[1], edge, 1e-9) << c.wave << " " << degrees;
      EXPECT_NEAR(shares[c.part], 100.0 - edge, 2.0) << c.wave << " " << degrees;
    }
  }
}

TEST(ResidualAnatomy, KnowsAPistonAsLong) {
  const auto shares = shares_of(surface(kPart, [](Point) { return 3.0; }));
  EXPECT_EQ(shares[0], 0.0);
  EXPECT_NEAR(shares[1] + shares[4], 100.0, 1e-9);
}

/// Mean squares of the bands of the inner rectangle under a Hann window, by the discrete Fourier transform as it is
/// defined; shorter, middle, longer, scaled to the mean square of the rectangle about its mean.
std::vector<double> slow_bands(const HeightMap& map, Index row0, Index rows, Index col0, Index cols, double fwhm) {
  const auto hann = [](Index k, Index n) {
    const double s = std::sin(std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n));
    return s * s;
  };
  double mean = 0.0, square = 0.0;
  for (Index r = 0; r < rows; ++r) {
    for (Index c = 0; c < cols; ++c) mean += map.at(row0 + r, col0 + c) / static_cast<double>(rows * cols);
  }
  for (Index r = 0; r < rows; ++r) {
    for (Index c = 0; c < cols; ++c)
      square += std::pow(map.at(row0 + r, col0 + c) - mean, 2) / static_cast<double>(rows * cols);
  }
  std::vector<double> bands(3, 0.0);
  for (Index u = 0; u < rows; ++u) {
    for (Index v = 0; v < cols; ++v) {
      std::complex<double> sum = 0.0;
      for (Index r = 0; r < rows; ++r) {
        for (Index c = 0; c < cols; ++c) {
          const double turns = static_cast<double>(u * r) / static_cast<double>(rows) +
                               static_cast<double>(v * c) / static_cast<double>(cols);
          sum += hann(r, rows) * hann(c, cols) * (map.at(row0 + r, col0 + c) - mean) *
                 std::polar(1.0, -2.0 * std::numbers::pi * turns);
        }
      }
      const double fy = static_cast<double>(std::min(u, rows - u)) / (static_cast<double>(rows) * map.grid.pitch_y);
      const double fx = static_cast<double>(std::min(v, cols - v)) / (static_cast<double>(cols) * map.grid.pitch_x);
      const double f = std::hypot(fx, fy);
      bands[f >= 1.0 / fwhm ? 0 : f >= 1.0 / (3.0 * fwhm) ? 1 : 2] += std::norm(sum);
    }
  }
  const double all = bands[0] + bands[1] + bands[2];
  for (double& b : bands) b *= square / all;
  bands[2] += mean * mean;
  return bands;
}

TEST(ResidualAnatomy, AgreesWithADirectFourierTransform) {
  constexpr double kTool = 2.0;
  const Grid grid{44, 36, 0.4, 0.25, {1.0, -2.0}};  // inside of the edge zone: 36 x 32, sizes of fast transforms
  RandomNumbers random(11);
  const HeightMap map = surface(grid, [&](Point p) {
    return random.normal() + 2.0 * std::sin(1.9 * p.x - 1.1 * p.y) + 0.8 * std::cos(0.6 * p.y) + 0.3;
  });
  Index rows = 0, cols = 0, row0 = -1, col0 = -1;
  for (Index r = 0; r < grid.rows; ++r) {
    if (at_edge(r, 19, grid, 0.5 * kTool)) continue;
    if (row0 < 0) row0 = r;
    ++rows;
  }
  for (Index c = 0; c < grid.cols; ++c) {
    if (at_edge(21, c, grid, 0.5 * kTool)) continue;
    if (col0 < 0) col0 = c;
    ++cols;
  }
  ASSERT_EQ(rows, 36);
  ASSERT_EQ(cols, 32);
  const ResidualAnatomy a = residual_anatomy(map, kTool, {}, 1, BlemishSearch::Off);
  const double inside = static_cast<double>(rows * cols) / static_cast<double>(grid.size());
  const std::vector<double> slow = slow_bands(map, row0, rows, col0, cols, kTool);
  EXPECT_NEAR(a.mean_square.shorter, inside * slow[0], 1e-9);
  EXPECT_NEAR(a.mean_square.middle, inside * slow[1], 1e-9);
  EXPECT_NEAR(a.mean_square.longer, inside * slow[2], 1e-9);
}

TEST(ResidualAnatomy, AddsUpOnAPartOfAnyShape) {
  RandomNumbers random(12);
  HeightMap map = surface(kPart, [&](Point p) {
    return random.normal() + std::sin(p.x) + (distance(p, {20.0, 20.0}) < 0.3 ? 120.0 : 0.0);
  });
  for (Index i = 0; i < kPart.size(); ++i) {
    const Point p = kPart.centre(i);
    const bool part = std::hypot((p.x - 19.0) / 22.0, (p.y - 27.0) / 23.0) < 1.0 && distance(p, {10.0, 30.0}) > 4.0;
    if (!part) map.values[static_cast<std::size_t>(i)] = kLost;
  }
  const auto shares = shares_of(map);
  EXPECT_GT(shares[0], 50.0);
  EXPECT_NEAR(shares[0] + shares[1] + shares[2] + shares[3] + shares[4], 100.0, 1e-9);
}

TEST(ResidualAnatomy, SaysWhatIsLeftWithoutBlemishes) {
  RandomNumbers random(13);
  const HeightMap clean = surface(kPart, [&](Point) { return random.normal(); });
  HeightMap map = clean;
  for (Index row = 90; row < 94; ++row) map.at(row, 77) += 500.0, map.at(row, 78) += 500.0;
  const FormTerms form{true, true};
  const HeightMap left = without_form(map, form);
  const ResidualAnatomy a = residual_anatomy(left, kFwhm, form);
  ASSERT_EQ(a.blemishes.size(), 1u);
  EXPECT_EQ(a.blemish_pixels, 8);
  // And the piston and tilt that the blemish gave the others.
  EXPECT_LE(a.of_blemish[0], a.mean_square.blemishes);
  EXPECT_NEAR(a.of_blemish[0], a.mean_square.blemishes, 1e-3 * a.mean_square.blemishes);
  EXPECT_NEAR(a.without.rms, 1.0, 0.01);
  EXPECT_NEAR(a.without.mean, 0.0, 1e-12);
  EXPECT_LT(a.without.pv, 10.0);
  EXPECT_EQ(a.without.valid_pixels, kPart.size() - 8);
  const ResidualAnatomy kept = residual_anatomy(left, kFwhm, form, 1, BlemishSearch::Off);
  EXPECT_TRUE(kept.blemishes.empty());
  EXPECT_EQ(kept.mean_square.blemishes, 0.0);
  EXPECT_NEAR(kept.mean_square.whole(), a.mean_square.whole(), 1e-9);
}

/// A deep pit takes piston and tilt with it: the rest stands high and leans, which is the pit's doing and no long wave.
TEST(ResidualAnatomy, BooksWhatABlemishAddsToTheFormOnTheBlemish) {
  const FormTerms form{.piston = true, .tilt = true};
  HeightMap map = surface(kPart, [](Point p) { return distance(p, {30.0, 40.0}) < 0.7 ? -80.0 : 0.0; });
  RandomNumbers random(4);
  double noise = 0.0;
  for (double& v : map.values) {
    const double z = 0.01 * random.normal();
    v += z;
    noise += z * z / static_cast<double>(map.values.size());
  }
  map = without_form(map, form);
  const ResidualAnatomy a = residual_anatomy(map, kFwhm, form);
  const ResidualShares& s = a.mean_square;
  EXPECT_NEAR(s.whole(), mean_square(map), 1e-12 * mean_square(map));
  EXPECT_NEAR(s.edge + s.interior(), noise, 0.02 * noise);
  EXPECT_LT(s.longer, 0.05 * noise);
  EXPECT_EQ(a.blemishes.size(), 1U);
}

TEST(ResidualAnatomy, OfAPartNarrowerThanTheToolIsAllEdge) {
  RandomNumbers random(14);
  const auto shares = shares_of(surface({8, 60, 0.3, 0.3, {}}, [&](Point) { return random.normal(); }), 3.0);
  EXPECT_NEAR(shares[1], 100.0, 1e-9);
}

TEST(ResidualAnatomy, RefusesAMapWithoutDataAndAToolWithoutWidth) {
  test::expect_input_error([] { residual_anatomy(HeightMap(kPart), kFwhm, {}); }, {"no finite pixel"});
  const HeightMap map = surface(kPart, [](Point) { return 1.0; });
  for (const double wrong : {0.0, -1.0, kLost})
    test::expect_input_error([&] { residual_anatomy(map, wrong, {}); }, {"fwhm", "a finite number > 0"});
}

TEST(EdgeZone, OfALineIsAtItsEnds) {
  HeightMap row(Grid{1, 40, 0.25, 3.0, {}}, std::vector<double>(40, 1.0));
  row.values[20] = std::nan("");
  HeightMap column(Grid{40, 1, 3.0, 0.25, {}}, row.values);
  // A zone of 1 mm: four pixels of 0.25 mm whose near sides are within it.
  for (const HeightMap& line : {row, column}) {
    const EdgeZone zone = edge_zone(line, 2.0, 1);
    for (std::size_t i = 0; i < 40; ++i) {
      const bool near = i < 4 || (i > 15 && i < 25 && i != 20) || i > 35;
      EXPECT_EQ(zone.holds[i], near ? 1 : 0) << i;
    }
    EXPECT_EQ(zone.pixels, 16);
  }
}

TEST(EdgeZone, IsTheDefinition) {
  const Grid grid{30, 34, 0.5, 0.3, {}};
  HeightMap map = surface(grid, [](Point) { return 1.0; });
  for (Index i = 0; i < grid.size(); ++i) {
    if (grid.centre(i).x + grid.centre(i).y < 4.0) map.values[static_cast<std::size_t>(i)] = kLost;
  }
  map.at(20, 22) = kLost;  // a lost pixel is no edge
  for (Index r = 9; r < 20; ++r) {
    for (Index c = 20; c < 30; ++c) map.at(r, c) = r > 14 || c < 26 ? kLost : 1.0;  // wider than the tool: an edge
  }
  constexpr double kTool = 3.0;
  const EdgeZone zone = edge_zone(map, kTool, 2);
  EXPECT_EQ(zone.width, 1.5);
  Index count = 0;
  for (Index r = 0; r < grid.rows; ++r) {
    for (Index c = 0; c < grid.cols; ++c) {
      double nearest = std::numeric_limits<double>::infinity();
      for (Index u = -1; u <= grid.rows; ++u) {
        for (Index v = -1; v <= grid.cols; ++v) {
          const bool on_map = u >= 0 && v >= 0 && u < grid.rows && v < grid.cols;
          if (on_map && (std::isfinite(map.at(u, v)) || (u == 20 && v == 22))) continue;
          nearest = std::min(nearest, distance(grid.centre(u, v), grid.centre(r, c)));
        }
      }
      const bool in_zone = std::isfinite(map.at(r, c)) && nearest - 0.15 <= 1.5;
      EXPECT_EQ(zone.holds[static_cast<std::size_t>(grid.index(r, c))] != 0, in_zone) << r << " " << c;
      count += in_zone ? 1 : 0;
    }
  }
  EXPECT_EQ(zone.pixels, count);
}

}  // namespace
}  // namespace dwell
