#include "core/removal/removal_operator.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>

#include "core/removal/lattice_removal.h"
#include "core/removal/removal_once.h"
#include "core/removal/scattered_removal.h"
#include "core/removal/sparse_removal.h"
#include "core/removal/stacked_removal.h"
#include "tests/core/removal/direct_removal.h"

namespace dwell {
namespace {

enum class Kind { Lattice, Scattered, Sparse, Stacked };

/// A part with a hole and a ragged edge, unequal pitches, an origin off zero, and a removal function without any
/// symmetry.
struct Fixture {
  Grid map{11, 14, 0.5, 0.4, {-3.25, 7.1}};
  std::vector<Index> pixels;
  Eigen::MatrixXd samples{5, 7};
  RemovalKernel kernel;

  Fixture() {
    for (Index i = 0; i < map.size(); ++i) {
      const Index r = i / map.cols, c = i % map.cols;
      if (c < r / 3 || (r > 3 && r < 6 && c > 5 && c < 9)) continue;
      pixels.push_back(i);
    }
    Grid g{5, 7, map.pitch_x, map.pitch_y, {-3 * map.pitch_x, -2 * map.pitch_y}};
    HeightMap rates(g);
    for (Index r = 0; r < 5; ++r) {
      for (Index c = 0; c < 7; ++c) {
        samples(r, c) = std::exp(-0.3 * std::pow(static_cast<double>(c) - 2.4, 2) -
                                 0.4 * std::pow(static_cast<double>(r) - 2.7, 2)) +
                        0.05 * static_cast<double>(c) * static_cast<double>(r);
        rates.at(r, c) = samples(r, c);
      }
    }
    RemovalFunction tif = measured_removal(rates, {TifCentre::Kind::Middle, {}});
    kernel = removal_kernel(tif, map.pitch_x, map.pitch_y);
  }

  /// The definition of b: samples out to the radius, the larger half width, in both directions; zero beyond.
  oracle::DirectKernel direct() const {
    Eigen::MatrixXd square = Eigen::MatrixXd::Zero(9, 7);
    square.middleRows(2, 5) = samples;
    return {square, map.pitch_x, map.pitch_y};
  }

  Point at(double col, double row) const {
    return {map.origin.x + map.pitch_x * col, map.origin.y + map.pitch_y * row};
  }
};

/// Dwell points inside, at the edge, and outside the part, within and out of reach of it. Off the lattice by a common
/// fraction for the lattice operator, anywhere for the others.
ToolPath points_for(const Fixture& f, Kind kind, double offset) {
  ToolPath path;
  if (kind == Kind::Lattice) {
    for (int r = -6; r <= 16; r += 2) {
      for (int c = -7; c <= 20; c += 3) path.points.push_back(f.at(c + offset, r - 0.7 * offset));
    }
    path.points.push_back(path.points[60]);  // visited twice
    path.points.push_back(f.at(300 + offset, 5 - 0.7 * offset));
  } else {
    // Short steps: the oracle's Simpson rule needs them to reach 1e-12. Cut every fifth point, so far apart may be far.
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> u(-7.0, 20.0), v(-6.0, 17.0), step(-1.5, 1.5);
    double col = 0.0, row = 0.0;
    for (int k = 0; k < 40; ++k) {
      col = k % 5 == 0 ? u(random) : col + step(random);
      row = k % 5 == 0 ? v(random) : row + step(random);
      path.points.push_back(f.at(col, row));
    }
    path.points.push_back(f.at(4, 5));    // on a pixel
    path.points.push_back(f.at(4, 5.5));  // along a lattice line from there
    path.points.push_back(f.at(4, 7));
    path.points.push_back(f.at(5.25, 7));
    path.points.push_back(f.at(5.25, 7));  // repeated
    path.points.push_back(f.at(-400, 3));  // out of reach
    path.points.push_back(f.at(-400, 1.5));
    path.points.push_back(f.at(1e12, 3));
  }
  path.lifted.assign(path.points.size(), 0);
  for (std::size_t j = 0; j < path.size(); j += 5) path.lifted[j] = 1;
  path.lifted.back() = 1;
  return path;
}

std::vector<Stroke> strokes_for(const Fixture& f, Kind kind, bool moving, double offset) {
  const ToolPath path = points_for(f, kind, offset);
  if (!moving) return halting_strokes(path);
  if (kind != Kind::Lattice) return moving_strokes(path);
  std::vector<Stroke> strokes;  // every stroke the same bent shape
  for (Point p : path.points) strokes.push_back({p - Point{0.31, -0.12}, p, p + Point{0.55, 0.4}});
  return strokes;
}

std::unique_ptr<RemovalOperator> make(Kind kind, const Fixture& f, const std::vector<Stroke>& strokes, int threads) {
  switch (kind) {
    case Kind::Lattice:
      return std::make_unique<LatticeRemoval>(f.map, f.pixels, f.kernel, strokes, threads);
    case Kind::Scattered:
      return std::make_unique<ScatteredRemoval>(f.map, f.pixels, f.kernel, strokes, threads);
    case Kind::Sparse:
      return std::make_unique<SparseRemoval>(f.map, f.pixels, f.kernel, strokes, threads);
    case Kind::Stacked: {
      const auto cut = strokes.begin() + static_cast<std::ptrdiff_t>(strokes.size() / 3);
      std::vector<std::unique_ptr<RemovalOperator>> parts;
      parts.push_back(make(Kind::Scattered, f, {strokes.begin(), cut}, threads));
      parts.push_back(make(Kind::Sparse, f, {cut, strokes.end()}, threads));
      return std::make_unique<StackedRemoval>(std::move(parts));
    }
  }
  return nullptr;
}

Vector random_vector(Index n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Vector v(n);
  for (Index i = 0; i < n; ++i) v[i] = u(random);
  return v;
}

class EveryOperator : public testing::TestWithParam<std::tuple<Kind, bool, int, double>> {};

/// The oracle's matrix, which takes seconds and is the same for all operators on the same points.
const Eigen::MatrixXd& direct_matrix(bool lattice, bool moving, double offset, const Fixture& f,
                                     const std::vector<Stroke>& strokes) {
  static std::map<std::tuple<bool, bool, double>, Eigen::MatrixXd> known;
  const auto [at, is_new] = known.try_emplace({lattice, moving, offset});
  if (is_new) at->second = oracle::direct_matrix(f.map, f.pixels, f.direct(), strokes);
  return at->second;
}

TEST_P(EveryOperator, AgreesWithTheDirectDoubleLoopBothWays) {
  const auto [kind, moving, threads, offset] = GetParam();
  const Fixture f;
  const auto strokes = strokes_for(f, kind, moving, offset);
  const auto a = make(kind, f, strokes, threads);
  const Eigen::MatrixXd& expected = direct_matrix(kind == Kind::Lattice, moving, offset, f, strokes);
  ASSERT_GT(expected.norm(), 1.0);

  Vector actual(1), reversed(1);
  const Vector t = random_vector(a->cols(), 1), y = random_vector(a->rows(), 2);
  for (int call = 0; call < 2; ++call) {  // the second call must not see the first's leftovers
    a->apply(t, actual);
    a->apply_adjoint(y, reversed);
    EXPECT_LE((actual - expected * t).norm(), 1e-11 * (expected * t).norm());
    EXPECT_LE((reversed - expected.transpose() * y).norm(), 1e-11 * (expected.transpose() * y).norm());
  }
  EXPECT_EQ(a->applications(), 4);
}

// <Ax, y> = <x, A'y> up to rounding: each inner product sums m terms, so the error is measured against |Ax| |y|,
// which does not vanish when the inner product happens to.
TEST_P(EveryOperator, PassesTheAdjointTest) {
  const auto [kind, moving, threads, offset] = GetParam();
  const Fixture f;
  const auto a = make(kind, f, strokes_for(f, kind, moving, offset), threads);
  const Vector x = random_vector(a->cols(), 3), y = random_vector(a->rows(), 4);
  Vector ax, aty;
  a->apply(x, ax);
  a->apply_adjoint(y, aty);
  const double error =
      std::sqrt(static_cast<double>(a->rows())) * std::abs(ax.dot(y) - x.dot(aty)) / (ax.norm() * y.norm());
  EXPECT_LE(error, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Removal, EveryOperator,
                         testing::Combine(testing::Values(Kind::Lattice, Kind::Scattered, Kind::Sparse, Kind::Stacked),
                                          testing::Bool(), testing::Values(1, 2), testing::Values(0.0, 0.3)));

TEST(RemovalOperator, ABumpOfDwellAtPlusXRemovesAtPlusX) {
  Fixture f;
  for (const Kind kind : {Kind::Lattice, Kind::Scattered, Kind::Sparse}) {
    ToolPath path;
    path.points = {f.at(2, 2), f.at(11, 8)};
    path.lifted = {1, 1};
    const auto a = make(kind, f, halting_strokes(path), 1);
    Vector t(2), removal;
    t << 0.0, 1.0;
    a->apply(t, removal);
    Eigen::Index largest = 0;
    removal.maxCoeff(&largest);
    // The fixture's removal function peaks between samples (2, 2) and (3, 3) of 5 x 7 about (2, 3).
    const Index pixel = f.pixels[static_cast<std::size_t>(largest)];
    EXPECT_NEAR(static_cast<double>(pixel % f.map.cols), 10.5, 0.6);
    EXPECT_NEAR(static_cast<double>(pixel / f.map.cols), 8.5, 0.6);
  }
}

TEST(RemovalOnce, IsTheScatteredOperatorBitByBit) {
  const Fixture f;
  std::vector<Stroke> strokes;  // more than one run of strokes a thread
  for (int k = 0; k < 600; ++k) {
    const auto more = strokes_for(f, Kind::Scattered, true, 0.0);
    strokes.insert(strokes.end(), more.begin(), more.end());
  }
  const Vector t = random_vector(static_cast<Index>(strokes.size()), 3);
  for (const int threads : {1, 2, 3}) {
    Vector kept;
    ScatteredRemoval(f.map, f.pixels, f.kernel, strokes, threads).apply(t, kept);
    const Vector once = removal_once(f.map, f.pixels, f.kernel, strokes, t, threads);
    ASSERT_EQ(once.size(), kept.size());
    EXPECT_GT(once.norm(), 0.0);
    EXPECT_TRUE(once == kept) << threads;
  }
  EXPECT_THROW(removal_once(f.map, f.pixels, f.kernel, strokes, t.head(5), 1), std::invalid_argument);
}

/// So many strokes on so few nodes are scattered block by block instead of gathered node by node.
TEST(ScatteredRemoval, OfTheSameStrokesManyTimesIsThatOfTheirSums) {
  const Fixture f;
  const auto once = strokes_for(f, Kind::Scattered, true, 0.0);
  const auto n = static_cast<Index>(once.size());
  constexpr Index kTimes = 600;
  std::vector<Stroke> strokes;
  for (Index k = 0; k < kTimes; ++k) strokes.insert(strokes.end(), once.begin(), once.end());
  const Vector t = random_vector(n * kTimes, 3);
  Vector sums = Vector::Zero(n);
  for (Index k = 0; k < kTimes; ++k) sums += t.segment(k * n, n);
  ScatteredRemoval few(f.map, f.pixels, f.kernel, once, 1);
  Vector expected, expected_adjoint;
  few.apply(sums, expected);
  few.apply_adjoint(expected, expected_adjoint);
  for (const int threads : {1, 2}) {
    ScatteredRemoval many(f.map, f.pixels, f.kernel, strokes, threads);
    Vector removal, adjoint;
    many.apply(t, removal);
    EXPECT_LE((removal - expected).norm(), 1e-12 * expected.norm());
    many.apply(t, removal);  // once more: nothing of the first is left in the fields
    EXPECT_LE((removal - expected).norm(), 1e-12 * expected.norm());
    many.apply_adjoint(expected, adjoint);
    for (Index k = 0; k < kTimes; k += 37)
      EXPECT_LE((adjoint.segment(k * n, n) - expected_adjoint).norm(), 1e-12 * expected_adjoint.norm());
  }
}

TEST(RemovalOperator, RefusesWrongSizes) {
  const Fixture f;
  const auto a = make(Kind::Scattered, f, strokes_for(f, Kind::Scattered, false, 0.0), 1);
  Vector out;
  EXPECT_THROW(a->apply(Vector::Zero(a->cols() + 1), out), std::invalid_argument);
  EXPECT_THROW(a->apply_adjoint(Vector::Zero(a->rows() - 1), out), std::invalid_argument);
}

TEST(StackedRemoval, WantsPartsOnTheSamePixels) {
  const Fixture f;
  Fixture other;
  other.pixels.pop_back();
  EXPECT_THROW(StackedRemoval({}), std::invalid_argument);
  std::vector<std::unique_ptr<RemovalOperator>> parts;
  parts.push_back(make(Kind::Sparse, f, strokes_for(f, Kind::Sparse, false, 0.0), 1));
  parts.push_back(make(Kind::Sparse, other, strokes_for(f, Kind::Sparse, false, 0.0), 1));
  EXPECT_THROW(StackedRemoval(std::move(parts)), std::invalid_argument);
}

TEST(LatticeRemoval, RefusesPointsOffTheLattice) {
  const Fixture f;
  ToolPath path;
  path.points = {f.at(2, 2), f.at(3.001, 2)};
  path.lifted = {1, 1};
  EXPECT_THROW(make(Kind::Lattice, f, halting_strokes(path), 1), std::invalid_argument);
}

TEST(SparseRemoval, TakesARemovalFunctionForEachStroke) {
  const Fixture f;
  RemovalKernel twice = f.kernel;
  Grid g{9, 7, f.map.pitch_x, f.map.pitch_y, {-3 * f.map.pitch_x, -4 * f.map.pitch_y}};
  std::vector<double> doubled(63, 0.0);
  for (Index i = 0; i < 35; ++i) doubled[static_cast<std::size_t>(i + 14)] = 2.0 * f.samples(i / 7, i % 7);
  twice.surface = SplineSurface(g, doubled);
  const auto strokes = strokes_for(f, Kind::Sparse, true, 0.0);
  SparseRemoval a(
      f.map, f.pixels, [&](std::size_t j) -> const RemovalKernel& { return j % 2 ? twice : f.kernel; }, strokes, 2);
  const oracle::DirectKernel direct = f.direct();
  Eigen::MatrixXd expected = oracle::direct_matrix(f.map, f.pixels, direct, strokes);
  for (Eigen::Index j = 1; j < expected.cols(); j += 2) expected.col(j) *= 2.0;
  const Vector t = random_vector(a.cols(), 5);
  Vector actual;
  a.apply(t, actual);
  EXPECT_LE((actual - expected * t).norm(), 1e-11 * (expected * t).norm());
}

}  // namespace
}  // namespace dwell
