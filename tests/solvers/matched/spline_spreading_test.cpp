#include "solvers/matched/spline_spreading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "solvers/matched/two_scale.h"

namespace dwell {
namespace {

/// B3 at any u, from its definition.
double spline_b3(double u) {
  u = std::abs(u);
  if (u < 1.0) return (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0;
  return u < 2.0 ? std::pow(2.0 - u, 3) / 6.0 : 0.0;
}

Vector uniform_noise(Index n, unsigned seed) {
  std::mt19937 random(seed);
  return Vector::NullaryExpr(
      n, [&] { return 2.0 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1.0; });
}

const Grid kMap{40, 60, 0.5, 0.25, {3.0, -7.0}};
const CoarseFactor kFactor{8, 6};

RemovalGeometry geometry_of(std::vector<Stroke> strokes) {
  RemovalGeometry g;
  g.lattice = kMap;
  g.kernel.half_rows = 9;
  g.kernel.half_cols = 5;
  g.strokes = std::move(strokes);
  return g;
}

/// Anywhere on the map and a little beyond it.
ToolPath scattered(Index n, unsigned seed) {
  const Vector x = uniform_noise(n, seed), y = uniform_noise(n, seed + 1);
  ToolPath path;
  for (Index j = 0; j < n; ++j) path.points.push_back({18.0 + 17.0 * x[j], -2.0 + 6.0 * y[j]});
  path.lifted.assign(path.points.size(), 0);
  return path;
}

/// The weight of a point on a node, by definition.
double weight(const Grid& lattice, Index node, Point p) {
  const Point d = p - lattice.centre(node);
  return spline_b3(d.x / lattice.pitch_x) * spline_b3(d.y / lattice.pitch_y);
}

TEST(SplineSpreading, GathersWhatTheBSplinesSay) {
  const auto strokes = halting_strokes(scattered(200, 1));
  SplineSpreading spreading(dwell_lattice(geometry_of(strokes), kFactor).lattice, strokes, StrokePart::Whole, 1);
  const Vector nodes = uniform_noise(spreading.lattice().size(), 3);
  Vector t;
  spreading.gather(nodes, t);
  for (Index j = 0; j < t.size(); ++j) {
    double expected = 0.0;
    for (Index k = 0; k < nodes.size(); ++k)
      expected += nodes[k] * weight(spreading.lattice(), k, strokes[static_cast<std::size_t>(j)].via);
    EXPECT_NEAR(t[j], expected, 1e-3);  // positions to 1/2048 of the pitch, slopes below 2
  }
}

TEST(SplineSpreading, TakesTheMeanAlongAStroke) {
  ToolPath path;
  path.points = {{5.0, -6.0}, {9.0, -5.0}, {13.0, -6.5}, {12.0, 0.0}};
  path.lifted.assign(4, 0);
  const auto strokes = moving_strokes(path);
  SplineSpreading whole(dwell_lattice(geometry_of(strokes), kFactor).lattice, strokes, StrokePart::Whole, 1);
  const Vector nodes = uniform_noise(whole.lattice().size(), 4);
  Vector t;
  whole.gather(nodes, t);
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    const Stroke& s = strokes[j];
    const double first = distance(s.start, s.via), length = s.length();
    double expected = 0.0;
    constexpr int kSteps = 4000;
    for (int k = 0; k < kSteps; ++k) {
      const double at = length * (k + 0.5) / kSteps;
      const Point p = at < first ? s.start + (at / first) * (s.via - s.start)
                                 : s.via + ((at - first) / (length - first)) * (s.finish - s.via);
      for (Index i = 0; i < nodes.size(); ++i) expected += nodes[i] * weight(whole.lattice(), i, p) / kSteps;
    }
    EXPECT_NEAR(t[static_cast<Index>(j)], expected, 5e-3);
  }
}

TEST(SplineSpreading, SpreadsTheTransposeOnAnyNumberOfThreads) {
  const auto strokes = halting_strokes(scattered(30'000, 5));
  const Grid lattice = dwell_lattice(geometry_of(strokes), kFactor).lattice;
  const Vector t = uniform_noise(30'000, 6), nodes = uniform_noise(lattice.size(), 7);
  Vector one;
  for (int threads : {1, 2, 3}) {
    SplineSpreading spreading(lattice, strokes, StrokePart::Via, threads);
    Vector spread, again, gathered;
    spreading.spread(t, spread);
    spreading.spread(t, again);
    spreading.gather(nodes, gathered);
    EXPECT_TRUE(spread == again) << threads;
    EXPECT_NEAR(spread.dot(nodes), t.dot(gathered), 1e-10 * t.norm() * gathered.norm()) << threads;
    if (threads == 1) one = spread;
    EXPECT_LE((spread - one).norm(), 1e-13 * one.norm()) << threads;
  }
}

/// One point a kilometre away must not make a lattice of a kilometre; it stands where no pixel feels it.
TEST(SplineSpreading, MovesWhatIsFarOffToTheEdge) {
  ToolPath path = scattered(20, 8);
  path.points.push_back({1e6, -1e6});
  path.lifted.push_back(1);
  const auto strokes = halting_strokes(path);
  const DwellLattice at = dwell_lattice(geometry_of(strokes), kFactor);
  EXPECT_LE(at.lattice.size(), 400);
  SplineSpreading spreading(at.lattice, strokes, StrokePart::Whole, 1);
  Vector t = Vector::Zero(21), nodes;
  t[20] = 1.0;
  spreading.spread(t, nodes);
  EXPECT_NEAR(nodes.sum(), 1.0, 1e-6);
  for (Index k = 0; k < nodes.size(); ++k) {
    if (nodes[k] == 0.0) continue;
    const Point p = at.lattice.centre(k);
    EXPECT_TRUE(p.x > kMap.centre(0, kMap.cols + 5).x || p.y < kMap.centre(-9, 0).y);
  }
}

/// The lattice's lines are the map's, and points on its first and last lines are taken.
TEST(DwellLattice, HoldsEveryStroke) {
  ToolPath path;
  path.points = {kMap.centre(0, 0), kMap.centre(36, 56), kMap.centre(-6, 8), {3.9999999, -6.5}};
  path.lifted.assign(4, 0);
  const auto strokes = halting_strokes(path);
  const DwellLattice at = dwell_lattice(geometry_of(strokes), kFactor);
  SplineSpreading spreading(at.lattice, strokes, StrokePart::Via, 1);
  Vector ones;
  spreading.gather(Vector::Ones(at.lattice.size()), ones);
  EXPECT_LE((ones.array() - 1.0).abs().maxCoeff(), 1e-6);
  EXPECT_NEAR(at.lattice.origin.x, kMap.centre(0, at.first_col * kFactor.x).x, 1e-12);
  EXPECT_NEAR(at.lattice.origin.y, kMap.centre(at.first_row * kFactor.y, 0).y, 1e-12);
}

/// B-splines on every second line, written as sums of those on every line.
TEST(TwoScale, SaysOnTheCoarseLatticeWhatTheFineOneHolds) {
  const auto strokes = halting_strokes(scattered(300, 9));
  for (const CoarseFactor fine : {CoarseFactor{4, 3}, CoarseFactor{3, 5}}) {
    SplineSpreading spreading(dwell_lattice(geometry_of(strokes), fine).lattice, strokes, StrokePart::Via, 1);
    const Vector t = uniform_noise(300, 10);
    Vector on_fine, on_coarse, back;
    spreading.spread(t, on_fine);
    TwoScale relation(spreading.lattice(), kMap.origin);
    relation.restrict_to(on_fine, on_coarse);
    for (Index k = 0; k < on_coarse.size(); ++k) {
      double expected = 0.0;
      for (Index j = 0; j < t.size(); ++j)
        expected += t[j] * weight(relation.coarse(), k, strokes[static_cast<std::size_t>(j)].via);
      EXPECT_NEAR(on_coarse[k], expected, 2e-3);
    }
    const Vector g = uniform_noise(on_coarse.size(), 11);
    relation.prolong(g, back);
    EXPECT_NEAR(back.dot(on_fine), g.dot(on_coarse), 1e-12 * back.norm() * on_fine.norm());
  }
}

}  // namespace
}  // namespace dwell
