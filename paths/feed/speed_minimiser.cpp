#include "paths/feed/speed_minimiser.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dwell {
namespace {

constexpr double kSmooth = 1e-4;  // eps
constexpr double kFirstBarrier = 1e-3, kLastBarrier = 1e-9, kBarrierFalls = 0.1;
constexpr double kToTheBoundary = 0.95;
constexpr double kArmijo = 1e-4;
constexpr int kMostStepsABarrier = 30;
constexpr double kInside = 0.05;    // share by which the squared speeds begin below what is possible
constexpr double kOfTheEnds = 0.4;  // of the room that is left at the window's ends, most of it

void take_roots(const std::vector<double>& u, std::vector<double>& v) {
  v.resize(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) v[i] = std::sqrt(u[i]);
}

}  // namespace

int SpeedMinimiser::minimise(SpeedWindow window, std::vector<double>& u, const Progress& progress) {
  take_window(window, u);
  move_inside();
  int steps = 0;
  for (barrier_ = kFirstBarrier; barrier_ > kLastBarrier; barrier_ *= kBarrierFalls) {
    for (int k = 0; k < kMostStepsABarrier && take_step(); ++k, ++steps) progress.check();
  }
  // The ends are another window's as well, which may run beside this one.
  std::copy(u_.begin() + 1, u_.end() - 1, u.begin() + static_cast<std::ptrdiff_t>(window.first) + 1);
  return steps;
}

void SpeedMinimiser::take_window(SpeedWindow window, const std::vector<double>& u) {
  const auto first = static_cast<std::ptrdiff_t>(window.first), last = static_cast<std::ptrdiff_t>(window.last);
  pieces_.assign(nodes_.pieces.begin() + first, nodes_.pieces.begin() + last);
  cap_.assign(nodes_.cap.begin() + first, nodes_.cap.begin() + last + 1);
  u_.assign(u.begin() + first, u.begin() + last + 1);
  free_.clear();
  for (const double cap : cap_) free_.push_back(static_cast<char>(cap > 0.0));
  free_.front() = free_.back() = 0;
  system_ = BandedSystem(u_.size());
  gradient_.resize(u_.size());
  step_.resize(u_.size());
  next_.resize(u_.size());
  strokes_.clear();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Index j = pieces_[i].stroke;
    if (j == StrokeMoves::kNoStroke || !pieces_[i].counts()) continue;
    if (strokes_.empty() || pieces_[strokes_.back().first].stroke != j) strokes_.push_back({i, i + 1, dwell_[j]});
    strokes_.back().last = i + 1;
  }
}

/// What holds all limits is moved off them: free speeds are lowered by a share, at most by as much as the pieces at the
/// ends, whose outer speeds stay, leave room for.
void SpeedMinimiser::move_inside() {
  double share = kInside;
  const auto keep_room = [&](std::size_t outer, std::size_t inner, const SpeedPiece& piece) {
    if (!piece.counts() || free_[inner] == 0 || !std::isfinite(piece.reach)) return;
    const double room = piece.reach + u_[inner] - u_[outer];
    share = std::min(share, kOfTheEnds * room / std::max(u_[inner], 1e-300));
  };
  const std::size_t n = pieces_.size();
  if (cap_.front() > 0.0) keep_room(0, 1, pieces_.front());
  if (cap_.back() > 0.0) keep_room(n, n - 1, pieces_.back());
  for (std::size_t i = 0; i < u_.size(); ++i) {
    if (free_[i] != 0) u_[i] *= 1.0 - share;
  }
}

/// (t - T) / mean(T) of a stroke.
double SpeedMinimiser::error_of(const Stroke& stroke, const std::vector<double>& v) const {
  double seconds = 0.0;
  for (std::size_t i = stroke.first; i < stroke.last; ++i) seconds += 2.0 * pieces_[i].length / (v[i] + v[i + 1]);
  return (seconds - stroke.wanted) / mean_;
}

/// The objective with its barriers; infinite outside.
double SpeedMinimiser::value(const std::vector<double>& u) {
  constexpr double kOutside = std::numeric_limits<double>::infinity();
  double sum = 0.0, product = 1.0, logs = 0.0;
  const auto add_log = [&](double factor) {  // logarithms of products, as long as these are in range: fewer calls
    product *= factor;
    if (product > 1e-200) return;
    logs += std::log(product);
    product = 1.0;
  };
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (!pieces_[i].counts() || !std::isfinite(pieces_[i].reach)) continue;
    const double d = (u[i + 1] - u[i]) / pieces_[i].reach;
    if (!(std::abs(d) < 1.0)) {
      if (free_[i] == 0 && free_[i + 1] == 0) continue;
      return kOutside;
    }
    sum += kSmooth * d * d;
    add_log((1.0 - d) * (1.0 + d));
  }
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (free_[i] == 0) continue;
    const double share = u[i] / cap_[i];
    if (!(share > 0.0 && share < 1.0)) return kOutside;
    add_log(share);
    add_log(1.0 - share);
  }
  take_roots(u, root_);
  for (const Stroke& stroke : strokes_) {
    const double error = error_of(stroke, root_);
    sum += error * error;
  }
  return sum - barrier_ * (logs + std::log(product));
}

void SpeedMinimiser::add_pair(std::size_t i, double gradient, double curvature) {
  gradient_[i + 1] += gradient;
  gradient_[i] -= gradient;
  system_.add(i + 1, 0, curvature);
  system_.add(i, 0, curvature);
  system_.add(i, 1, -curvature);
}

/// The derivatives of a stroke's time: -2 L / (v + v')^2 / (2 v) to each end of each piece.
void SpeedMinimiser::add_stroke(const Stroke& stroke, const std::vector<double>& v) {
  const double residual = error_of(stroke, v);
  std::array<double, BandedSystem::kBeside + 1> row{};
  for (std::size_t i = stroke.first; i < stroke.last; ++i) {
    const double sum = v[i] + v[i + 1], common = -pieces_[i].length / (sum * sum) / mean_;
    if (free_[i] != 0) row[i - stroke.first] += common / v[i];
    if (free_[i + 1] != 0) row[i + 1 - stroke.first] += common / v[i + 1];
  }
  const std::size_t size = stroke.last - stroke.first;
  for (std::size_t p = 0; p <= size; ++p) {
    gradient_[stroke.first + p] += 2.0 * residual * row[p];
    for (std::size_t q = p; q <= size; ++q) system_.add(stroke.first + p, q - p, 2.0 * row[p] * row[q]);
  }
}

/// Gradient and Gauss-Newton matrix at u_.
void SpeedMinimiser::set_up() {
  system_.clear();
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  take_roots(u_, root_);
  for (const Stroke& stroke : strokes_) add_stroke(stroke, root_);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const double reach = pieces_[i].reach, d = u_[i + 1] - u_[i];
    if (!pieces_[i].counts() || !std::isfinite(reach) || (free_[i] == 0 && free_[i + 1] == 0)) continue;
    const double smooth = 2.0 * kSmooth / (reach * reach);
    const double up = 1.0 / (reach - d), down = 1.0 / (reach + d);
    add_pair(i, smooth * d + barrier_ * (up - down), smooth + barrier_ * (up * up + down * down));
  }
  for (std::size_t i = 0; i < u_.size(); ++i) {
    if (free_[i] == 0) {
      gradient_[i] = 0.0;
      system_.fix(i);
      continue;
    }
    const double low = 1.0 / u_[i], high = 1.0 / (cap_[i] - u_[i]);
    gradient_[i] += barrier_ * (high - low);
    system_.add(i, 0, barrier_ * (low * low + high * high));
  }
}

/// How far along a step the boundary is, times kToTheBoundary, at most 1.
double SpeedMinimiser::longest(const std::vector<double>& step) const {
  double most = 1.0;
  for (std::size_t i = 0; i < u_.size(); ++i) {
    if (free_[i] == 0) continue;
    if (step[i] < 0.0) most = std::min(most, -kToTheBoundary * u_[i] / step[i]);
    if (step[i] > 0.0) most = std::min(most, kToTheBoundary * (cap_[i] - u_[i]) / step[i]);
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const double d = u_[i + 1] - u_[i], change = step[i + 1] - step[i], reach = pieces_[i].reach;
    if (!pieces_[i].counts() || !std::isfinite(reach)) continue;
    if (change > 0.0) most = std::min(most, kToTheBoundary * (reach - d) / change);
    if (change < 0.0) most = std::min(most, kToTheBoundary * (reach + d) / -change);
  }
  return most;
}

/// False when the barrier's minimum is reached.
bool SpeedMinimiser::take_step() {
  set_up();
  for (std::size_t i = 0; i < step_.size(); ++i) step_[i] = -gradient_[i];
  system_.solve(step_);
  double decrease = 0.0;
  for (std::size_t i = 0; i < step_.size(); ++i) decrease -= gradient_[i] * step_[i];
  if (!(decrease > 1e-3 * barrier_)) return false;
  const double before = value(u_);
  for (double a = longest(step_); a > 1e-12; a *= 0.5) {
    for (std::size_t i = 0; i < next_.size(); ++i) next_[i] = u_[i] + a * step_[i];
    if (!(value(next_) <= before - kArmijo * a * decrease)) continue;
    u_.swap(next_);
    return true;
  }
  return false;
}

}  // namespace dwell
