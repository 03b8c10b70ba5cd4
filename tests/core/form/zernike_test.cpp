#include "core/form/zernike.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <stdexcept>

namespace dwell {
namespace {

using std::sqrt;
using Closed = std::function<double(double rho, double theta)>;

double c(double x) { return std::cos(x); }
double s(double x) { return std::sin(x); }
double sq(double r) { return r * r; }

/// Noll 1976, table I: numbers 1 to 15.
const std::vector<Closed>& noll_table() {
  static const std::vector<Closed> kTable{
      [](double, double) { return 1.0; },
      [](double r, double t) { return 2 * r * c(t); },
      [](double r, double t) { return 2 * r * s(t); },
      [](double r, double) { return sqrt(3.0) * (2 * r * r - 1); },
      [](double r, double t) { return sqrt(6.0) * r * r * s(2 * t); },
      [](double r, double t) { return sqrt(6.0) * r * r * c(2 * t); },
      [](double r, double t) { return sqrt(8.0) * (3 * r * r * r - 2 * r) * s(t); },
      [](double r, double t) { return sqrt(8.0) * (3 * r * r * r - 2 * r) * c(t); },
      [](double r, double t) { return sqrt(8.0) * r * r * r * s(3 * t); },
      [](double r, double t) { return sqrt(8.0) * r * r * r * c(3 * t); },
      [](double r, double) { return sqrt(5.0) * (6 * sq(r * r) - 6 * r * r + 1); },
      [](double r, double t) { return sqrt(10.0) * (4 * sq(r * r) - 3 * r * r) * c(2 * t); },
      [](double r, double t) { return sqrt(10.0) * (4 * sq(r * r) - 3 * r * r) * s(2 * t); },
      [](double r, double t) { return sqrt(10.0) * sq(r * r) * c(4 * t); },
      [](double r, double t) { return sqrt(10.0) * sq(r * r) * s(4 * t); },
  };
  return kTable;
}

/// ANSI Z80.28, numbers 0 to 14: n = 0..4, m = -n..n.
const std::vector<Closed>& ansi_table() {
  static const std::vector<Closed> kTable{
      [](double, double) { return 1.0; },
      [](double r, double t) { return 2 * r * s(t); },
      [](double r, double t) { return 2 * r * c(t); },
      [](double r, double t) { return sqrt(6.0) * r * r * s(2 * t); },
      [](double r, double) { return sqrt(3.0) * (2 * r * r - 1); },
      [](double r, double t) { return sqrt(6.0) * r * r * c(2 * t); },
      [](double r, double t) { return sqrt(8.0) * r * r * r * s(3 * t); },
      [](double r, double t) { return sqrt(8.0) * (3 * r * r * r - 2 * r) * s(t); },
      [](double r, double t) { return sqrt(8.0) * (3 * r * r * r - 2 * r) * c(t); },
      [](double r, double t) { return sqrt(8.0) * r * r * r * c(3 * t); },
      [](double r, double t) { return sqrt(10.0) * sq(r * r) * s(4 * t); },
      [](double r, double t) { return sqrt(10.0) * (4 * sq(r * r) - 3 * r * r) * s(2 * t); },
      [](double r, double) { return sqrt(5.0) * (6 * sq(r * r) - 6 * r * r + 1); },
      [](double r, double t) { return sqrt(10.0) * (4 * sq(r * r) - 3 * r * r) * c(2 * t); },
      [](double r, double t) { return sqrt(10.0) * sq(r * r) * c(4 * t); },
  };
  return kTable;
}

/// Wyant and Creath 1992, table III (their 0 is number 1 here): numbers 1 to 16.
const std::vector<Closed>& fringe_table() {
  static const std::vector<Closed> kTable{
      [](double, double) { return 1.0; },
      [](double r, double t) { return r * c(t); },
      [](double r, double t) { return r * s(t); },
      [](double r, double) { return 2 * r * r - 1; },
      [](double r, double t) { return r * r * c(2 * t); },
      [](double r, double t) { return r * r * s(2 * t); },
      [](double r, double t) { return (3 * r * r - 2) * r * c(t); },
      [](double r, double t) { return (3 * r * r - 2) * r * s(t); },
      [](double r, double) { return 6 * sq(r * r) - 6 * r * r + 1; },
      [](double r, double t) { return r * r * r * c(3 * t); },
      [](double r, double t) { return r * r * r * s(3 * t); },
      [](double r, double t) { return (4 * r * r - 3) * r * r * c(2 * t); },
      [](double r, double t) { return (4 * r * r - 3) * r * r * s(2 * t); },
      [](double r, double t) { return (10 * sq(r * r) - 12 * r * r + 3) * r * c(t); },
      [](double r, double t) { return (10 * sq(r * r) - 12 * r * r + 3) * r * s(t); },
      [](double r, double) { return 20 * r * r * sq(r * r) - 30 * sq(r * r) + 12 * r * r - 1; },
  };
  return kTable;
}

void expect_table(ZernikeOrdering ordering, const std::vector<Closed>& table, Zernike::Normalisation normalisation) {
  for (std::size_t k = 0; k < table.size(); ++k) {
    const int number = first_zernike(ordering) + static_cast<int>(k);
    const Zernike zernike(zernike_index(ordering, number), 0.0, normalisation);
    for (const double rho : {0.0, 0.37, 0.81, 1.0, 1.2}) {
      for (const double theta : {0.0, 0.6, 2.5, -1.9}) {
        EXPECT_NEAR(zernike(rho * c(theta), rho * s(theta)), table[k](rho, theta), 1e-12)
            << to_string(ordering) << " " << number << " at " << rho << ", " << theta;
      }
    }
  }
}

TEST(Zernike, FollowsThePublishedTables) {
  expect_table(ZernikeOrdering::Noll, noll_table(), Zernike::Normalisation::UnitRms);
  expect_table(ZernikeOrdering::Ansi, ansi_table(), Zernike::Normalisation::UnitRms);
  expect_table(ZernikeOrdering::Fringe, fringe_table(), Zernike::Normalisation::UnitEdge);
}

TEST(Zernike, OrderingsEndAsPublished) {
  EXPECT_EQ(zernike_index(ZernikeOrdering::Noll, 22), (ZernikeIndex{6, 0}));
  EXPECT_EQ(zernike_index(ZernikeOrdering::Noll, 35), (ZernikeIndex{7, -7}));
  EXPECT_EQ(zernike_index(ZernikeOrdering::Noll, 36), (ZernikeIndex{7, 7}));
  EXPECT_EQ(zernike_index(ZernikeOrdering::Ansi, 35), (ZernikeIndex{7, 7}));
  EXPECT_EQ(zernike_index(ZernikeOrdering::Fringe, 25), (ZernikeIndex{8, 0}));
  EXPECT_EQ(zernike_index(ZernikeOrdering::Fringe, 26), (ZernikeIndex{5, 5}));
  EXPECT_EQ(zernike_index(ZernikeOrdering::Fringe, 36), (ZernikeIndex{10, 0}));
  EXPECT_EQ(zernike_index(ZernikeOrdering::Fringe, 37), (ZernikeIndex{12, 0}));
  EXPECT_THROW(zernike_index(ZernikeOrdering::Fringe, 38), std::invalid_argument);
  EXPECT_THROW(zernike_index(ZernikeOrdering::Noll, 0), std::invalid_argument);
  EXPECT_THROW(zernike_index(ZernikeOrdering::Ansi, -1), std::invalid_argument);
}

TEST(Zernike, NollAndAnsiNumberTheSamePolynomials) {
  std::set<std::pair<int, int>> noll, ansi;
  for (int k = 1; k <= 120; ++k) {
    const ZernikeIndex a = zernike_index(ZernikeOrdering::Noll, k), b = zernike_index(ZernikeOrdering::Ansi, k - 1);
    noll.emplace(a.n, a.m), ansi.emplace(b.n, b.m);
  }
  EXPECT_EQ(noll.size(), 120u);
  EXPECT_EQ(noll, ansi);
}

/// Mean over the annulus by the midpoint rule in rho^2 and theta: equal areas.
double mean_product(const Zernike& a, const Zernike& b, double obscuration) {
  constexpr int kRings = 4000, kSpokes = 64;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double rho = sqrt(sq(obscuration) + (1.0 - sq(obscuration)) * (i + 0.5) / kRings);
    for (int j = 0; j < kSpokes; ++j) {
      const double theta = 2.0 * std::numbers::pi * (j + 0.25) / kSpokes;
      sum += a(rho * c(theta), rho * s(theta)) * b(rho * c(theta), rho * s(theta));
    }
  }
  return sum / (kRings * kSpokes);
}

TEST(Zernike, IsOrthonormalOverCircleAndAnnulus) {
  for (const double obscuration : {0.0, 0.45}) {
    std::vector<Zernike> all;
    for (const int number : {1, 2, 4, 6, 8, 11, 12, 17, 22, 30, 37, 45}) {
      all.emplace_back(zernike_index(ZernikeOrdering::Noll, number), obscuration, Zernike::Normalisation::UnitRms);
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        // The midpoint rule of 4000 rings is good to 1e-5 for degree 8.
        EXPECT_NEAR(mean_product(all[i], all[j], obscuration), i == j ? 1.0 : 0.0, 2e-5) << i << " " << j;
      }
    }
  }
}

// Mahajan 1981, table 1.
TEST(Zernike, OfTheAnnulusFollowsMahajan) {
  const double e = 0.3, e2 = e * e, e4 = e2 * e2;
  const auto value = [&](int n, int m, double rho, double theta) {
    return Zernike({n, m}, e, Zernike::Normalisation::UnitRms)(rho * c(theta), rho * s(theta));
  };
  for (const double r : {0.3, 0.55, 1.0}) {
    const double t = 0.4, r2 = r * r;
    EXPECT_NEAR(value(1, 1, r, t), 2 * r / sqrt(1 + e2) * c(t), 1e-13);
    EXPECT_NEAR(value(2, 0, r, t), sqrt(3.0) * (2 * r2 - 1 - e2) / (1 - e2), 1e-13);
    EXPECT_NEAR(value(2, -2, r, t), sqrt(6.0) * r2 / sqrt(1 + e2 + e4) * s(2 * t), 1e-13);
    EXPECT_NEAR(value(3, 1, r, t),
                sqrt(8.0) * (3 * (1 + e2) * r2 * r - 2 * (1 + e2 + e4) * r) /
                    ((1 - e2) * sqrt((1 + e2) * (1 + 4 * e2 + e4))) * c(t),
                1e-12);
    EXPECT_NEAR(value(4, 0, r, t), sqrt(5.0) * (6 * r2 * r2 - 6 * (1 + e2) * r2 + 1 + 4 * e2 + e4) / sq(1 - e2), 1e-12);
  }
}

TEST(Zernike, NamesAreThoseOfInterferometry) {
  const auto name = [](int number) { return zernike_name(zernike_index(ZernikeOrdering::Fringe, number)); };
  EXPECT_EQ(name(1), "piston");
  EXPECT_EQ(name(3), "tilt y");
  EXPECT_EQ(name(4), "defocus");
  EXPECT_EQ(name(5), "astigmatism 0");
  EXPECT_EQ(name(6), "astigmatism 45");
  EXPECT_EQ(name(8), "coma y");
  EXPECT_EQ(name(9), "spherical");
  EXPECT_EQ(name(11), "trefoil 30");
  EXPECT_EQ(name(12), "secondary astigmatism 0");
  EXPECT_EQ(name(14), "secondary coma x");
  EXPECT_EQ(name(16), "(6, 0)");
}

TEST(Zernike, RefusesWhatIsNone) {
  EXPECT_THROW(Zernike({2, 1}, 0.0, Zernike::Normalisation::UnitRms), std::invalid_argument);
  EXPECT_THROW(Zernike({1, 3}, 0.0, Zernike::Normalisation::UnitRms), std::invalid_argument);
  EXPECT_THROW(Zernike({2, 0}, 1.0, Zernike::Normalisation::UnitRms), std::invalid_argument);
  EXPECT_THROW(Zernike({2, 0}, std::nan(""), Zernike::Normalisation::UnitRms), std::invalid_argument);
}

}  // namespace
}  // namespace dwell
