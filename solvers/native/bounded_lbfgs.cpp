#include "solvers/native/bounded_lbfgs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "solvers/problem/blocks.h"
#include "solvers/problem/simd.h"

namespace dwell {
namespace {

constexpr double kLeastCurvature = 1e-30;  // of |d| |Hd|: below that, a pair holds rounding
constexpr double kRounding = 1e-15;        // of the objective: a step that lowers it by less does not
constexpr int kLastTries = 50;  // after so many such steps that do not halve the squared gradient either, the run ends

constexpr Index kLanes = 8;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));
using LooseLanes = float __attribute__((vector_size(kLanes * sizeof(float)), aligned(alignof(float)), may_alias));
using Block = std::array<float, kBlock>;

DWELL_SIMD double dot(const float* a, const float* b, Index n) {
  Lanes even{}, odd{};
  Index i = 0;
  for (; i + 2 * kLanes <= n; i += 2 * kLanes) {
    const auto *x = reinterpret_cast<const LooseLanes*>(a + i), *y = reinterpret_cast<const LooseLanes*>(b + i);
    even += x[0] * y[0];
    odd += x[1] * y[1];
  }
  double sum = 0.0;
  for (Index k = 0; k < kLanes; ++k) sum += static_cast<double>(even[k] + odd[k]);
  for (; i < n; ++i) sum += static_cast<double>(a[i] * b[i]);
  return sum;
}

DWELL_SIMD void multiply(const float* a, const float* b, float* to, Index n) {
  for (Index i = 0; i < n; ++i) to[i] = a[i] * b[i];
}

DWELL_SIMD void add_two(float a, const float* x, float b, const float* y, float* to, Index n) {
  for (Index i = 0; i < n; ++i) to[i] += a * x[i] + b * y[i];
}

/// Marks with 1 the variables that may move, 0 the others, and masks the gradient; returns its squared norm.
DWELL_SIMD double mark_free(const double* x, const double* g, const double* lower, const double* upper, float* mask,
                            float* masked, Index n) {
  std::array<double, kLanes> sum{};
  const auto mark = [&](Index i, double& to) {
    const bool held = (x[i] <= lower[i] && g[i] >= 0.0) || (x[i] >= upper[i] && g[i] <= 0.0);
    const double kept = held ? 0.0 : g[i];
    mask[i] = held ? 0.0F : 1.0F;
    masked[i] = static_cast<float>(kept);
    to += kept * kept;
  };
  Index i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    for (Index k = 0; k < kLanes; ++k) mark(i + k, sum[static_cast<std::size_t>(k)]);
  }
  for (; i < n; ++i) mark(i, sum[0]);
  return std::accumulate(sum.begin(), sum.end(), 0.0);
}

/// d = what the bounds allow of g_share * g + rest on the free variables; returns g'd.
DWELL_SIMD double aim_block(const double* x, const double* g, const double* lower, const double* upper,
                            const float* mask, double g_share, const float* rest, double* d, Index n) {
  std::array<double, kLanes> sum{};
  const auto aim = [&](Index i, double& to) {
    const double wish = x[i] + static_cast<double>(mask[i]) * (g_share * g[i] + static_cast<double>(rest[i]));
    const double raised = wish > lower[i] ? wish : lower[i];
    d[i] = (raised < upper[i] ? raised : upper[i]) - x[i];
    to += g[i] * d[i];
  };
  Index i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    for (Index k = 0; k < kLanes; ++k) aim(i + k, sum[static_cast<std::size_t>(k)]);
  }
  for (; i < n; ++i) aim(i, sum[0]);
  return std::accumulate(sum.begin(), sum.end(), 0.0);
}

/// x += a d, kept within the bounds against rounding; g += a hd.
DWELL_SIMD void move_block(double a, const double* d, const double* hd, const double* lower, const double* upper,
                           double* x, double* g, Index n) {
  for (Index i = 0; i < n; ++i) {
    const double to = x[i] + a * d[i], raised = to > lower[i] ? to : lower[i];
    x[i] = raised < upper[i] ? raised : upper[i];
    g[i] += a * hd[i];
  }
}

DWELL_SIMD void scale_block(double scale, const double* from, float* to, Index n) {
  for (Index i = 0; i < n; ++i) to[i] = static_cast<float>(scale * from[i]);
}

}  // namespace

BoundedLbfgs::BoundedLbfgs(const Vector& lower, const Vector& upper, int threads)
    : lower_(lower),
      upper_(upper),
      no_upper_(Vector::Constant(kBlock, std::numeric_limits<double>::infinity())),
      threads_(threads),
      free_(lower.size()) {
  const Index n = lower.size();
  direction_.resize(n);
  product_.resize(n);
  s_.resize(n, kPairs);
  y_.resize(n, kPairs);
  sums_.resize(kSums, block_count(n));
}

void BoundedLbfgs::forget() {
  pairs_ = 0;
  spectral_length_ = 0.0;
}

void BoundedLbfgs::minimise(QuadraticForm& form, double tolerance, QuadraticPoint& point, const Monitor& go_on) {
  form_ = &form;
  point_ = &point;
  double least = std::numeric_limits<double>::infinity();
  for (int idle = 0; idle < kLastTries;) {
    const Products products = free_products();
    if (!(std::sqrt(products.gg) > tolerance)) return;
    double slope = pairs_ > 0 ? aim(two_loops(products)) : 0.0;
    if (!(slope < 0.0)) {
      if (!find_spectral_length() || !((slope = aim_along_gradient()) < 0.0)) return;
    }
    const double before = point.value;
    if (!advance(slope)) return;
    if (products.gg < 0.5 * least || point.value < before - kRounding * std::abs(before)) {
      idle = 0;
      least = std::min(least, products.gg);
    } else {
      ++idle;
    }
    if (!go_on(point)) return;
  }
}

/// Marks the free variables and sums over them. One pass over the pairs.
BoundedLbfgs::Products BoundedLbfgs::free_products() {
  const QuadraticPoint& p = *point_;
  for_blocks(p.x.size(), threads_, [&](Index b, Index begin, Index length) {
    Block gradient;
    sums_(0, b) = mark_free(&p.x[begin], &p.gradient[begin], &lower_[begin], upper_at(begin), &free_[begin],
                            gradient.data(), length);
    sum_block(b, begin, length, gradient.data());
  });
  Eigen::Matrix<double, kSums, 1> total = Eigen::Matrix<double, kSums, 1>::Zero();
  for (Index b = 0; b < sums_.cols(); ++b) total += sums_.col(b);
  Products result;
  result.gg = total[0];
  Index at = 1;
  for (Index i = 0; i < pairs_; ++i) {
    result.sg[i] = total[at++];
    result.yg[i] = total[at++];
    for (Index k = 0; k < pairs_; ++k) {
      result.sy(i, k) = total[at++];
      if (k >= i) result.yy(i, k) = result.yy(k, i) = total[at++];
    }
  }
  return result;
}

void BoundedLbfgs::sum_block(Index b, Index begin, Index length, const float* gradient) {
  std::array<Block, kPairs> y;
  for (Index i = 0; i < pairs_; ++i)
    multiply(y_.col(slot(i)).data() + begin, &free_[begin], y[static_cast<std::size_t>(i)].data(), length);
  double* sum = sums_.col(b).data() + 1;
  for (Index i = 0; i < pairs_; ++i) {
    const float *si = s_.col(slot(i)).data() + begin, *yi = y[static_cast<std::size_t>(i)].data();
    *sum++ = dot(si, gradient, length);
    *sum++ = dot(yi, gradient, length);
    for (Index k = 0; k < pairs_; ++k) {
      const float* yk = y[static_cast<std::size_t>(k)].data();
      *sum++ = dot(si, yk, length);
      if (k >= i) *sum++ = dot(yi, yk, length);
    }
  }
}

/// The two-loop recursion on coefficients: no pass over the variables. Pairs that have lost their curvature on the free
/// variables are left out.
BoundedLbfgs::Combination BoundedLbfgs::two_loops(const Products& p) const {
  Combination q;
  q.s.setZero();
  q.y.setZero();
  q.gradient = -1.0;
  Eigen::Matrix<double, kPairs, 1> alpha;
  double scale = 0.0;
  const auto usable = [&](Index i) { return p.sy(i, i) > 1e-10 && p.yy(i, i) > 0.0; };
  for (Index i = 0; i < pairs_; ++i) {
    if (!usable(i)) continue;
    if (scale == 0.0) scale = p.sy(i, i) / p.yy(i, i);
    double dot = q.gradient * p.sg[i];
    for (Index k = 0; k < i; ++k) dot += q.y[k] * p.sy(i, k);
    alpha[i] = dot / p.sy(i, i);
    q.y[i] = -alpha[i];
  }
  q.gradient *= scale;
  q.y *= scale;
  for (Index i = pairs_ - 1; i >= 0; --i) {
    if (!usable(i)) continue;
    double dot = q.gradient * p.yg[i];
    for (Index k = 0; k < pairs_; ++k) dot += q.y[k] * p.yy(i, k);
    for (Index k = i + 1; k < pairs_; ++k) dot += q.s[k] * p.sy(k, i);
    q.s[i] = alpha[i] - dot / p.sy(i, i);
  }
  return q;
}

/// direction_ = the step cut off at the bounds; returns its slope.
double BoundedLbfgs::aim(const Combination& step) {
  const QuadraticPoint& p = *point_;
  for_blocks(p.x.size(), threads_, [&](Index b, Index begin, Index length) {
    Block sum;
    sum.fill(0.0F);
    for (Index i = 0; i < pairs_; ++i) {
      add_two(static_cast<float>(step.s[i]), s_.col(slot(i)).data() + begin, static_cast<float>(step.y[i]),
              y_.col(slot(i)).data() + begin, sum.data(), length);
    }
    sums_(0, b) = aim_block(&p.x[begin], &p.gradient[begin], &lower_[begin], upper_at(begin), &free_[begin],
                            step.gradient, sum.data(), &direction_[begin], length);
  });
  return sum_of_blocks();
}

double BoundedLbfgs::aim_along_gradient() {
  Combination step;
  step.s.setZero();
  step.y.setZero();
  step.gradient = -spectral_length_;
  return aim(step);
}

/// The inverse of the curvature along the projected gradient. False if it is not finite.
bool BoundedLbfgs::find_spectral_length() {
  if (spectral_length_ > 0.0) return true;
  const QuadraticPoint& p = *point_;
  for (Index j = 0; j < p.x.size(); ++j) direction_[j] = static_cast<double>(free_[j]) * p.gradient[j];
  form_->product(direction_, product_);
  const double curvature = direction_.dot(product_);
  if (!std::isfinite(curvature)) return false;
  spectral_length_ = curvature > 0.0 ? direction_.squaredNorm() / curvature : 1.0;
  return std::isfinite(spectral_length_);
}

/// Moves to the minimiser along direction_. False if the product is not finite.
bool BoundedLbfgs::advance(double slope) {
  QuadraticPoint& p = *point_;
  form_->product(direction_, product_);
  for_blocks(p.x.size(), threads_, [&](Index b, Index begin, Index length) {
    const auto d = direction_.segment(begin, length), hd = product_.segment(begin, length);
    sums_(0, b) = d.dot(hd);
    sums_(1, b) = d.squaredNorm();
    sums_(2, b) = hd.squaredNorm();
  });
  const Eigen::Vector3d dots = sums_.topRows<3>().rowwise().sum();
  const double curvature = dots[0];
  if (!dots.allFinite()) return false;
  const bool curved = curvature > kLeastCurvature * std::sqrt(dots[1] * dots[2]);
  // q(x + a d) = q + a slope + a^2 / 2 curvature, and all of [0, 1] is feasible since the bounds are convex.
  const double a = curved ? std::min(1.0, -slope / curvature) : 1.0;
  p.value += a * slope + 0.5 * a * a * curvature;
  // Without curvature the objective falls in a straight line: only a bound ends that, so make for it.
  spectral_length_ = curved ? dots[1] / curvature : std::min(10.0 * spectral_length_, 1e300);
  if (curved) {
    newest_ = (newest_ + 1) % kPairs;
    pairs_ = std::min(pairs_ + 1, kPairs);
  }
  const double scale = curved ? 1.0 / std::sqrt(curvature) : 0.0;
  for_blocks(p.x.size(), threads_, [&](Index, Index begin, Index length) {
    move_block(a, &direction_[begin], &product_[begin], &lower_[begin], upper_at(begin), &p.x[begin],
               &p.gradient[begin], length);
    if (!curved) return;
    scale_block(scale, &direction_[begin], &s_(begin, newest_), length);
    scale_block(scale, &product_[begin], &y_(begin, newest_), length);
  });
  return true;
}

double BoundedLbfgs::sum_of_blocks() const { return sums_.row(0).sum(); }

}  // namespace dwell
