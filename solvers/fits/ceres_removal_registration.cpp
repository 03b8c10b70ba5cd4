#include "solvers/fits/ceres_removal_registration.h"

#include <Eigen/Core>
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/map/map_crop.h"
#include "core/map/map_sampler.h"
#include "core/numerics/dense_solve.h"
#include "solvers/fits/robust_solve.h"
#include "solvers/fits/spike_removal.h"

namespace dwell {
namespace {

/// What is fitted: shift [mm], rotation [rad], scale - 1, rate, width - 1, and the form terms of the level about the
/// middle: piston [nm], slopes [nm/mm], power and astigmatism [nm/mm^2].
constexpr int kRemovalNumbers = 12;
enum RemovalNumber : int {
  kShiftX,
  kShiftY,
  kTurn,
  kGrowth,
  kRate,
  kWidth,
  kLevel,
  kTiltX,
  kTiltY,
  kPower,
  kAstigmatism,
  kTurnedAstigmatism
};
using RemovalNumbers = std::array<double, kRemovalNumbers>;
using RemovalRow = Eigen::Matrix<double, kRemovalNumbers, 1>;

constexpr double kRadians = std::numbers::pi / 180.0;

/// A form term of the level at a place [mm] counted from the middle.
double form_at(int term, Point p) {
  switch (term) {
    case kTiltX:
      return p.x;
    case kTiltY:
      return p.y;
    case kPower:
      return p.x * p.x + p.y * p.y;
    case kAstigmatism:
      return p.x * p.x - p.y * p.y;
    case kTurnedAstigmatism:
      return 2.0 * p.x * p.y;
    default:
      return 1.0;
  }
}

/// The form terms that are free.
std::vector<int> level_numbers(const FormTerms& level) {
  std::vector<int> numbers;
  if (level.piston) numbers.push_back(kLevel);
  if (level.tilt) numbers.insert(numbers.end(), {kTiltX, kTiltY});
  if (level.power) numbers.push_back(kPower);
  if (level.astigmatism) numbers.insert(numbers.end(), {kAstigmatism, kTurnedAstigmatism});
  return numbers;
}

/// The model, and the measured removal it is held to.
class RemovalPair {
 public:
  RemovalPair(const PredictedRemoval& predicted, const HeightMap& measured, const Progress& progress)
      : widths_(predicted.widths), measured_(measured), about_(middle_of_data(measured)) {
    for (const HeightMap& removal : predicted.removals) samplers_.emplace_back(removal, progress);
  }

  Point about() const { return about_; }
  const HeightMap& measured() const { return measured_; }
  double height(Index pixel) const { return measured_.values[static_cast<std::size_t>(pixel)]; }

  Point back(const RemovalNumbers& q, Point p) const {
    const Point d = p - about_ - Point{q[kShiftX], q[kShiftY]};
    const double c = std::cos(q[kTurn]) / (1.0 + q[kGrowth]), s = std::sin(q[kTurn]) / (1.0 + q[kGrowth]);
    return about_ + Point{c * d.x + s * d.y, c * d.y - s * d.x};
  }

  bool has_data(const RemovalNumbers& q, Point p) const { return samplers_.front().has_data(back(q, p)); }

  /// Measured less model at p, and the derivatives of that.
  double residual(const RemovalNumbers& q, Point p, double height, RemovalRow* slopes) const {
    const Point there = back(q, p), l = p - about_, arm = there - about_;
    double by_width = 0.0;
    const SplineSurface::Jet jet = predicted_at(there, 1.0 + q[kWidth], by_width);
    if (slopes != nullptr) {
      const double c = std::cos(q[kTurn]) / (1.0 + q[kGrowth]), s = std::sin(q[kTurn]) / (1.0 + q[kGrowth]);
      RemovalRow& row = *slopes;
      row[kShiftX] = q[kRate] * (jet.by_x * c - jet.by_y * s);
      row[kShiftY] = q[kRate] * (jet.by_x * s + jet.by_y * c);
      row[kTurn] = q[kRate] * (jet.by_y * arm.x - jet.by_x * arm.y);
      row[kGrowth] = q[kRate] * (jet.by_x * arm.x + jet.by_y * arm.y) / (1.0 + q[kGrowth]);
      row[kRate] = -jet.value, row[kWidth] = -q[kRate] * by_width;
      for (int k = kLevel; k < kRemovalNumbers; ++k) row[k] = -form_at(k, l);
    }
    double left = height - q[kRate] * jet.value;
    for (std::size_t k = kLevel; k < kRemovalNumbers; ++k) left -= q[k] * form_at(static_cast<int>(k), l);
    return left;
  }

 private:
  /// The parabola through three widths, or the one there is.
  SplineSurface::Jet predicted_at(Point p, double width, double& by_width) const {
    if (samplers_.size() == 1) return samplers_.front().jet(p);
    SplineSurface::Jet sum{0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 3; ++i) {
      const double a = widths_[(i + 1) % 3], b = widths_[(i + 2) % 3], below = (widths_[i] - a) * (widths_[i] - b);
      const double share = (width - a) * (width - b) / below, slope = (2.0 * width - a - b) / below;
      const SplineSurface::Jet jet = samplers_[i].jet(p);
      sum.value += share * jet.value, sum.by_x += share * jet.by_x, sum.by_y += share * jet.by_y;
      by_width += slope * jet.value;
    }
    return sum;
  }

  std::vector<double> widths_;
  std::vector<MapSampler> samplers_;
  const HeightMap& measured_;
  Point about_;
};

class RemovalResidual final : public ceres::SizedCostFunction<1, kRemovalNumbers> {
 public:
  RemovalResidual(const RemovalPair& pair, Index pixel)
      : pair_(pair), place_(pair.measured().grid.centre(pixel)), height_(pair.height(pixel)) {}

  bool Evaluate(const double* const* x, double* residual, double** jacobians) const override {
    RemovalNumbers q;
    std::copy_n(x[0], kRemovalNumbers, q.begin());
    // Beyond these no tool is the one that was planned with, and the parabola between the widths says nothing.
    if (!(std::abs(q[kGrowth]) < 0.5) || !(std::abs(q[kWidth]) < 0.5) || !(q[kRate] > 0.0)) return false;
    RemovalRow slopes;
    residual[0] = pair_.residual(q, place_, height_, &slopes);
    if (jacobians && jacobians[0]) std::copy_n(slopes.data(), kRemovalNumbers, jacobians[0]);
    return true;
  }

 private:
  const RemovalPair& pair_;
  Point place_;
  double height_;
};

std::vector<Index> compared_pixels(const RemovalPair& pair, const RemovalNumbers& q) {
  const HeightMap& map = pair.measured();
  const Grid& g = map.grid;
  const double per_point = static_cast<double>(map.valid_pixels()) / static_cast<double>(kRemovalPoints);
  const Index stride = std::max<Index>(1, static_cast<Index>(std::ceil(std::sqrt(per_point))));
  std::vector<Index> pixels;
  for (Index r = (g.rows - 1) % stride / 2; r < g.rows; r += stride) {
    for (Index c = (g.cols - 1) % stride / 2; c < g.cols; c += stride) {
      if (std::isfinite(map.at(r, c)) && pair.has_data(q, g.centre(r, c))) pixels.push_back(g.index(r, c));
    }
  }
  if (pixels.size() >= 10 * kRemovalNumbers) return pixels;
  throw InputError(
      fmt::format("registration of the removal: {} with data in both the measured and the predicted one; at least {} "
                  "required: do they overlap, in mm?",
                  counted(pixels.size(), "pixel"), 10 * kRemovalNumbers));
}

class RemovalRegistrationFit {
 public:
  RemovalRegistrationFit(const RemovalPair& pair, const RemovalRegistrationOptions& options, bool widths, int threads)
      : pair_(pair), options_(options), threads_(threads), level_(level_numbers(options.level)) {
    const auto is_free = [&](int k) {
      switch (k) {
        case kShiftX:
        case kShiftY:
          return options.shift;
        case kTurn:
          return options.rotation;
        case kGrowth:
          return options.scale;
        case kRate:
          return options.rate;
        case kWidth:
          return options.width && widths;
        default:
          return std::find(level_.begin(), level_.end(), k) != level_.end();
      }
    };
    for (int k = 0; k < kRemovalNumbers; ++k) (is_free(k) ? free_ : held_).push_back(k);
  }

  std::vector<double> residuals(const RemovalNumbers& q, const std::vector<Index>& pixels) const {
    std::vector<double> r;
    r.reserve(pixels.size());
    for (const Index i : pixels)
      r.push_back(pair_.residual(q, pair_.measured().grid.centre(i), pair_.height(i), nullptr));
    return r;
  }

  int run(RemovalNumbers& q, const std::vector<Index>& pixels, const Progress& progress) {
    loss_width_ = cauchy_width(residuals(q, pixels));
    ceres::CauchyLoss loss(loss_width_);
    ceres::Problem problem(with_own_loss());
    problem.AddParameterBlock(q.data(), kRemovalNumbers);
    if (!held_.empty()) problem.SetManifold(q.data(), new ceres::SubsetManifold(kRemovalNumbers, held_));
    for (const Index i : pixels) problem.AddResidualBlock(new RemovalResidual(pair_, i), &loss, q.data());
    return solve_registration(problem, threads_, progress);
  }

  /// Level alone, by least squares: what the fit starts from.
  void set_level(RemovalNumbers& q, const std::vector<Index>& pixels) const {
    if (level_.empty()) return;
    const auto count = static_cast<Eigen::Index>(level_.size());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    for (const Index i : pixels) {
      RemovalRow slopes;
      const double r = pair_.residual(q, pair_.measured().grid.centre(i), pair_.height(i), &slopes);
      const Eigen::VectorXd row = slopes(level_);
      normal += row * row.transpose();
      right -= r * row;
    }
    const Eigen::VectorXd step = solve_symmetric(normal, right);
    for (std::size_t k = 0; k < level_.size(); ++k)
      q[static_cast<std::size_t>(level_[k])] += step[static_cast<Eigen::Index>(k)];
  }

  RemovalNumbers standard_errors(const RemovalNumbers& q, const std::vector<Index>& pixels) const;

 private:
  using Square = Eigen::Matrix<double, kRemovalNumbers, kRemovalNumbers>;

  /// Of a row of derivatives, so that all are about alike: changes that move the rim by a pixel, or what is removed by
  /// a hundredth.
  Eigen::VectorXd natural_steps(const Square& all) const {
    Eigen::VectorXd steps(static_cast<Eigen::Index>(free_.size()));
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const double size = all(free_[k], free_[k]);
      steps[static_cast<Eigen::Index>(k)] = size > 0.0 ? 1.0 / std::sqrt(size) : 1.0;
    }
    return steps;
  }

  const RemovalPair& pair_;
  RemovalRegistrationOptions options_;
  int threads_;
  std::vector<int> level_;  // the form terms that are free
  std::vector<int> free_, held_;
  double loss_width_ = 1.0;
};

RemovalNumbers RemovalRegistrationFit::standard_errors(const RemovalNumbers& q,
                                                       const std::vector<Index>& pixels) const {
  const Grid& g = pair_.measured().grid;
  Square all = Square::Zero();
  double squares = 0.0;
  std::map<std::pair<long, long>, RemovalRow> clusters;
  for (const Index i : pixels) {
    RemovalRow slopes;
    const Point p = g.centre(i);
    const double r = pair_.residual(q, p, pair_.height(i), &slopes);
    const double weight = 1.0 / (1.0 + r * r / (loss_width_ * loss_width_));
    all += weight * slopes * slopes.transpose();
    squares += weight * r * r;
    if (options_.correlated_mm > 0.0) {
      const std::pair<long, long> at{std::lround(p.x / options_.correlated_mm),
                                     std::lround(p.y / options_.correlated_mm)};
      const auto found = clusters.try_emplace(at, RemovalRow::Zero()).first;
      found->second += weight * r * slopes;
    }
  }
  const Eigen::VectorXd step = natural_steps(all);
  const Eigen::MatrixXd natural = step.asDiagonal() * Eigen::MatrixXd(all(free_, free_)) * step.asDiagonal();
  const SymmetricEigen eigen = symmetric_eigen(natural);
  constexpr double kLeastInformation = 1e-9;
  if (!(eigen.converged && eigen.values.minCoeff() > kLeastInformation * eigen.values.maxCoeff())) {
    throw InputError(
        "registration of the removal: the predicted removal does not say how the measured one lies against it (flat, "
        "or "
        "alike after some shift, rotation or change of the tool); fewer free numbers or more structure are required");
  }
  const Eigen::MatrixXd inverse = solve_symmetric(natural, Eigen::MatrixXd::Identity(natural.rows(), natural.cols()));
  const auto spare = static_cast<double>(static_cast<Index>(pixels.size()) - static_cast<Index>(free_.size()));
  Eigen::VectorXd variance = squares / spare * inverse.diagonal();
  constexpr std::size_t kSpareClusters = 4;
  if (clusters.size() >= free_.size() + kSpareClusters) {
    Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(natural.rows(), natural.cols());
    for (const auto& [at, sum] : clusters) {
      const Eigen::VectorXd row = step.cwiseProduct(Eigen::VectorXd(sum(free_)));
      meat += row * row.transpose();
    }
    const double few = static_cast<double>(clusters.size()) / static_cast<double>(clusters.size() - free_.size());
    variance = variance.cwiseMax(few * (inverse * meat * inverse).diagonal());
  }
  RemovalNumbers errors{};
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    errors[static_cast<std::size_t>(free_[k])] = step[i] * std::sqrt(variance[i]);
  }
  return errors;
}

DifferenceSize size_of(const std::vector<double>& r) {
  double sum = 0.0;
  for (const double v : r) sum += v * v;
  return {std::sqrt(sum / static_cast<double>(r.size())), robust_sigma(r)};
}

void check_prediction(const PredictedRemoval& predicted) {
  const std::size_t n = predicted.widths.size();
  const bool ascends = n == 3 && predicted.widths[0] < predicted.widths[1] && predicted.widths[1] < predicted.widths[2];
  if (predicted.removals.size() == n && (n == 1 || ascends)) return;
  throw std::invalid_argument("a predicted removal is for one width, or for three in ascending order");
}

}  // namespace

RemovalRegistration register_removal(const PredictedRemoval& predicted, const HeightMap& measured,
                                     const RemovalRegistrationOptions& options, int threads, const Progress& progress) {
  check_prediction(predicted);
  RemovalRegistration result;
  HeightMap clear;
  std::tie(clear, result.spikes) = without_spikes(measured, threads, progress);
  const RemovalPair pair(predicted, clear, progress);
  RemovalRegistrationFit fit(pair, options, predicted.widths.size() == 3, threads);
  RemovalNumbers q{};
  std::vector<Index> pixels = compared_pixels(pair, q);
  fit.set_level(q, pixels);
  result.measured_rms = size_of(fit.residuals(q, pixels)).rms;
  q[kRate] = 1.0;
  fit.set_level(q, pixels);
  result.before = size_of(fit.residuals(q, pixels));
  constexpr int kRemovalPasses = 10;
  for (int pass = 0; pass < kRemovalPasses; ++pass) {
    progress.step(fmt::format("registration of the removal: {}, pass {}, RMS {:.4g} nm",
                              counted(pixels.size(), "pixel"), pass + 1, size_of(fit.residuals(q, pixels)).rms));
    const RemovalNumbers before = q;
    result.iterations += fit.run(q, pixels, progress);
    pixels = compared_pixels(pair, q);
    double moved = 0.0;
    for (int k = 0; k < kLevel; ++k)
      moved = std::max(moved, std::abs(q[static_cast<std::size_t>(k)] - before[static_cast<std::size_t>(k)]));
    if (moved <= 1e-7) break;
  }
  const RemovalNumbers errors = fit.standard_errors(q, pixels);
  result.x = {q[kShiftX], errors[kShiftX]}, result.y = {q[kShiftY], errors[kShiftY]};
  result.degrees = {q[kTurn] / kRadians, errors[kTurn] / kRadians};
  result.scale = {1.0 + q[kGrowth], errors[kGrowth]};
  result.rate = {q[kRate], errors[kRate]}, result.width = {1.0 + q[kWidth], errors[kWidth]};
  result.about = pair.about();
  result.transform = similarity(pair.about(), {q[kShiftX], q[kShiftY]}, result.degrees.value, result.scale.value);
  result.points = static_cast<Index>(pixels.size());
  result.after = size_of(fit.residuals(q, pixels));
  return result;
}

}  // namespace dwell
