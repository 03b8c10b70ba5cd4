#include "solvers/native/bounded_quadratic.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dwell {
namespace {

// Conjugate gradients on a face end when a step gains less than this share of the best one of the run: the set of
// active bounds is then likely to be wrong, and products are better spent on finding the next one. Once a run meets no
// bound, the share shrinks.
constexpr double kFirstShare = 0.05;
constexpr double kLeastShare = 1e-6;
constexpr long kFirstLimit = 50;
constexpr long kLargestLimit = 400;
constexpr int kSpectralSteps = 3;  // per face

}  // namespace

double projected_gradient_norm(const Vector& lower, const Vector& upper, const QuadraticPoint& p) {
  double sum = 0.0;
  for (Index j = 0; j < p.x.size(); ++j) {
    const double g = p.gradient[j];
    const bool pushed_out = (p.x[j] <= lower[j] && g > 0.0) || (upper.size() != 0 && p.x[j] >= upper[j] && g < 0.0);
    if (!pushed_out) sum += g * g;
  }
  return std::sqrt(sum);
}

BoundedCg::BoundedCg(const Vector& lower, const Vector& upper)
    : lower_(lower), upper_(upper), free_(static_cast<std::size_t>(lower.size()), 0) {
  for (Vector* v : {&direction_, &product_, &step_, &step_product_, &descent_}) v->resize(lower.size());
}

double BoundedCg::Segment::best_step() const {
  // q(x + a d) = q + a slope + a^2 / 2 curvature, and all of [0, 1] is feasible since the bounds are convex.
  return curvature > 0.0 ? std::clamp(-slope / curvature, 0.0, 1.0) : 1.0;
}

double BoundedCg::upper_at(Index j) const {
  return upper_.size() != 0 ? upper_[j] : std::numeric_limits<double>::infinity();
}

void BoundedCg::clip(Vector& x) const {
  x = x.cwiseMax(lower_);
  if (upper_.size() != 0) x = x.cwiseMin(upper_);
}

bool BoundedCg::multiply(const Vector& d, Vector& hd) {
  form_->product(d, hd);
  ++products_;
  return hd.allFinite();
}

void BoundedCg::move(const Segment& s, double step) {
  point_->x += step * s.direction;
  clip(point_->x);  // rounding only
  point_->gradient += step * s.product;
  point_->value += step * s.slope + 0.5 * step * step * s.curvature;
}

void BoundedCg::minimise(QuadraticForm& form, double tolerance, QuadraticPoint& point, const Monitor& go_on) {
  form_ = &form;
  point_ = &point;
  go_on_ = &go_on;
  tolerance_ = tolerance;
  running_ = true;
  cg_share_ = kFirstShare;
  cg_limit_ = kFirstLimit;
  face_unchanged_ = false;
  while (running_ && projected_gradient_norm(lower_, upper_, point) > tolerance) {
    const long before = products_;
    if (!face_unchanged_) {
      for (int k = 0; k < kSpectralSteps && running_; ++k) {
        if (!spectral_step()) return;
      }
    }
    if (running_) minimise_on_face();
    if (products_ == before) return;  // nothing left to try
  }
}

/// One step of the spectral projected-gradient method (Birgin, Martinez, Raydan 2000) with the exact minimiser along
/// the feasible segment. False if nothing descends.
bool BoundedCg::spectral_step() {
  QuadraticPoint& p = *point_;
  if (!(spectral_length_ > 0.0)) {
    if (!multiply(p.gradient, product_)) return false;
    const double curvature = p.gradient.dot(product_);
    spectral_length_ = curvature > 0.0 ? p.gradient.squaredNorm() / curvature : 1.0;
  }
  direction_ = p.x - spectral_length_ * p.gradient;
  clip(direction_);
  direction_ -= p.x;
  const double slope = p.gradient.dot(direction_);
  if (!(slope < 0.0) || !multiply(direction_, product_)) return false;
  const Segment segment{direction_, product_, slope, direction_.dot(product_)};
  if (!(segment.curvature > 0.0) && !direction_.allFinite()) return false;
  move(segment, segment.best_step());
  // Without curvature the objective falls in a straight line: only a bound ends that, so make for it.
  spectral_length_ =
      segment.curvature > 0.0 ? direction_.squaredNorm() / segment.curvature : std::min(10.0 * spectral_length_, 1e300);
  running_ = (*go_on_)(p);
  return true;
}

/// Marks the variables that may move; returns how many marks changed.
Index BoundedCg::mark_free() {
  Index changed = 0;
  for (Index j = 0; j < lower_.size(); ++j) {
    const double x = point_->x[j], g = point_->gradient[j];
    const bool held = (x <= lower_[j] && g >= 0.0) || (x >= upper_at(j) && g <= 0.0);
    char& mark = free_[static_cast<std::size_t>(j)];
    changed += mark != static_cast<char>(!held);
    mark = static_cast<char>(!held);
  }
  return changed;
}

void BoundedCg::mask(Vector& v) const {
  for (Index j = 0; j < v.size(); ++j) {
    if (!free_[static_cast<std::size_t>(j)]) v[j] = 0.0;
  }
}

/// Conjugate gradients over the free variables, as if there were no bounds, then the projected search.
void BoundedCg::minimise_on_face() {
  mark_free();
  descent_ = -point_->gradient;
  mask(descent_);
  direction_ = descent_;
  step_.setZero();
  step_product_.setZero();
  double rho = descent_.squaredNorm(), best_decrease = 0.0;
  for (long k = 0; k < cg_limit_ && descent_.squaredNorm() > 0.01 * tolerance_ * tolerance_ && rho > 0.0 && running_;
       ++k) {
    if (!multiply(direction_, product_)) break;
    const double curvature = direction_.dot(product_);
    if (!(curvature > 0.0)) break;
    const double a = rho / curvature;
    step_ += a * direction_;
    step_product_ += a * product_;
    mask(product_);
    descent_ -= a * product_;
    const double next = descent_.squaredNorm();
    direction_ = descent_ + (next / rho) * direction_;
    const double decrease = 0.5 * a * rho;
    rho = next;
    best_decrease = std::max(best_decrease, decrease);
    running_ = (*go_on_)(*point_);
    if (decrease <= cg_share_ * best_decrease) break;
  }
  if (first_bound() >= 1.0) {
    take_whole_step();
  } else if (running_) {
    face_unchanged_ = false;
    if (!search()) running_ = false;
  } else {
    take_first_stretch();  // stopped: do nothing that costs a product
  }
}

void BoundedCg::take_first_stretch() {
  move({step_, step_product_, point_->gradient.dot(step_), step_.dot(step_product_)}, first_bound());
}

/// How far along step_ the first bound is met, at most 1.
double BoundedCg::first_bound() const {
  double first = 1.0;
  for (Index j = 0; j < step_.size(); ++j) {
    if (step_[j] < 0.0) first = std::min(first, (lower_[j] - point_->x[j]) / step_[j]);
    if (step_[j] > 0.0) first = std::min(first, (upper_at(j) - point_->x[j]) / step_[j]);
  }
  return std::max(first, 0.0);
}

void BoundedCg::take_whole_step() {
  const bool moved = !step_.isZero(0.0);  // false where there is a gradient but no curvature
  move({step_, step_product_, point_->gradient.dot(step_), step_.dot(step_product_)}, 1.0);
  face_unchanged_ = mark_free() == 0 && moved;
  cg_share_ = std::max(cg_share_ * 0.1, kLeastShare);
  cg_limit_ = std::min<long>(cg_limit_ * 2, kLargestLimit);
}

/// Moves along the projected path of step_, halving; the first stretch, up to the first bound met, always descends and
/// costs no product.
bool BoundedCg::search() {
  const double first = first_bound();
  for (double s = 1.0; s > first && s > 1e-12; s *= 0.5) {
    direction_ = point_->x + s * step_;
    clip(direction_);
    direction_ -= point_->x;
    const double slope = point_->gradient.dot(direction_);
    if (!(slope < 0.0)) continue;
    if (!multiply(direction_, product_)) return false;
    const Segment segment{direction_, product_, slope, direction_.dot(product_)};
    const double a = segment.best_step();
    const bool enough = a >= 0.5 || s * 0.5 <= first;
    if (enough) move(segment, a);
    const bool go_on = (*go_on_)(*point_);
    running_ = running_ && go_on;
    if (enough || !running_) return true;
  }
  take_first_stretch();
  return true;
}

}  // namespace dwell
