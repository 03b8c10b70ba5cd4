#include "solvers/fits/ceres_map_registration.h"

#include <Eigen/Core>
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/form/map_statistics.h"
#include "core/map/map_decimate.h"
#include "core/map/map_outliers.h"
#include "core/map/map_sampler.h"
#include "core/map/robust_plane.h"
#include "core/numerics/dense_solve.h"
#include "core/numerics/median.h"
#include "solvers/fits/robust_solve.h"
#include "solvers/fits/spike_removal.h"

namespace dwell {
namespace {

/// What is fitted: shift [mm], rotation [rad], scale - 1, and piston and slopes [nm, nm/mm] of the level about the
/// middle of the fixed map.
constexpr int kParameters = 7;
enum Parameter : int { kX, kY, kAngle, kScale, kPiston, kSlopeX, kSlopeY };
using Parameters = std::array<double, kParameters>;
using Row = Eigen::Matrix<double, kParameters, 1>;

/// The two maps as the fit sees them.
struct Pair {
  MapSampler moving;
  const HeightMap& fixed;
  Point about;         // middle of the moving map
  Point level_centre;  // of the fixed map
  Point guard;         // how far inside the moving map's data a place must lie [mm]

  /// Maps of the two, perhaps averaged in blocks, with the middles of the maps themselves.
  Pair(const HeightMap& m, const HeightMap& f, Point middle_of_moving, Point middle_of_fixed)
      : moving(m), fixed(f), about(middle_of_moving), level_centre(middle_of_fixed) {}

  /// The same within the moving map alone: farther from its edges and holes than the spline's continuation reaches,
  /// whose slopes are no one's.
  void keep_inside(const Grid& grid) {
    constexpr double kReach = 3.0;  // pixels
    guard = {kReach * grid.pitch_x, kReach * grid.pitch_y};
  }

  bool has_data(Point p) const {
    if (!moving.has_data(p)) return false;
    if (guard == Point{}) return true;
    const Point x{guard.x, 0.0}, y{0.0, guard.y};
    return moving.has_data(p + x) && moving.has_data(p - x) && moving.has_data(p + y) && moving.has_data(p - y);
  }

  /// The place on the moving map that lies at p of the fixed one.
  Point back(const Parameters& q, Point p) const {
    const Point d = p - about - Point{q[kX], q[kY]};
    const double c = std::cos(q[kAngle]) / (1.0 + q[kScale]), s = std::sin(q[kAngle]) / (1.0 + q[kScale]);
    return about + Point{c * d.x + s * d.y, c * d.y - s * d.x};
  }

  /// The residual at p, and its derivatives.
  double residual(const Parameters& q, Point p, double height, Row* slopes) const {
    const Point there = back(q, p), l = p - level_centre, arm = there - about;
    const SplineSurface::Jet jet = moving.jet(there);
    if (slopes) {
      const double c = std::cos(q[kAngle]) / (1.0 + q[kScale]), s = std::sin(q[kAngle]) / (1.0 + q[kScale]);
      (*slopes)[kX] = jet.by_x * c - jet.by_y * s;
      (*slopes)[kY] = jet.by_x * s + jet.by_y * c;
      (*slopes)[kAngle] = -jet.by_x * arm.y + jet.by_y * arm.x;
      (*slopes)[kScale] = (jet.by_x * arm.x + jet.by_y * arm.y) / (1.0 + q[kScale]);
      (*slopes)[kPiston] = -1.0, (*slopes)[kSlopeX] = -l.x, (*slopes)[kSlopeY] = -l.y;
    }
    return height - jet.value - q[kPiston] - q[kSlopeX] * l.x - q[kSlopeY] * l.y;
  }
};

/// The residual at one pixel of the fixed map.
class PixelResidual final : public ceres::SizedCostFunction<1, kParameters> {
 public:
  PixelResidual(const Pair& pair, Index pixel)
      : pair_(pair),
        place_(pair.fixed.grid.centre(pixel)),
        height_(pair.fixed.values[static_cast<std::size_t>(pixel)]) {}

  bool Evaluate(const double* const* x, double* residual, double** jacobians) const override {
    Parameters q;
    std::copy_n(x[0], kParameters, q.begin());
    if (!(1.0 + q[kScale] > 0.1)) return false;
    Row slopes;
    residual[0] = pair_.residual(q, place_, height_, &slopes);
    if (jacobians && jacobians[0]) std::copy_n(slopes.data(), kParameters, jacobians[0]);
    return true;
  }

 private:
  const Pair& pair_;
  Point place_;
  double height_;
};

/// The pixels of the fixed map with data in both, evenly thinned out.
std::vector<Index> common_pixels(const Pair& pair, const Parameters& q) {
  const Grid& g = pair.fixed.grid;
  const double per_point = static_cast<double>(pair.fixed.valid_pixels()) / static_cast<double>(kRegistrationPoints);
  const Index stride = std::max<Index>(1, static_cast<Index>(std::ceil(std::sqrt(per_point))));
  std::vector<Index> pixels;
  for (Index r = (g.rows - 1) % stride / 2; r < g.rows; r += stride) {
    for (Index c = (g.cols - 1) % stride / 2; c < g.cols; c += stride) {
      if (std::isfinite(pair.fixed.at(r, c)) && pair.has_data(pair.back(q, g.centre(r, c)))) {
        pixels.push_back(g.index(r, c));
      }
    }
  }
  return pixels;
}

std::vector<double> residuals(const Pair& pair, const Parameters& q, const std::vector<Index>& pixels) {
  std::vector<double> r;
  r.reserve(pixels.size());
  for (const Index i : pixels) {
    r.push_back(pair.residual(q, pair.fixed.grid.centre(i), pair.fixed.values[static_cast<std::size_t>(i)], nullptr));
  }
  return r;
}

double rms(const std::vector<double>& r) {
  double sum = 0.0;
  for (const double v : r) sum += v * v;
  return std::sqrt(sum / static_cast<double>(r.size()));
}

/// The difference of the maps as they lie (all parameters at `q`), NaN but at `pixels`.
HeightMap difference_at(const Pair& pair, const Parameters& q, const std::vector<Index>& pixels) {
  HeightMap difference(pair.fixed.grid);
  std::fill(difference.values.begin(), difference.values.end(), std::numeric_limits<double>::quiet_NaN());
  const std::vector<double> r = residuals(pair, q, pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) difference.values[static_cast<std::size_t>(pixels[i])] = r[i];
  return difference;
}

/// How large the difference is as the maps lie, level taken out if it is free; NaN for less than three common pixels.
DifferenceSize size_of_difference(const Pair& pair, const Parameters& q, bool level) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Index> pixels = common_pixels(pair, q);
  if (pixels.size() < 3) return {kNone, kNone};
  const HeightMap difference = difference_at(pair, q, pixels);
  return {map_statistics(difference, {level, level, false}).rms_about_zero(),
          level ? robust_plane(difference, pixels, true).scatter : robust_sigma(residuals(pair, q, pixels))};
}

constexpr double kLeastMapInformation = 1e-8;  // a slope of 1e-4 of the largest
// What averaged maps say less of may be the spline's own doing at their edges.
constexpr double kLeastCoarseInformation = 1e-4;

class RegistrationFit {
 public:
  RegistrationFit(const Pair& pair, const RegistrationOptions& options, int threads) : pair_(pair), threads_(threads) {
    for (int k = 0; k < kParameters; ++k) {
      const bool is_free = k == kX || k == kY || (k == kAngle && options.rotation) || (k == kScale && options.scale) ||
                           (k >= kPiston && options.level);
      (is_free ? free_ : held_).push_back(k);
    }
  }

  /// One robust fit from q. Returns the number of iterations. Throws Interrupted.
  int run(Parameters& q, const std::vector<Index>& pixels, const Progress& progress) {
    width_ = cauchy_width(residuals(pair_, q, pixels));
    ceres::CauchyLoss loss(width_);
    ceres::Problem problem(with_own_loss());
    problem.AddParameterBlock(q.data(), kParameters);
    if (!held_.empty()) problem.SetManifold(q.data(), new ceres::SubsetManifold(kParameters, held_));
    for (const Index i : pixels) problem.AddResidualBlock(new PixelResidual(pair_, i), &loss, q.data());
    return solve_registration(problem, threads_, progress);
  }

  /// Whether the maps, with the weights of the last fit, say how they lie: about no free number less than this share
  /// of what they say about the one that they say most of.
  bool is_determined(const Parameters& q, const std::vector<Index>& pixels, double least) const {
    return is_determined(normal_of(q, pixels).matrix, least);
  }

  /// Standard errors of all parameters, from the weights of the last fit.
  Parameters standard_errors(const Parameters& q, const std::vector<Index>& pixels) const {
    const Normal all = normal_of(q, pixels);
    if (!is_determined(all.matrix, kLeastMapInformation)) {
      throw InputError(
          "registration: the maps do not say how they lie (flat, or alike after some shift, rotation or scale); fewer "
          "free numbers or maps with more structure are required");
    }
    const auto spare = static_cast<double>(static_cast<Index>(pixels.size()) - static_cast<Index>(free_.size()));
    const double variance = all.squares / spare;  // enough_pixels sees to it that there are more
    const Eigen::MatrixXd covariance =
        solve_symmetric(all.matrix, Eigen::MatrixXd::Identity(all.matrix.rows(), all.matrix.cols()));
    Parameters errors{};
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      errors[static_cast<std::size_t>(free_[k])] = std::sqrt(variance * covariance(i, i));
    }
    return errors;
  }

 private:
  struct Normal {
    Eigen::MatrixXd matrix;  // of the free parameters
    double squares = 0.0;    // of the residuals, weighted
  };

  Normal normal_of(const Parameters& q, const std::vector<Index>& pixels) const {
    Eigen::Matrix<double, kParameters, kParameters> all = decltype(all)::Zero();
    double squares = 0.0;
    for (const Index i : pixels) {
      Row slopes;
      const double r =
          pair_.residual(q, pair_.fixed.grid.centre(i), pair_.fixed.values[static_cast<std::size_t>(i)], &slopes);
      const double weight = 1.0 / (1.0 + r * r / (width_ * width_));
      all += weight * slopes * slopes.transpose();
      squares += weight * r * r;
    }
    return {all(free_, free_), squares};
  }

  /// Parameters are scaled by steps of like effect: a shift by one pixel, and a rotation and a magnification that move
  /// the rim by one.
  bool is_determined(const Eigen::MatrixXd& normal, double least) const {
    const Eigen::VectorXd step = natural_steps()(free_);
    const Eigen::MatrixXd natural = step.asDiagonal() * normal * step.asDiagonal();
    const SymmetricEigen eigen = symmetric_eigen(natural);
    return eigen.converged && eigen.values.maxCoeff() > 0.0 &&
           eigen.values.minCoeff() > least * eigen.values.maxCoeff();
  }

  Row natural_steps() const {
    const Grid& g = pair_.fixed.grid;
    const double half = 0.5 * std::hypot(g.width(), g.height()), pitch = std::min(g.pitch_x, g.pitch_y);
    const double height = map_statistics(pair_.fixed, {true, true, false}).rms;
    Row steps;
    steps << pitch, pitch, pitch / half, pitch / half, height, height / half, height / half;
    return steps;
  }

  const Pair& pair_;
  int threads_;
  std::vector<int> free_, held_;
  double width_ = 1.0;
};

/// The level between the maps as they lie, so that the robust fit starts near its solution.
void start_level(const Pair& pair, Parameters& q, const std::vector<Index>& pixels) {
  const Plane level = robust_plane(difference_at(pair, q, pixels), pixels, true);
  q[kPiston] += level.at(pair.level_centre), q[kSlopeX] += level.slope.x, q[kSlopeY] += level.slope.y;
}

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::vector<Index> enough_pixels(const Pair& pair, const Parameters& q) {
  std::vector<Index> pixels = common_pixels(pair, q);
  if (pixels.size() >= 10 * kParameters) return pixels;
  throw InputError(
      fmt::format("registration: {} with data in both maps; at least {} required: do the maps overlap, in mm?",
                  counted(pixels.size(), "pixel"), 10 * kParameters));
}

/// Fits from q, the pixels and the scale of the loss chosen anew after each fit, until it no longer changes. Returns
/// the number of iterations.
int fit_until_settled(const Pair& pair, RegistrationFit& fit, Parameters& q, const Progress& progress) {
  constexpr int kPasses = 10;
  int iterations = 0;
  std::vector<Index> pixels = enough_pixels(pair, q);
  for (int pass = 0; pass < kPasses; ++pass) {
    progress.step(fmt::format("registration: {}, pass {}, RMS {:.4g} nm", counted(pixels.size(), "pixel"), pass + 1,
                              rms(residuals(pair, q, pixels))));
    const Parameters before = q;
    iterations += fit.run(q, pixels, progress);
    pixels = enough_pixels(pair, q);
    const double moved = std::hypot(q[kX] - before[kX], q[kY] - before[kY]);
    const double turned = std::abs(q[kAngle] - before[kAngle]) + std::abs(q[kScale] - before[kScale]);
    if (moved <= 1e-6 * pair.fixed.grid.pitch_x && turned <= 1e-9) break;
  }
  return iterations;
}

HeightMap first_pixels(const HeightMap& map, Index rows, Index columns) {
  Grid grid = map.grid;
  grid.rows = rows, grid.cols = columns;
  HeightMap part(grid);
  for (Index r = 0; r < rows; ++r) {
    for (Index c = 0; c < columns; ++c) part.at(r, c) = map.at(r, c);
  }
  return part;
}

/// The map averaged in blocks of about this size [mm]; nothing where fewer than kLeastBlocks of them would be left.
std::optional<HeightMap> averaged(const HeightMap& map, double block) {
  constexpr Index kLeastBlocks = 16;
  const auto factor = [block](double pitch) { return std::max<Index>(1, std::llround(block / pitch)); };
  const Index rows = factor(map.grid.pitch_y), columns = factor(map.grid.pitch_x);
  if (map.grid.rows / rows < kLeastBlocks || map.grid.cols / columns < kLeastBlocks) return std::nullopt;
  // A block that is not full lies elsewhere than its middle.
  return decimate_map(first_pixels(map, map.grid.rows / rows * rows, map.grid.cols / columns * columns), rows, columns);
}

/// The fit on maps averaged in blocks of eight, four and two pixels, one after the other: waves of a few pixels, dust
/// and noise would hold a fit that starts farther off than they are long. A coarse fit that finds too little in its
/// maps leaves q as it is.
void fit_coarse_to_fine(const HeightMap& moving, const HeightMap& fixed, const RegistrationOptions& options,
                        int threads, Parameters& q, const Progress& progress) {
  const double pitch = std::max({moving.grid.pitch_x, moving.grid.pitch_y, fixed.grid.pitch_x, fixed.grid.pitch_y});
  for (const double block : {8.0, 4.0, 2.0}) {
    const auto coarse_moving = averaged(moving, block * pitch), coarse_fixed = averaged(fixed, block * pitch);
    if (!coarse_moving || !coarse_fixed) continue;
    Pair pair(*coarse_moving, *coarse_fixed, middle_of(moving.grid), middle_of(fixed.grid));
    pair.keep_inside(coarse_moving->grid);
    if (common_pixels(pair, q).size() < 10 * kParameters) continue;
    RegistrationFit fit(pair, options, threads);
    Parameters found = q;
    try {
      fit_until_settled(pair, fit, found, progress);
    } catch (const InputError&) {
      continue;  // it lost the overlap
    }
    const std::vector<Index> pixels = common_pixels(pair, found);
    if (pixels.size() >= 10 * kParameters && fit.is_determined(found, pixels, kLeastCoarseInformation)) q = found;
  }
}

}  // namespace

MapRegistration register_maps(const HeightMap& moving, const HeightMap& fixed, const RegistrationOptions& options,
                              int threads, const Progress& progress) {
  MapRegistration result;
  HeightMap clear_moving, clear_fixed;
  std::tie(clear_moving, result.spikes_moving) = without_spikes(moving, threads, progress);
  std::tie(clear_fixed, result.spikes_fixed) = without_spikes(fixed, threads, progress);
  progress.step("registration: coarse start");
  const Pair pair(clear_moving, clear_fixed, middle_of(moving.grid), middle_of(fixed.grid));
  Parameters q{};
  result.before = size_of_difference(pair, q, options.level);
  if (options.range.shift > 0.0 || options.range.degrees > 0.0) {
    const RegistrationRange range{options.range.shift, options.rotation ? options.range.degrees : 0.0};
    const RegistrationStart start = coarse_registration(clear_moving, clear_fixed, range, threads, progress);
    q[kX] = start.shift.x, q[kY] = start.shift.y, q[kAngle] = start.degrees / kDegrees;
  }
  const std::vector<Index> first = enough_pixels(pair, q);
  if (options.level) start_level(pair, q, first);
  fit_coarse_to_fine(clear_moving, clear_fixed, options, threads, q, progress);
  RegistrationFit fit(pair, options, threads);
  result.iterations = fit_until_settled(pair, fit, q, progress);
  const std::vector<Index> pixels = enough_pixels(pair, q);
  const Parameters errors = fit.standard_errors(q, pixels);
  result.x = {q[kX], errors[kX]}, result.y = {q[kY], errors[kY]};
  result.degrees = {q[kAngle] * kDegrees, errors[kAngle] * kDegrees};
  result.scale = {1.0 + q[kScale], errors[kScale]};
  result.transform = similarity(pair.about, {q[kX], q[kY]}, result.degrees.value, result.scale.value);
  result.points = static_cast<Index>(pixels.size());
  result.after = size_of_difference(pair, q, options.level);
  return result;
}

}  // namespace dwell
