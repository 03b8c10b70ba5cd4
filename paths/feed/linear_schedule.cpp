#include "paths/feed/linear_schedule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "paths/feed/banded_system.h"
#include "paths/feed/least_dwell.h"

namespace dwell {
namespace {

constexpr double kSmooth = 1e-4;  // eps
constexpr double kFirstBarrier = 1e-2, kLastBarrier = 1e-9, kBarrierFalls = 0.25;
constexpr double kToTheBoundary = 0.95;
constexpr double kArmijo = 1e-4;
constexpr int kMostStepsABarrier = 30;
constexpr double kInside = 0.95;         // of the squared speeds that are possible, at the start
constexpr double kFasterThanMean = 1.2;  // squared speed at the start against that of length over dwell

/// Half a move.
struct Piece {
  double length;
  double reach;  // 2 a L: most by which the squared speed changes
  Index stroke;
};

/// The pieces of a chain of moves between two stops: all nodes between are free unless the machine rests there.
class Minimiser {
 public:
  Minimiser(const StrokeMoves& moves, const KinematicPath& path, const Eigen::VectorXd& moving)
      : wanted_(moving), mean_(mean_of(moving)), system_(2 * moves.size() + 1) {
    for (std::size_t i = 0; i < moves.size(); ++i) {
      const KinematicMove& move = path.moves[i];
      const double half = 0.5 * move.length, highest = move.length > 0.0 ? move.max_speed * move.max_speed : 0.0;
      for (int k = 0; k < 2; ++k) pieces_.push_back({half, 2.0 * move.acceleration * half, moves.stroke[i]});
      cap_.push_back(std::min(path.corner[i], i > 0 ? std::min(highest, squared_limit(path, i - 1)) : highest));
      cap_.push_back(highest);
    }
    cap_.push_back(path.corner.back());
    u_.assign(cap_.size(), 0.0);
    for (const double cap : cap_) free_.push_back(static_cast<char>(cap > 0.0));
    start();
  }

  int run() {
    int steps = 0;
    for (barrier_ = kFirstBarrier; barrier_ > kLastBarrier; barrier_ *= kBarrierFalls) {
      for (int k = 0; k < kMostStepsABarrier && take_step(); ++k) ++steps;
    }
    return steps;
  }

  std::vector<double> speeds() const {
    std::vector<double> v;
    for (const double u : u_) v.push_back(std::sqrt(u));
    return v;
  }

  Eigen::VectorXd times() const { return times_of(u_); }

 private:
  static double mean_of(const Eigen::VectorXd& t) { return std::max(t.size() > 0 ? t.mean() : 0.0, 1e-300); }
  static double squared_limit(const KinematicPath& path, std::size_t i) {
    return path.moves[i].max_speed * path.moves[i].max_speed;
  }

  static double time_of(const Piece& piece, double u, double next) {
    return piece.length > 0.0 ? 2.0 * piece.length / (std::sqrt(u) + std::sqrt(next)) : 0.0;
  }

  Eigen::VectorXd times_of(const std::vector<double>& u) const {
    Eigen::VectorXd t = Eigen::VectorXd::Zero(wanted_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i].stroke != StrokeMoves::kNoStroke) t[pieces_[i].stroke] += time_of(pieces_[i], u[i], u[i + 1]);
    }
    return t;
  }

  bool counts(std::size_t i) const { return pieces_[i].length > 0.0; }

  /// Strictly inside: the highest squared speeds, little above those of length over dwell, and a little less.
  void start() {
    std::vector<double> length(static_cast<std::size_t>(wanted_.size()), 0.0);
    for (const Piece& piece : pieces_) {
      if (piece.stroke != StrokeMoves::kNoStroke) length[static_cast<std::size_t>(piece.stroke)] += piece.length;
    }
    u_ = cap_;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Index j = pieces_[i].stroke;
      if (j == StrokeMoves::kNoStroke || !(wanted_[j] > 0.0)) continue;
      const double v = length[static_cast<std::size_t>(j)] / wanted_[j], most = kFasterThanMean * v * v;
      u_[i] = std::min(u_[i], most);
      u_[i + 1] = std::min(u_[i + 1], most);
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (counts(i)) u_[i + 1] = std::min(u_[i + 1], u_[i] + pieces_[i].reach);
    }
    for (std::size_t i = pieces_.size(); i-- > 0;) {
      if (counts(i)) u_[i] = std::min(u_[i], u_[i + 1] + pieces_[i].reach);
    }
    for (double& u : u_) u *= kInside;
  }

  /// The objective with its barriers; infinite outside.
  double value(const std::vector<double>& u) const {
    const Eigen::VectorXd t = times_of(u);
    double sum = ((t - wanted_) / mean_).squaredNorm(), logs = 0.0;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (!counts(i) || !std::isfinite(pieces_[i].reach)) continue;
      const double d = (u[i + 1] - u[i]) / pieces_[i].reach;
      if (!(std::abs(d) < 1.0)) return std::numeric_limits<double>::infinity();
      sum += kSmooth * d * d;
      logs += std::log1p(-d) + std::log1p(d);
    }
    for (std::size_t i = 0; i < u.size(); ++i) {
      if (free_[i] == 0) continue;
      if (!(u[i] > 0.0 && u[i] < cap_[i])) return std::numeric_limits<double>::infinity();
      logs += std::log(u[i] / cap_[i]) + std::log1p(-u[i] / cap_[i]);
    }
    return sum - barrier_ * logs;
  }

  void add_pair(std::size_t i, double gradient, double curvature) {
    gradient_[i + 1] += gradient;
    gradient_[i] -= gradient;
    system_.add(i + 1, 0, curvature);
    system_.add(i, 0, curvature);
    system_.add(i, 1, -curvature);
  }

  /// Gradient and Gauss-Newton matrix at u_.
  void set_up() {
    system_.clear();
    gradient_.assign(u_.size(), 0.0);
    const Eigen::VectorXd residual = (times_of(u_) - wanted_) / mean_;
    for (std::size_t first = 0; first < pieces_.size();) {
      std::size_t last = first + 1;
      while (last < pieces_.size() && pieces_[last].stroke == pieces_[first].stroke &&
             pieces_[first].stroke != StrokeMoves::kNoStroke)
        ++last;
      if (pieces_[first].stroke != StrokeMoves::kNoStroke) add_stroke(first, last, residual[pieces_[first].stroke]);
      first = last;
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const double reach = pieces_[i].reach, d = u_[i + 1] - u_[i];
      if (!counts(i) || !std::isfinite(reach)) continue;
      add_pair(i, 2.0 * kSmooth * d / (reach * reach), 2.0 * kSmooth / (reach * reach));
      const double up = 1.0 / (reach - d), down = 1.0 / (reach + d);
      add_pair(i, barrier_ * (up - down), barrier_ * (up * up + down * down));
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

  /// The derivatives of a stroke's time: -2 L / (v + v')^2 / (2 v) to each end of each piece.
  void add_stroke(std::size_t first, std::size_t last, double residual) {
    std::array<double, BandedSystem::kBeside + 1> row{};
    for (std::size_t i = first; i < last; ++i) {
      if (!counts(i)) continue;
      const double v = std::sqrt(u_[i]), next = std::sqrt(u_[i + 1]), sum = v + next;
      const double common = -pieces_[i].length / (sum * sum) / mean_;
      if (free_[i] != 0) row[i - first] += common / v;
      if (free_[i + 1] != 0) row[i + 1 - first] += common / next;
    }
    for (std::size_t p = 0; p <= last - first; ++p) {
      gradient_[first + p] += 2.0 * residual * row[p];
      for (std::size_t q = p; q <= last - first; ++q) system_.add(first + p, q - p, 2.0 * row[p] * row[q]);
    }
  }

  /// How far along a step the boundary is, times kToTheBoundary, at most 1.
  double longest(const std::vector<double>& step) const {
    double most = 1.0;
    for (std::size_t i = 0; i < u_.size(); ++i) {
      if (free_[i] == 0) continue;
      if (step[i] < 0.0) most = std::min(most, -kToTheBoundary * u_[i] / step[i]);
      if (step[i] > 0.0) most = std::min(most, kToTheBoundary * (cap_[i] - u_[i]) / step[i]);
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const double d = u_[i + 1] - u_[i], change = step[i + 1] - step[i], reach = pieces_[i].reach;
      if (!counts(i) || !std::isfinite(reach)) continue;
      if (change > 0.0) most = std::min(most, kToTheBoundary * (reach - d) / change);
      if (change < 0.0) most = std::min(most, kToTheBoundary * (reach + d) / -change);
    }
    return most;
  }

  /// False when the barrier's minimum is reached.
  bool take_step() {
    set_up();
    std::vector<double> step(gradient_.size());
    for (std::size_t i = 0; i < step.size(); ++i) step[i] = -gradient_[i];
    system_.solve(step);
    double decrease = 0.0;
    for (std::size_t i = 0; i < step.size(); ++i) decrease -= gradient_[i] * step[i];
    if (!(decrease > 1e-3 * barrier_)) return false;
    const double before = value(u_);
    std::vector<double> next(u_.size());
    for (double a = longest(step); a > 1e-12; a *= 0.5) {
      for (std::size_t i = 0; i < next.size(); ++i) next[i] = u_[i] + a * step[i];
      if (!(value(next) <= before - kArmijo * a * decrease)) continue;
      u_.swap(next);
      return true;
    }
    return false;
  }

  const Eigen::VectorXd& wanted_;
  double mean_;
  std::vector<Piece> pieces_;
  std::vector<double> cap_, u_, gradient_;
  std::vector<char> free_;
  BandedSystem system_;
  double barrier_ = 0.0;
};

}  // namespace

LinearSchedule schedule_linear(const StrokeMoves& moves, const KinematicPath& path, const Machine& machine,
                               const Eigen::VectorXd& dwell) {
  const Eigen::VectorXd delays = stop_delays(moves, path, machine);
  Eigen::VectorXd moving = (dwell - delays).cwiseMax(0.0);
  std::vector<char> moves_at_all(static_cast<std::size_t>(moves.strokes), 0);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves.stroke[i] != StrokeMoves::kNoStroke && path.moves[i].length > 0.0)
      moves_at_all[static_cast<std::size_t>(moves.stroke[i])] = 1;
  }
  for (Index j = 0; j < moving.size(); ++j) {
    if (moves_at_all[static_cast<std::size_t>(j)] == 0) moving[j] = 0.0;  // a halt is no matter of speed
  }
  Minimiser minimiser(moves, path, moving);
  LinearSchedule result;
  result.steps = minimiser.run();
  result.speed = minimiser.speeds();
  result.seconds = dwell;
  const Eigen::VectorXd times = minimiser.times();
  for (Index j = 0; j < times.size(); ++j) {
    if (moves_at_all[static_cast<std::size_t>(j)] == 0) continue;
    result.seconds[j] = times[j] + delays[j];
    result.worst_error = std::max(result.worst_error, std::abs(times[j] - moving[j]) / std::max(moving[j], 1e-300));
  }
  return result;
}

}  // namespace dwell
