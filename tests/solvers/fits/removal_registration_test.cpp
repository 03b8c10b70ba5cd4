#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "solvers/fits/ceres_removal_registration.h"

namespace dwell {
namespace {

struct Dwelt {
  Point place;
  double seconds;
};

/// Dwell at points in no order, of a tool that is a Gaussian: what it removes is known at every place, for every width.
class RemovalOfPoints {
 public:
  explicit RemovalOfPoints(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int k = 0; k < 120; ++k)
      points_.push_back({{-14.0 + 28.0 * unit(random), -9.0 + 18.0 * unit(random)}, unit(random)});
  }

  double at(Point p, double width) const {
    const double sigma = 2.0 * width;
    double sum = 0.0;
    for (const Dwelt& d : points_) {
      const Point way = p - d.place;
      sum += d.seconds * std::exp(-0.5 * dot(way, way) / (sigma * sigma));
    }
    return 40.0 * sum / (width * width);
  }

  HeightMap map(const Grid& grid, double width) const {
    HeightMap map(grid);
    for (Index i = 0; i < grid.size(); ++i) map.values[static_cast<std::size_t>(i)] = at(grid.centre(i), width);
    return map;
  }

 private:
  std::vector<Dwelt> points_;
};

const Grid kMeasured{36, 61, 0.4, 0.35, {-12.0, -6.5}};  // rows, columns; not square, not about the origin
const Grid kPredicted{56, 81, 0.4, 0.35, {-16.0, -10.0}};

PredictedRemoval predicted_by(const RemovalOfPoints& removal) {
  PredictedRemoval predicted;
  for (const double width : {0.92, 1.0, 1.08}) {
    predicted.widths.push_back(width);
    predicted.removals.push_back(removal.map(kPredicted, width));
  }
  return predicted;
}

struct RemovalTruth {
  double rate = 1.0, width = 1.0, degrees = 0.0;
  Point shift;
};

HeightMap measured_by(const RemovalOfPoints& removal, const RemovalTruth& truth, double noise, std::mt19937& random) {
  HeightMap map(kMeasured);
  const Point about = middle_of(kMeasured);
  const double c = std::cos(truth.degrees * std::numbers::pi / 180.0),
               s = std::sin(truth.degrees * std::numbers::pi / 180.0);
  std::normal_distribution<double> error(0.0, 1.0);
  for (Index i = 0; i < kMeasured.size(); ++i) {
    const Point p = kMeasured.centre(i), d = p - about - truth.shift;
    const Point there = about + Point{c * d.x + s * d.y, c * d.y - s * d.x};
    map.values[static_cast<std::size_t>(i)] =
        truth.rate * removal.at(there, truth.width) + 3.0 + 0.2 * p.x - 0.1 * p.y + noise * error(random);
  }
  return map;
}

TEST(RemovalRegistration, FindsRateWidthShiftAndRotation) {
  const RemovalOfPoints removal(4);
  std::mt19937 random(1);
  const RemovalTruth truth{1.3, 1.06, 0.8, {0.37, -0.52}};
  HeightMap measured = measured_by(removal, truth, 0.0, random);
  measured.at(10, 20) += 400.0;  // a spike, and a hole
  measured.at(5, 50) = std::nan("");
  const RemovalRegistration found = register_removal(predicted_by(removal), measured, {});
  EXPECT_NEAR(found.rate.value, 1.3, 2e-3);
  EXPECT_NEAR(found.width.value, 1.06, 2e-3);
  EXPECT_NEAR(found.x.value, 0.37, 2e-3);
  EXPECT_NEAR(found.y.value, -0.52, 2e-3);
  EXPECT_NEAR(found.degrees.value, 0.8, 0.01);
  EXPECT_EQ(found.spikes, 1);
  EXPECT_GT(found.before.rms, 10.0);
  EXPECT_LT(found.after.rms, 0.2);
  const Point p{3.0, 4.0}, moved = found.transform(p);
  EXPECT_GT(moved.x, p.x);  // removal at +x of where it was wanted
  EXPECT_LT(moved.y, p.y);
}

TEST(RemovalRegistration, HoldsWhatIsNotFree) {
  const RemovalOfPoints removal(4);
  std::mt19937 random(1);
  const HeightMap measured = measured_by(removal, {1.3, 1.0, 0.0, {0.2, 0.1}}, 0.1, random);
  RemovalRegistrationOptions options;
  options.width = options.rotation = false;
  PredictedRemoval one{{1.0}, {removal.map(kPredicted, 1.0)}};
  const RemovalRegistration found = register_removal(one, measured, options);
  EXPECT_NEAR(found.rate.value, 1.3, 1e-3);
  EXPECT_NEAR(found.x.value, 0.2, 2e-3);
  EXPECT_EQ(found.width.value, 1.0);
  EXPECT_EQ(found.width.error, 0.0);
  EXPECT_EQ(found.degrees.error, 0.0);
}

/// Of so many runs, in how many the truth lies within three standard errors.
std::array<int, 5> covered(int runs, double correlated_mm, bool smooth) {
  const RemovalOfPoints removal(4);
  const PredictedRemoval predicted = predicted_by(removal);
  const RemovalTruth truth{1.1, 1.03, 0.4, {0.37, -0.25}};
  RemovalRegistrationOptions options;
  options.correlated_mm = correlated_mm;
  std::array<int, 5> within{};
  std::mt19937 random(7);
  for (int k = 0; k < runs; ++k) {
    HeightMap measured = measured_by(removal, truth, smooth ? 0.0 : 3.0, random);
    if (smooth) {  // errors that are alike over about 2 mm
      const RemovalOfPoints first(100 + static_cast<unsigned>(k)), second(1000 + static_cast<unsigned>(k));
      for (Index i = 0; i < kMeasured.size(); ++i) {
        const Point p = kMeasured.centre(i);
        measured.values[static_cast<std::size_t>(i)] += 0.05 * (first.at(p, 0.5) - second.at(p, 0.5));
      }
    }
    const RemovalRegistration f = register_removal(predicted, measured, options);
    const auto count = [](const Estimate& e, double value) {
      return std::abs(e.value - value) <= 3.0 * e.error ? 1 : 0;
    };
    within[0] += count(f.rate, truth.rate), within[1] += count(f.width, truth.width);
    within[2] += count(f.x, truth.shift.x), within[3] += count(f.y, truth.shift.y);
    within[4] += count(f.degrees, truth.degrees);
  }
  return within;
}

TEST(RemovalRegistration, StatesErrorsThatHold) {
  for (const int n : covered(40, 0.0, false)) EXPECT_GE(n, 38);
}

TEST(RemovalRegistration, StatesErrorsThatHoldWhereNeighboursErrAlike) {
  int independent = 0;
  for (const int n : covered(24, 0.0, true)) independent += n;
  for (const int n : covered(24, 4.0, true)) EXPECT_GE(n, 19);
  EXPECT_LT(independent, 5 * 19);  // which the plain errors are not
}

TEST(RemovalRegistration, RefusesWhatSaysNothing) {
  HeightMap flat(kMeasured), far(Grid{36, 61, 0.4, 0.35, {90.0, 90.0}});
  const RemovalOfPoints removal(4);
  PredictedRemoval nothing{{1.0}, {HeightMap(kPredicted)}};
  EXPECT_THROW(register_removal(nothing, flat, {}), InputError);
  EXPECT_THROW(register_removal(predicted_by(removal), far, {}), InputError);
}

}  // namespace
}  // namespace dwell
