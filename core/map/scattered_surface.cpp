#include "core/map/scattered_surface.h"

#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/numerics/median.h"

namespace dwell {
namespace {

constexpr int kSectors = 8;
constexpr int kPerSector = 3;
constexpr int kMostPoints = kSectors * kPerSector;
constexpr int kQuadratic = 6, kPlane = 3;  // coefficients
constexpr double kReachInSpacings = 1.5;   // a Poisson pattern leaves 0.1 % of the part farther than this from a point
constexpr double kSearchInReaches = 3.0;   // enough for two points in each sector of a random pattern
constexpr double kLeastSingular = 1e-3;    // relative to the largest: less, and the points do not determine it
constexpr int kMostEmptySectors = kSectors / 2;

/// Distance to the sixth nearest point of a square grid as dense, in spacings: pi r^2 = 6 spacings^2.
constexpr int kNeighbour = 6;

struct Near {
  double square = std::numeric_limits<double>::infinity();  // of the distance [mm^2]
  const HeightPoint* point = nullptr;
};

/// The nearest points in each sector about a place.
struct Neighbourhood {
  std::array<std::array<Near, kPerSector>, kSectors> sectors;
  double nearest = std::numeric_limits<double>::infinity();  // square [mm^2]

  void add(const HeightPoint& point, double square, Point place) {
    nearest = std::min(nearest, square);
    const double turn = std::atan2(point.position.y - place.y, point.position.x - place.x) / (2.0 * std::numbers::pi);
    const int sector = std::clamp(static_cast<int>((turn + 0.5) * kSectors), 0, kSectors - 1);
    auto& kept = sectors[static_cast<std::size_t>(sector)];
    Near next{square, &point};
    for (Near& near : kept) {
      if (next.square < near.square) std::swap(next, near);
    }
  }

  /// The longest run of neighbouring sectors without a point.
  int longest_gap() const {
    int longest = 0, run = 0;
    for (int i = 0; i < 2 * kSectors; ++i) {
      run = sectors[static_cast<std::size_t>(i % kSectors)][0].point ? 0 : run + 1;
      longest = std::max(longest, run);
    }
    return std::min(longest, kSectors);
  }
};

/// The fitted height at the place, NaN if the points do not determine a plane.
double fitted_height(const Neighbourhood& around, Point place, double radius) {
  Eigen::Matrix<double, Eigen::Dynamic, kQuadratic, 0, kMostPoints, kQuadratic> basis(kMostPoints, kQuadratic);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostPoints, 1> heights(kMostPoints);
  Eigen::Index count = 0;
  for (const auto& sector : around.sectors) {
    for (const Near& near : sector) {
      if (!near.point) continue;
      const double u = (near.point->position.x - place.x) / radius, v = (near.point->position.y - place.y) / radius;
      const double weight = 1.0 - near.square / (radius * radius);  // the square root of the weight of the residual
      basis.row(count) << 1.0, u, v, u * u, u * v, v * v;
      basis.row(count) *= weight;
      heights(count) = weight * near.point->height;
      ++count;
    }
  }
  const auto solve = [&](int terms) {
    Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostPoints, kQuadratic>> qr;
    qr.setThreshold(kLeastSingular);
    qr.compute(basis.topLeftCorner(count, terms));
    if (qr.rank() < terms) return std::nan("");
    // Of a largest size that is known, so that no pixel allocates.
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kQuadratic, 1> coefficients = qr.solve(heights.head(count));
    return coefficients(0);
  };
  const double quadratic = count >= kQuadratic ? solve(kQuadratic) : std::nan("");
  return std::isnan(quadratic) && count >= kPlane ? solve(kPlane) : quadratic;
}

/// The median over some of the points of the spacing of a square grid that is as dense there.
double local_spacing(const PointBins& bins) {
  constexpr std::size_t kSamples = 2000;
  const auto& points = bins.points();
  const std::size_t step = std::max<std::size_t>(points.size() / kSamples, 1);
  std::vector<double> spacings, squares;
  for (std::size_t i = 0; i < points.size(); i += step) {
    double radius = bins.mean_spacing();
    do {
      radius *= 2.0;
      squares.clear();
      bins.within(points[i].position, radius, [&](const HeightPoint&, double square) { squares.push_back(square); });
    } while (squares.size() <= std::min<std::size_t>(kNeighbour, points.size() - 1));
    const auto at = squares.begin() + std::min<std::ptrdiff_t>(kNeighbour, std::ssize(squares) - 1);
    std::nth_element(squares.begin(), at, squares.end());
    spacings.push_back(std::sqrt(*at * std::numbers::pi / kNeighbour));
  }
  return upper_median(std::move(spacings));
}

double height_at(const PointBins& bins, Point place, const ScatterSummary& summary) {
  const double radius = kSearchInReaches * summary.reach;
  Neighbourhood around;
  bins.within(place, radius, [&](const HeightPoint& point, double square) { around.add(point, square, place); });
  const double nearest = std::sqrt(around.nearest);
  if (!(nearest <= summary.reach)) return std::nan("");
  if (nearest > 0.5 * summary.spacing && around.longest_gap() > kMostEmptySectors) return std::nan("");
  return fitted_height(around, place, radius);
}

}  // namespace

HeightMap scattered_surface(std::vector<HeightPoint> points, const Grid& grid, const ScatterOptions& options,
                            ScatterSummary& summary, int threads, const Progress& progress) {
  std::erase_if(points, [](const HeightPoint& point) { return std::isnan(point.height); });
  if (points.size() < kQuadratic) {
    throw InputError(fmt::format("{} with a height; at least {} are required to fit a surface",
                                 counted(points.size(), "point"), kQuadratic));
  }
  const PointBins bins(std::move(points));
  summary.spacing = bins.mean_spacing() > 0.0 ? local_spacing(bins) : 0.0;
  if (!(summary.spacing > 0.0)) throw InputError("most of its points are at one place; points apart are required");
  summary.reach = options.reach.value_or(kReachInSpacings * summary.spacing);
  HeightMap map(grid);
  constexpr Index kPixelsPerReport = 8192;
  const Index block = std::max<Index>(kPixelsPerReport / grid.cols, 1);
  for (Index first = 0; first < grid.rows; first += block) {
    progress.step(fmt::format("gridding scattered points: row {} of {}", first, grid.rows));
    const Index end = std::min(first + block, grid.rows);
#pragma omp parallel for collapse(2) num_threads(std::max(threads, 1)) schedule(dynamic, 64)
    for (Index row = first; row < end; ++row) {
      for (Index col = 0; col < grid.cols; ++col) map.at(row, col) = height_at(bins, grid.centre(row, col), summary);
    }
  }
  summary.pixels = map.valid_pixels();
  return map;
}

Grid grid_over(const std::vector<HeightPoint>& points, double pitch, std::optional<Point> origin,
               const PixelLimit& limit) {
  constexpr double kRounding = 1e-9;  // pixels
  Point low = points.front().position, high = low;
  for (const HeightPoint& point : points) {
    low = {std::min(low.x, point.position.x), std::min(low.y, point.position.y)};
    high = {std::max(high.x, point.position.x), std::max(high.y, point.position.y)};
  }
  if (origin) low = *origin;
  const auto count = [&](double from, double to) { return std::floor((to - from) / pitch + kRounding) + 1.0; };
  return limited_grid(count(low.y, high.y), count(low.x, high.x), {pitch, pitch}, low, "gridding scattered points",
                      limit);
}

}  // namespace dwell
