#include "runs/example/example.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "core/base/errors.h"
#include "tests/oracle/dense_algebra.h"

namespace dwell {
namespace {

constexpr double kPi = std::numbers::pi;

ExampleOptions flat() {
  ExampleOptions o;
  o.power = o.astigmatism = o.astigmatism45 = o.coma_x = o.coma_y = o.trefoil = o.spherical = 0.0;
  o.bump = o.edge_rolloff = o.noise_rms = o.roughness_rms = 0.0;
  return o;
}

std::vector<double> finite_values(const HeightMap& map) {
  std::vector<double> values;
  for (const Index i : finite_pixels(map)) values.push_back(map.values[static_cast<std::size_t>(i)]);
  return values;
}

double mean(const std::vector<double>& v) {
  double sum = 0.0;
  for (const double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}

double rms_about_mean(const std::vector<double>& v) {
  const double m = mean(v);
  double sum = 0.0;
  for (const double x : v) sum += (x - m) * (x - m);
  return std::sqrt(sum / static_cast<double>(v.size()));
}

double pv(const HeightMap& map) {
  const std::vector<double> v = finite_values(map);
  return *std::max_element(v.begin(), v.end()) - *std::min_element(v.begin(), v.end());
}

// Least squares by QR, sharing no code with the library's form removal.
double rms_without_piston_and_tilt(const HeightMap& map) {
  const std::vector<Index> pixels = finite_pixels(map);
  Eigen::MatrixXd basis(pixels.size(), 3);
  Eigen::VectorXd z(pixels.size());
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const Point p = map.grid.centre(pixels[k]);
    basis.row(static_cast<Index>(k)) << 1.0, p.x, p.y;
    z[static_cast<Index>(k)] = map.values[static_cast<std::size_t>(pixels[k])];
  }
  const Eigen::VectorXd rest = z - basis * oracle::least_squares_by_qr(basis, z);
  return std::sqrt(rest.squaredNorm() / static_cast<double>(pixels.size()));
}

// Slope of the two-dimensional PSD of a square map by a plain DFT (Hann window in x and y), least squares in log-log
// over octaves of f from 4 to 32 cycles an edge.
double psd_slope(const HeightMap& map) {
  const Index n = map.grid.rows;
  const Index top = 32;
  Eigen::MatrixXd z(n, n);
  for (Index r = 0; r < n; ++r) {
    for (Index c = 0; c < n; ++c) {
      const auto hann = [&](Index i) {
        return std::pow(std::sin(kPi * (static_cast<double>(i) + 0.5) / static_cast<double>(n)), 2);
      };
      z(r, c) = map.at(r, c) * hann(r) * hann(c);
    }
  }
  Eigen::MatrixXcd basis(n, 2 * top + 1);
  for (Index k = -top; k <= top; ++k) {
    for (Index i = 0; i < n; ++i)
      basis(i, k + top) = std::polar(1.0, -2.0 * kPi * static_cast<double>(k * i) / static_cast<double>(n));
  }
  const Eigen::MatrixXd power = (basis.transpose() * z * basis).cwiseAbs2();
  std::vector<double> sum(6, 0.0), count(6, 0.0);  // half octaves from 4
  for (Index ky = -top; ky <= top; ++ky) {
    for (Index kx = -top; kx <= top; ++kx) {
      const double band = 2.0 * std::log2(std::hypot(static_cast<double>(kx), static_cast<double>(ky)) / 4.0);
      if (!(band >= 0.0 && band < 6.0)) continue;
      sum[static_cast<std::size_t>(band)] += power(ky + top, kx + top);
      count[static_cast<std::size_t>(band)] += 1.0;
    }
  }
  Eigen::MatrixXd line(6, 2);
  Eigen::VectorXd level(6);
  for (Index b = 0; b < 6; ++b) {
    const std::size_t i = static_cast<std::size_t>(b);
    line.row(b) << 1.0, 0.5 * static_cast<double>(b);
    level[b] = std::log2(sum[i] / count[i]);
  }
  return oracle::least_squares_by_qr(line, level)(1, 0);
}

TEST(ExampleMirror, DefaultIsTheDemoMirror) {
  const HeightMap map = example_mirror();
  EXPECT_EQ(map.grid.rows, 200);
  EXPECT_EQ(map.grid.cols, 200);
  EXPECT_DOUBLE_EQ(map.grid.x(0), -49.75);
  // The area of the disc in pixels, to within those that its rim crosses.
  EXPECT_NEAR(static_cast<double>(map.valid_pixels()), kPi * 100.0 * 100.0, 4.0 * 200.0);
  EXPECT_TRUE(std::isnan(map.at(0, 0)));
  EXPECT_NEAR(rms_without_piston_and_tilt(map), 60.0, 6.0);
}

TEST(ExampleMirror, HasNoSymmetryThatWouldHideAnOrientationError) {
  const HeightMap map = example_mirror();
  const Index n = map.grid.rows;
  const double own = rms_about_mean(finite_values(map));
  const auto differs = [&](auto source) {
    double sum = 0.0, count = 0.0;
    for (Index r = 0; r < n; ++r) {
      for (Index c = 0; c < n; ++c) {
        const auto [rr, cc] = source(r, c);
        const double d = map.at(r, c) - map.at(rr, cc);
        if (!std::isfinite(d)) continue;
        sum += d * d;
        count += 1.0;
      }
    }
    return std::sqrt(sum / count);
  };
  using RowCol = std::pair<Index, Index>;
  EXPECT_GT(differs([&](Index r, Index c) { return RowCol{r, n - 1 - c}; }), 0.3 * own) << "mirrored in x";
  EXPECT_GT(differs([&](Index r, Index c) { return RowCol{n - 1 - r, c}; }), 0.3 * own) << "mirrored in y";
  EXPECT_GT(differs([&](Index r, Index c) { return RowCol{n - 1 - r, n - 1 - c}; }), 0.3 * own) << "half a turn";
  EXPECT_GT(differs([&](Index r, Index c) { return RowCol{c, r}; }), 0.3 * own) << "transposed";
  EXPECT_GT(differs([&](Index r, Index c) { return RowCol{n - 1 - c, n - 1 - r}; }), 0.3 * own) << "anti-transposed";
}

TEST(ExampleMirror, FormTermsHaveTheirPvAndDirection) {
  ExampleOptions o = flat();
  o.pitch = 0.25;
  const auto pv_of = [&](double ExampleOptions::*term) {
    ExampleOptions one = o;
    one.*term = 50.0;
    return pv(example_mirror(one));
  };
  // Pixels reach the rim to within one pitch; the steepest term there (spherical) falls 12 / 1.5 * 50 nm a radius.
  const double tolerance = 12.0 / 1.5 * 50.0 * o.pitch / 50.0;
  for (const auto term :
       {&ExampleOptions::power, &ExampleOptions::astigmatism, &ExampleOptions::astigmatism45, &ExampleOptions::coma_x,
        &ExampleOptions::coma_y, &ExampleOptions::trefoil, &ExampleOptions::spherical}) {
    EXPECT_NEAR(pv_of(term), 50.0, tolerance);
  }
  ExampleOptions coma = flat();
  coma.coma_y = 50.0;
  const HeightMap map = example_mirror(coma);
  EXPECT_GT(map.at(map.grid.rows - 1, map.grid.cols / 2), 20.0) << "coma_y is high at the rim towards +y";
  EXPECT_LT(map.at(0, map.grid.cols / 2), -20.0);
}

TEST(ExampleMirror, ShapesHoleAndRollOff) {
  ExampleOptions o = flat();
  o.hole = 30.0;
  o.edge_rolloff = 100.0;
  const HeightMap ring = example_mirror(o);
  EXPECT_TRUE(std::isnan(ring.at(100, 100)));
  const double depth = std::hypot(15.75, 0.25) - 15.0;
  EXPECT_NEAR(ring.at(100, 100 + 31), -100.0 * std::exp(-depth / o.edge_width), 1e-9) << "rolled off at the hole too";
  EXPECT_NEAR(ring.at(100, 100 + 65), 0.0, 0.2);
  EXPECT_LT(ring.at(100, 199), -80.0);

  o = flat();
  o.shape = ExampleOptions::Shape::Rectangle;
  o.width = 60.0;
  o.height = 20.0;
  const HeightMap bar = example_mirror(o);
  EXPECT_EQ(bar.grid.cols, 120);
  EXPECT_EQ(bar.grid.rows, 40);
  EXPECT_EQ(bar.valid_pixels(), 120 * 40);
}

TEST(ExampleMirror, RoughnessHasTheRmsAskedFor) {
  ExampleOptions o = flat();
  o.roughness_rms = 7.5;
  const std::vector<double> v = finite_values(example_mirror(o));
  // It is scaled to this; what remains is the rounding of sums over 31,400 pixels.
  EXPECT_NEAR(rms_about_mean(v), 7.5, 1e-10);
  EXPECT_NEAR(mean(v), 0.0, 1e-10);
}

TEST(ExampleMirror, NoiseIsWhiteWithTheRmsAskedFor) {
  ExampleOptions o = flat();
  o.noise_rms = 2.0;
  const HeightMap map = example_mirror(o);
  const std::vector<double> v = finite_values(map);
  const double n = static_cast<double>(v.size());
  EXPECT_NEAR(mean(v), 0.0, 5.0 * 2.0 / std::sqrt(n));                  // 5 standard errors
  EXPECT_NEAR(rms_about_mean(v), 2.0, 5.0 * 2.0 / std::sqrt(2.0 * n));  // 5 standard errors
  double correlation = 0.0;
  for (std::size_t i = 1; i < v.size(); ++i) correlation += v[i] * v[i - 1];
  EXPECT_LE(std::abs(correlation / (n * 4.0)), 5.0 / std::sqrt(n));
}

TEST(ExampleMirror, RoughnessFollowsThePowerLaw) {
  for (const double slope : {-3.0, -2.0, -4.0}) {
    double sum = 0.0;
    const int seeds = 6;
    for (int seed = 1; seed <= seeds; ++seed) {
      ExampleOptions o = flat();
      o.shape = ExampleOptions::Shape::Rectangle;
      o.width = o.height = 64.0;
      o.roughness_rms = 10.0;
      o.roughness_slope = slope;
      o.seed = static_cast<std::uint64_t>(seed);
      sum += psd_slope(example_mirror(o));
    }
    // A half octave holds about 33 modes of one size that interfere: 1 / sqrt(33) of its power, 0.25 octaves; the
    // fit over six of them has 0.25 / 2.1 = 0.12 in the slope, the mean of six seeds 0.05. Four of these.
    EXPECT_NEAR(sum / seeds, slope, 0.2);
  }
}

TEST(ExampleMirror, SeedDecides) {
  ExampleOptions o;
  const HeightMap a = example_mirror(o);
  const HeightMap b = example_mirror(o);
  o.seed = 2;
  const HeightMap c = example_mirror(o);
  double differs = 0.0;
  for (const Index i : finite_pixels(a)) {
    const auto k = static_cast<std::size_t>(i);
    ASSERT_EQ(a.values[k], b.values[k]);
    differs = std::max(differs, std::abs(a.values[k] - c.values[k]));
  }
  EXPECT_GT(differs, 5.0);
}

TEST(ExampleMirror, RejectsOptionsByName) {
  const auto message = [](auto change) -> std::string {
    ExampleOptions o;
    change(o);
    try {
      example_mirror(o);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message([&](auto& o) { o.pitch = -0.5; }).find("`pitch` = -0.5 mm; required > 0"), std::string::npos);
  EXPECT_NE(message([&](auto& o) { o.pitch = 0.001; }).find("4096"), std::string::npos);
  EXPECT_NE(message([&](auto& o) { o.pitch = 80.0; }).find("2 to 4096"), std::string::npos);
  EXPECT_NE(message([&](auto& o) { o.width = nan; }).find("`width` = nan mm"), std::string::npos);
  EXPECT_NE(message([&](auto& o) { o.coma_x = nan; }).find("coma_x = nan"), std::string::npos);
  EXPECT_NE(message([&](auto& o) { o.noise_rms = -1.0; }).find("noise_rms = -1"), std::string::npos);
  EXPECT_NE(message([&](auto& o) { o.hole = 100.0; }).find("`hole` = 100 mm"), std::string::npos);
  EXPECT_NE(message([&](auto& o) { o.roughness_slope = 1.0; }).find("roughness_slope = 1"), std::string::npos);
  EXPECT_NE(message([&](auto& o) { o.edge_width = 0.0; }).find("edge_width = 0"), std::string::npos);
}

TEST(ExampleTif, HasThePeakTheWidthAndTheAsymmetryAskedFor) {
  ExampleTifOptions o;
  o.noise_rms = 0.0;
  const HeightMap tif = example_tif(o);
  EXPECT_EQ(tif.grid.rows, 65);
  EXPECT_DOUBLE_EQ(tif.grid.x(32), 0.0);
  const double peak = *std::max_element(tif.values.begin(), tif.values.end());
  // The peak lies within half a pixel diagonal of a sample; there a Gaussian has fallen by (2 sqrt(ln 2) d / fwhm)^2
  // on its long, and by ellipticity times that on its short axis.
  const double d = 0.5 * std::sqrt(2.0) * o.pitch;
  EXPECT_LE(peak, o.peak);
  EXPECT_GE(peak, o.peak * (1.0 - 1.3 * 4.0 * std::log(2.0) * std::pow(d / o.fwhm, 2)));
  double area = 0.0, sum = 0.0, x = 0.0, y = 0.0;
  for (Index i = 0; i < tif.grid.size(); ++i) {
    const double b = tif.values[static_cast<std::size_t>(i)];
    if (b >= 0.5 * o.peak) area += o.pitch * o.pitch;
    sum += b;
    x += b * tif.grid.centre(i).x;
    y += b * tif.grid.centre(i).y;
  }
  // Counting pixels of an area of 28 mm^2 is right to those on its rim, a few of the 450.
  EXPECT_NEAR(std::sqrt(4.0 * area / kPi), o.fwhm, 0.1);
  EXPECT_GT(std::hypot(x / sum, y / sum), o.pitch) << "off its grid's middle by more than a pixel";
  const Index n = tif.grid.rows;
  double turned = 0.0;
  for (Index r = 0; r < n; ++r) {
    for (Index c = 0; c < n; ++c) turned = std::max(turned, std::abs(tif.at(r, c) - tif.at(n - 1 - r, n - 1 - c)));
  }
  EXPECT_GT(turned, 0.05 * o.peak);
}

TEST(ExampleTif, SeedDecidesItsNoise) {
  ExampleTifOptions o;
  const HeightMap a = example_tif(o);
  EXPECT_EQ(a.values, example_tif(o).values);
  o.noise_rms = 0.0;
  const HeightMap clean = example_tif(o);
  std::vector<double> noise;
  for (std::size_t i = 0; i < a.values.size(); ++i) noise.push_back(a.values[i] - clean.values[i]);
  EXPECT_NEAR(rms_about_mean(noise), 0.01, 5.0 * 0.01 / std::sqrt(2.0 * static_cast<double>(noise.size())));
}

TEST(ExampleTif, RejectsOptionsByName) {
  const auto rejects = [](auto change) {
    ExampleTifOptions o;
    change(o);
    EXPECT_THROW(example_tif(o), InputError);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  rejects([&](auto& o) { o.peak = 0.0; });
  rejects([&](auto& o) { o.fwhm = nan; });
  rejects([&](auto& o) { o.pitch = 4.0; });
  rejects([&](auto& o) { o.half_width = 2.0; });
  rejects([&](auto& o) { o.half_width = 1e8; });
  rejects([&](auto& o) { o.ellipticity = 0.5; });
  rejects([&](auto& o) { o.skew = 0.9; });
  rejects([&](auto& o) { o.shear = nan; });
  rejects([&](auto& o) { o.angle = nan; });
  rejects([&](auto& o) { o.offset_x = 100.0; });
  rejects([&](auto& o) { o.noise_rms = -1.0; });
}

}  // namespace
}  // namespace dwell
