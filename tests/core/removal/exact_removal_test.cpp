#include "core/removal/exact_removal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/removal/removal_once.h"
#include "core/removal/stroke_average.h"
#include "tests/core/removal/direct_removal.h"
#include "tests/core/removal/disc_oracle.h"

namespace dwell {
namespace {

constexpr double kSlope = 0.8, kRadius = 3.0, kSpeed = 2.5;
const oracle::Disc kDisc{kRadius, kSlope / kSpeed};

/// Each moving stroke takes its length over the speed.
Vector constant_speed(const std::vector<Stroke>& strokes) {
  Vector t(static_cast<Index>(strokes.size()));
  for (Index j = 0; j < t.size(); ++j) t[j] = strokes[static_cast<std::size_t>(j)].length() / kSpeed;
  return t;
}

std::vector<Index> every_third_left_out(const Grid& map) {
  std::vector<Index> pixels;
  for (Index i = 0; i < map.size(); ++i) {
    if (i % 3 != 1) pixels.push_back(i);
  }
  return pixels;
}

std::vector<Stroke> strokes_between(const std::vector<Point>& nodes) {
  std::vector<Stroke> strokes;
  for (std::size_t k = 1; k < nodes.size(); ++k) {
    strokes.push_back({nodes[k - 1], midpoint(nodes[k - 1], nodes[k]), nodes[k]});
  }
  return strokes;
}

/// Whether the rim at p touches the line of a stroke. There the removal rises from the rim like a square root, and the
/// last bit of the distance is worth 1e-8 of it.
bool touches_rim(const std::vector<Stroke>& strokes, Point p) {
  return std::any_of(strokes.begin(), strokes.end(), [&](const Stroke& s) {
    const Point along = s.finish - s.start, a = p - s.start;
    return std::abs(std::abs(a.x * along.y - a.y * along.x) / length(along) - kRadius) < 1e-9;
  });
}

/// Holds both ways to apply the operator against a closed form at every pixel, relative to the peak of the latter.
template <typename Truth>
void expect_removal(const Grid& map, const std::vector<Stroke>& strokes, const Truth& truth, double tolerance) {
  const std::vector<Index> pixels = every_third_left_out(map);
  const RemovalFunction tif = spinning_disc_removal(kSlope, kRadius);
  const Vector t = constant_speed(strokes);
  Vector removal;
  SparseRemoval a = exact_removal(map, pixels, tif, strokes, 2);
  a.apply(t, removal);
  const Vector once = exact_removal_once(map, pixels, tif, strokes, t, 2);
  ASSERT_EQ(removal.size(), static_cast<Index>(pixels.size()));
  double peak = 0.0;
  for (const Index i : pixels) peak = std::max(peak, truth(map.centre(i)));
  ASSERT_GT(peak, kDisc.line(0.0));
  for (Index i = 0; i < removal.size(); ++i) {
    const Point p = map.centre(pixels[static_cast<std::size_t>(i)]);
    const double allowed = touches_rim(strokes, p) ? std::max(tolerance, 1e-7) : tolerance;
    EXPECT_NEAR(removal[i], truth(p), allowed * peak) << p.x << " " << p.y;
    EXPECT_NEAR(once[i], removal[i], 1e-13 * peak);
  }
}

TEST(DiscOracle, IsWhatQuadratureGives) {
  const auto rate_sum = [](double across, double low, double high) {
    const double half = std::sqrt(kRadius * kRadius - across * across);
    low = std::max(low, -half);
    high = std::min(high, half);
    if (!(low < high)) return 0.0;
    return kDisc.intensity *
           oracle::integrate([&](double u) { return std::sqrt(u * u + across * across); }, low, high, 1e-13);
  };
  for (const double y : {-2.9999, -1.3, 0.0, 1e-7, 0.4, 2.2}) {
    EXPECT_NEAR(kDisc.line(y), rate_sum(y, -10.0, 10.0), 1e-11) << y;
    for (const auto& [from, to] : {std::pair{-9.0, 0.5}, {0.2, 0.9}, {2.5, -0.5}, {-0.3, -8.0}, {3.5, 7.0}}) {
      EXPECT_NEAR(kDisc.segment(1.1, y, 1.1 + from, 1.1 + to), rate_sum(y, std::min(from, to), std::max(from, to)),
                  1e-11)
          << y << " " << from << " " << to;
    }
  }
  EXPECT_EQ(kDisc.line(kRadius), 0.0);
  EXPECT_EQ(kDisc.segment(0.0, 3.5, -1.0, 1.0), 0.0);
}

// Equation 25 as it is printed, where its logarithm does not cancel.
TEST(DiscOracle, HasThePrintedAntiderivativeUpToAConstant) {
  const auto printed = [](double x, double y) {
    const double r = std::sqrt(x * x + y * y);
    return 0.5 * (x * r + y * y * std::log(x + r));
  };
  for (const double y : {0.3, -1.7}) {
    EXPECT_NEAR(printed(2.1, y) - printed(0.4, y),
                oracle::Disc::antiderivative(2.1, y) - oracle::Disc::antiderivative(0.4, y), 1e-13);
    EXPECT_NEAR(printed(2.1, y) - printed(-0.4, y),
                oracle::Disc::antiderivative(2.1, y) - oracle::Disc::antiderivative(-0.4, y), 1e-13);
  }
}

TEST(DiscOracle, SpiralIsTheLimitOfTheSumOfEquation18) {
  const oracle::Spiral spiral{1.3, 25.0};
  const double length = spiral.arc(spiral.last);
  for (const double s : {0.0, 1e-6, 0.7, 30.0}) EXPECT_NEAR(spiral.arc(spiral.theta_at(s)), s, 1e-12 * length);
  constexpr int kSteps = 1000000;
  for (const Point p : {Point{0.3, -0.2}, Point{-3.1, 1.7}, Point{5.0, 4.4}}) {
    double sum = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      const double r = distance(spiral.at(spiral.theta_at(length * (k + 0.5) / kSteps)), p);
      if (r <= kRadius) sum += r;
    }
    // A step off at each of about twenty crossings of the rim.
    const double truth = spiral.removal(kDisc, p);
    ASSERT_GT(truth, 0.1);
    EXPECT_NEAR(kDisc.intensity * sum * length / kSteps, truth, kDisc.intensity * kRadius * 20 * length / kSteps);
  }
}

TEST(ExactRemoval, IsTheClosedFormOfALine) {
  // Pixels on the line, on both rims (y = -3 and 3), within and beyond, at unequal pitches off the origin.
  const Grid map{15, 4, 0.7, 0.5, {-1.3, -3.5}};
  const auto strokes = strokes_between({{-9.0, 0.0}, {-1.2, 0.0}, {0.37, 0.0}, {0.38, 0.0}, {11.0, 0.0}});
  expect_removal(
      map, strokes, [](Point p) { return kDisc.line(p.y); }, 1e-12);
}

TEST(ExactRemoval, IsTheClosedFormOfScanLines) {
  const Grid map{13, 5, 0.31, 0.77, {4.1, -3.3}};
  std::vector<Stroke> strokes;
  for (int k = 0; k < 9; ++k) {
    const double y = -5.0 + 1.3 * k;
    const auto line = strokes_between({{-4.0, y}, {5.02, y}, {14.0, y}});
    strokes.insert(strokes.end(), line.begin(), line.end());
  }
  expect_removal(
      map, strokes, [](Point p) { return kDisc.lines(p.y, -5.0, 1.3, 9); }, 1e-12);
}

TEST(ExactRemoval, IsTheClosedFormOfAHilbertCurve) {
  const Point origin{-2.3, 0.9};
  const std::vector<Point> nodes = oracle::hilbert_nodes(4, 0.8, origin);
  ASSERT_EQ(nodes.size(), 256u);
  // Pixels on the curve, on the rim of the disc at its first node, outside its square, and anywhere.
  const Grid map{9, 11, 1.5, 2.0, {origin.x - kRadius, origin.y - 4.0}};
  const auto truth = [&](Point p) { return kDisc.polyline(p, nodes); };
  expect_removal(map, strokes_between(nodes), truth, 1e-12);
  // Dwell points at the nodes, as a planner gives them: the strokes turn where the curve turns, and go on by half a
  // step at its ends.
  ToolPath path{"hilbert", nodes, std::vector<char>(nodes.size(), 0)};
  path.lifted[0] = 1;
  std::vector<Point> extended = nodes;
  extended.insert(extended.begin(), nodes[0] - 0.5 * (nodes[1] - nodes[0]));
  extended.push_back(nodes[255] + 0.5 * (nodes[255] - nodes[254]));
  expect_removal(
      map, moving_strokes(path), [&](Point p) { return kDisc.polyline(p, extended); }, 1e-12);
}

// A polyline through points of the spiral, 2 um apart: its chords are within 1e-6 mm of the arc but at the very centre.
TEST(ExactRemoval, IsTheQuadratureOfASpiral) {
  const oracle::Spiral spiral{1.3, 43.0};
  const double length = spiral.arc(spiral.last);
  const auto count = static_cast<Index>(std::ceil(length / 2e-3));
  std::vector<Point> nodes;
  for (Index k = 0; k <= count; ++k) {
    nodes.push_back(spiral.at(spiral.theta_at(length * static_cast<double>(k) / static_cast<double>(count))));
  }
  const Grid map{5, 6, 2.3, 3.1, {-5.7, -7.4}};
  expect_removal(
      map, strokes_between(nodes), [&](Point p) { return spiral.removal(kDisc, p); }, 1e-6);
}

TEST(ExactRemoval, RemovesAtPlusXForATimeAtPlusX) {
  const Grid map{7, 9, 1.0, 1.5, {-4.0, -4.5}};
  std::vector<Index> pixels;
  for (Index i = 0; i < map.size(); ++i) pixels.push_back(i);
  const std::vector<Stroke> strokes{{{-3, -3}, {-3, -3}, {-3, -3}}, {{3, 1.5}, {3, 1.5}, {3, 1.5}}};
  Vector t(2);
  t << 0.0, 2.0;
  const Vector removal = exact_removal_once(map, pixels, gaussian_removal(5.0, 2.0, 3.0), strokes, t, 1);
  Eigen::Index largest = 0;
  EXPECT_DOUBLE_EQ(removal.maxCoeff(&largest), 10.0);
  EXPECT_EQ(map.centre(largest), (Point{3.0, 1.5}));
  EXPECT_THROW(exact_removal_once(map, pixels, gaussian_removal(5.0, 2.0, 3.0), strokes, Vector::Zero(3), 1),
               std::invalid_argument);
}

/// Any straight stroke, in any direction, bent or not, by quadrature between the crossings of the cut-off circle, which
/// are found by bisection.
double slow_average(const std::function<double(double)>& rate, double radius, const Stroke& s, Point p) {
  const auto piece = [&](Point a, Point b) {
    const auto r = [&](double f) { return distance(a + f * (b - a), p); };
    std::vector<double> cuts{0.0};
    constexpr int kSteps = 5000;
    for (int k = 0; k < kSteps; ++k) {
      double low = static_cast<double>(k) / kSteps, high = static_cast<double>(k + 1) / kSteps;
      if ((r(low) > radius) == (r(high) > radius)) continue;
      const bool outside = r(low) > radius;
      for (int n = 0; n < 60; ++n) {
        const double middle = 0.5 * (low + high);
        ((r(middle) > radius) == outside ? low : high) = middle;
      }
      cuts.push_back(low);
    }
    cuts.push_back(1.0);
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      if (r(0.5 * (cuts[k] + cuts[k + 1])) > radius) continue;
      sum += oracle::integrate([&](double f) { return rate(r(f)); }, cuts[k], cuts[k + 1], 1e-13);
    }
    return sum * distance(a, b);
  };
  return (piece(s.start, s.via) + piece(s.via, s.finish)) / s.length();
}

TEST(StrokeAverage, IsTheQuadratureOfAnyBentStroke) {
  const RemovalFunction disc = spinning_disc_removal(kSlope, kRadius), gauss = gaussian_removal(2.0, 2.2, 2.7);
  const StrokeAverage of_disc(disc), of_gauss(gauss);
  std::mt19937_64 random(11);
  const auto uniform = [&](double width) {
    return width * (static_cast<double>(random() >> 11) * 0x1p-52 - 1.0);  // -width .. width
  };
  double largest = 0.0;
  for (int k = 0; k < 60; ++k) {
    const double size = std::pow(10.0, uniform(2.0) - 1.0);  // strokes from a thousandth of a mm to a cm
    const Point via{uniform(3.0), uniform(3.0)}, p{uniform(3.0), uniform(3.0)};
    const Stroke s{via + Point{uniform(size), uniform(size)}, via, via + Point{uniform(size), uniform(size)}};
    const double d = slow_average([](double r) { return kSlope * r; }, kRadius, s, p);
    const double g =
        slow_average([&](double r) { return 2.0 * std::exp(-0.5 * r * r / (gauss.sigma * gauss.sigma)); }, 2.7, s, p);
    EXPECT_NEAR(of_disc(s, p), d, 1e-11) << k;
    EXPECT_NEAR(of_gauss(s, p), g, 1e-11) << k;
    largest = std::max({largest, d, g});
  }
  EXPECT_GT(largest, 1.0);
}

TEST(StrokeAverage, OfAVeryShortStrokeIsTheRate) {
  const StrokeAverage of_disc(spinning_disc_removal(kSlope, kRadius)), of_gauss(gaussian_removal(2.0, 2.2, 2.7));
  const double sigma = gaussian_removal(2.0, 2.2, 2.7).sigma;
  const Point tool{0.4, -0.9};
  for (const double size : {1e-4, 1e-8, 1e-12}) {
    const Stroke s{tool - Point{size, 0.5 * size}, tool, tool + Point{size, 0.5 * size}};
    for (const Point p : {Point{1.7, 0.2}, Point{0.4, 1.3}, Point{-1.1, -1.65}}) {
      const double r = distance(p, tool);
      EXPECT_NEAR(of_disc(s, p), kSlope * r, 1e-13 + size * size) << size;
      EXPECT_NEAR(of_gauss(s, p), 2.0 * std::exp(-0.5 * r * r / (sigma * sigma)), 1e-13 + size * size) << size;
    }
    EXPECT_NEAR(of_disc(s, tool), kSlope * 0.5 * size * std::sqrt(1.25), 1e-15);  // on the stroke itself
  }
}

TEST(StrokeAverage, OfSamplesIsTheirSplineAveraged) {
  Grid g{5, 7, 0.5, 0.4, {-3 * 0.5, -2 * 0.4}};
  HeightMap rates(g);
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(5, 7);
  for (Index r = 0; r < 5; ++r) {
    for (Index c = 0; c < 7; ++c) {
      square(r, c) = rates.at(r, c) = 1.0 + 0.3 * static_cast<double>(c) - 0.2 * static_cast<double>(r * c % 4);
    }
  }
  const oracle::DirectKernel direct(square, 0.5, 0.4);
  const StrokeAverage average(measured_removal(rates, {TifCentre::Kind::Middle, {}}));
  const Stroke bent{{0.1, -0.3}, {0.9, 0.4}, {1.3, -0.2}}, halt{{0.2, 0.1}, {0.2, 0.1}, {0.2, 0.1}};
  for (const Point p : {Point{0.3, 0.2}, Point{-0.9, -0.7}, Point{2.4, 1.1}}) {
    EXPECT_NEAR(average(bent, p), direct.average(p.x, p.y, bent), 1e-9);
    EXPECT_NEAR(average(halt, p), direct.rate(p.x - 0.2, p.y - 0.1), 1e-12);
  }
  // A map's pixel at the very edge of the spline's reach is not forgotten by the box.
  EXPECT_EQ(average(halt, halt.via + average.high() + Point{1e-9, 0.0}), 0.0);
  EXPECT_LT(average.high().x, 0.5 * (3 + 4 + 2) + 1e-9);
}

/// Error of the fast operator on a Hilbert curve of cells of 0.43 R, over what a part would see: RMS and largest
/// difference from the closed form relative to the mean removal.
struct FastError {
  double rms = 0.0, largest = 0.0;
};

FastError fast_error(const RemovalFunction& tif, int pixels_per_radius) {
  const std::vector<Point> nodes = oracle::hilbert_nodes(4, 0.43 * kRadius, {-9.4, -9.9});
  const std::vector<Stroke> strokes = strokes_between(nodes);
  const double pitch = kRadius / pixels_per_radius;
  const auto cols = static_cast<Index>(std::lround(6.0 / pitch)), rows = static_cast<Index>(std::lround(5.0 / pitch));
  const Grid map{rows, cols, pitch, pitch, {-2.93, -1.71}};
  std::vector<Index> pixels;
  for (Index i = 0; i < map.size(); ++i) pixels.push_back(i);
  const Vector t = constant_speed(strokes);
  const Vector fast = removal_once(map, pixels, removal_kernel(tif, pitch, pitch), strokes, t, 2);
  const Vector exact = exact_removal_once(map, pixels, tif, strokes, t, 2);
  const Vector error = (fast - exact) / exact.mean();
  return {error.norm() / std::sqrt(static_cast<double>(error.size())), error.cwiseAbs().maxCoeff()};
}

// The spline on the map's pitch against the exact operator: the table of docs/math.md, "Exact averages", with a quarter
// as much again of room. What limits the disc is its rim: no spline on pixels holds a jump.
TEST(ExactRemoval, BoundsTheErrorOfTheSplineByThePitch) {
  struct Row {
    int pixels_per_radius;
    FastError disc, gauss;
  };
  const RemovalFunction disc = spinning_disc_removal(kSlope, kRadius), gauss = gaussian_removal(2.0, 3.0, 4.5);
  for (const Row& row : {Row{5, {3.5e-2, 9.5e-2}, {1.3e-4, 3.2e-4}}, Row{10, {1.8e-2, 5.5e-2}, {1.4e-4, 4.7e-4}},
                         Row{20, {8.6e-3, 4.4e-2}, {6.2e-5, 3.2e-4}}, Row{40, {4.0e-3, 4.0e-2}, {3.1e-5, 2.5e-4}},
                         Row{80, {2.0e-3, 2.8e-2}, {1.9e-5, 1.4e-4}}}) {
    const FastError d = fast_error(disc, row.pixels_per_radius), g = fast_error(gauss, row.pixels_per_radius);
    SCOPED_TRACE(row.pixels_per_radius);
    EXPECT_LE(d.rms, 1.25 * row.disc.rms);
    EXPECT_LE(d.largest, 1.25 * row.disc.largest);
    EXPECT_LE(g.rms, 1.25 * row.gauss.rms);
    EXPECT_LE(g.largest, 1.25 * row.gauss.largest);
    EXPECT_GT(d.rms, 0.0);  // the exact operator is not the fast one in disguise
  }
}

}  // namespace
}  // namespace dwell
