#include "core/numerics/point_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;

std::vector<PointPair> moved(const std::vector<Point>& points, const PlaneTransform& by) {
  std::vector<PointPair> pairs;
  for (const Point p : points) pairs.push_back({p, by(p)});
  return pairs;
}

const std::vector<Point> kMarks{{-10.0, 2.0}, {14.0, 3.5}, {5.0, -7.0}, {0.5, 20.0}};

TEST(FitPoints, RecoversWhatMovedThem) {
  const PlaneTransform rigid = similarity({3.0, 1.0}, {5.0, -6.0}, 155.0, 1.0);
  const PlaneTransform similar = similarity({3.0, 1.0}, {5.0, -6.0}, -35.0, 1.07);
  const PlaneTransform affine{1.1, 0.2, -0.3, 0.7, {4.0, 5.0}}, mirror{-1.0, 0.1, 0.0, 1.0, {}};
  const PlaneTransform shift{1, 0, 0, 1, {2.0, -1.5}};
  for (const auto& [kind, transform] : {std::pair{PointFitKind::Shift, shift},
                                        {PointFitKind::Rigid, rigid},
                                        {PointFitKind::Similarity, similar},
                                        {PointFitKind::Affine, affine},
                                        {PointFitKind::Affine, mirror}}) {
    const PointFit fit = fit_points(moved(kMarks, transform), kind);
    EXPECT_LE(fit.rms, 1e-12);
    for (const Point p : {Point{100.0, -50.0}, Point{}}) EXPECT_LE(distance(fit.transform(p), transform(p)), 1e-11);
  }
}

/// Sum of squared distances for a rotation and scale, with the best shift, by definition.
double squares(const std::vector<PointPair>& pairs, double degrees, double scale) {
  const double a = degrees * std::numbers::pi / 180.0;
  std::vector<Point> apart;
  Point mean;
  for (const PointPair& p : pairs) {
    apart.push_back(p.to - scale * Point{std::cos(a) * p.from.x - std::sin(a) * p.from.y,
                                         std::sin(a) * p.from.x + std::cos(a) * p.from.y});
    mean = mean + (1.0 / static_cast<double>(pairs.size())) * apart.back();
  }
  double sum = 0.0;
  for (const Point p : apart) sum += std::pow(distance(p, mean), 2);
  return sum;
}

TEST(FitPoints, NoOtherRotationOrScaleIsNearer) {
  std::vector<PointPair> pairs = moved(kMarks, similarity({}, {1.0, 2.0}, 20.0, 1.02));
  pairs[0].to = pairs[0].to + Point{0.3, -0.2};
  pairs[2].to = pairs[2].to + Point{-0.1, 0.4};
  for (const PointFitKind kind : {PointFitKind::Rigid, PointFitKind::Similarity}) {
    const PointFit fit = fit_points(pairs, kind);
    double sum = 0.0;
    ASSERT_EQ(fit.residuals.size(), pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_LE(distance(fit.residuals[i], pairs[i].to - fit.transform(pairs[i].from)), 1e-14);
      sum += std::pow(length(fit.residuals[i]), 2);
    }
    EXPECT_NEAR(fit.rms, std::sqrt(sum / 4.0), 1e-14);
    EXPECT_GT(fit.rms, 0.1);
    const double degrees = std::atan2(fit.transform.yx, fit.transform.xx) * 180.0 / std::numbers::pi;
    const double scale = std::hypot(fit.transform.yx, fit.transform.xx);
    EXPECT_NEAR(squares(pairs, degrees, scale), sum, 1e-10);
    if (kind == PointFitKind::Rigid) {
      EXPECT_NEAR(scale, 1.0, 1e-14);
    }
    for (const double turn : {-0.01, 0.01}) EXPECT_GT(squares(pairs, degrees + turn, scale), sum);
    for (const double grow : {-1e-4, 1e-4}) {
      if (kind == PointFitKind::Similarity) {
        EXPECT_GT(squares(pairs, degrees, scale + grow), sum);
      }
    }
  }
}

TEST(FitPoints, RefusesWhatLeavesTheTransformOpen) {
  const auto refused = [](std::vector<PointPair> pairs, PointFitKind kind, std::initializer_list<std::string> words) {
    expect_input_error([&] { fit_points(pairs, kind); }, words);
  };
  refused({}, PointFitKind::Shift, {"0 pairs", "at least 1"});
  refused({{{1, 2}, {3, 4}}}, PointFitKind::Rigid, {"1 pairs", "at least 2"});
  refused({{{1, 2}, {3, 4}}, {{1, 2}, {5, 4}}}, PointFitKind::Rigid, {"coincide"});
  refused({{{1, 2}, {3, 4}}, {{2, 2}, {5, 4}}}, PointFitKind::Affine, {"2 pairs", "at least 3"});
  refused({{{1, 1}, {3, 4}}, {{2, 2}, {5, 4}}, {{3, 3}, {1, 1}}}, PointFitKind::Affine, {"one line"});
  refused({{{1, NAN}, {3, 4}}}, PointFitKind::Shift, {"finite"});
  expect_input_error([] { parse_point_fit_kind("free"); }, {"'free'", "shift, rigid, similarity or affine"});
}

}  // namespace
}  // namespace dwell
