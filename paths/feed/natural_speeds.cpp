#include "paths/feed/natural_speeds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dwell {
namespace {

constexpr double kHeld = 1e-9;     // relative
constexpr double kSlowest = 0.05;  // of its mean speed, how slow a stroke begins that its ends are too fast for

/// Lowers squared speeds until none is out of reach of its neighbours.
void keep_reach(const SpeedNodes& nodes, std::vector<double>& u) {
  const std::size_t n = nodes.pieces.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (nodes.pieces[i].counts()) u[i + 1] = std::min(u[i + 1], u[i] + nodes.pieces[i].reach);
  }
  for (std::size_t i = n; i-- > 0;) {
    if (nodes.pieces[i].counts()) u[i] = std::min(u[i], u[i + 1] + nodes.pieces[i].reach);
  }
}

class Natural {
 public:
  Natural(const SpeedNodes& nodes, const std::vector<StrokePieces>& strokes, const Eigen::VectorXd& dwell)
      : nodes_(nodes), strokes_(strokes), dwell_(dwell), result_{nodes.cap, {}} {}

  NaturalSpeeds find() {
    std::vector<double>& u = result_.u;
    for (std::size_t j = 0; j < strokes_.size(); ++j) set_ends(j);
    keep_reach(nodes_, u);  // with middle nodes as fast as can be: only the ends are held here
    for (std::size_t j = 0; j < strokes_.size(); ++j) set_middle(j);
    keep_reach(nodes_, u);
    for (std::size_t j = 0; j < strokes_.size(); ++j) result_.holds.push_back(static_cast<char>(holds(j)));
    return std::move(result_);
  }

 private:
  double mean_speed(std::size_t j) const {
    const double seconds = dwell_[static_cast<Index>(j)];
    return seconds > 0.0 ? strokes_[j].length / seconds : std::numeric_limits<double>::infinity();
  }

  bool joined(std::size_t j, std::size_t next) const {
    return strokes_[j].length > 0.0 && strokes_[next].length > 0.0 && strokes_[j].last == strokes_[next].first;
  }

  void set_ends(std::size_t j) {
    if (j + 1 == strokes_.size() || !joined(j, j + 1)) return;
    const double v = 0.5 * (mean_speed(j) + mean_speed(j + 1));
    double& u = result_.u[strokes_[j].last];
    u = std::min(u, v * v);
  }

  /// d (time of a stroke) for one speed x of its inner nodes, as far as their caps allow, and the time itself.
  double time_at(std::size_t j, double x, double& slope) const {
    double seconds = 0.0;
    slope = 0.0;
    const auto speed = [&](std::size_t node, bool& free) {
      const bool inner = node > strokes_[j].first && node < strokes_[j].last;
      const double most = std::sqrt(inner ? nodes_.cap[node] : result_.u[node]);
      free = inner && x < most;
      return free ? x : most;
    };
    for (std::size_t i = strokes_[j].first; i < strokes_[j].last; ++i) {
      bool begins = false, ends = false;
      const double sum = speed(i, begins) + speed(i + 1, ends), time = 2.0 * nodes_.pieces[i].length / sum;
      seconds += time;
      slope -= time / sum * (static_cast<double>(begins) + static_cast<double>(ends));
    }
    return seconds;
  }

  /// Of the inner nodes no more is needed than: all speeds at most v and that of the middle at most x make the stroke
  /// last at least 2 length / (v + x).
  double middle_at_least(std::size_t j) const {
    const double mean = mean_speed(j);
    const double ends = std::sqrt(std::max(result_.u[strokes_[j].first], result_.u[strokes_[j].last]));
    return std::clamp(2.0 * mean - ends, kSlowest * mean, mean);
  }

  void set_middle(std::size_t j) {
    const double wanted = dwell_[static_cast<Index>(j)];
    if (!(strokes_[j].length > 0.0) || !(wanted > 0.0)) return;
    // The time falls with x and is convex in it: from below, Newton's steps do not overshoot.
    double x = middle_at_least(j);
    for (int step = 0; step < 60; ++step) {
      double slope = 0.0;
      const double excess = time_at(j, x, slope) - wanted;
      if (excess <= 1e-12 * wanted || !(slope < 0.0)) break;  // there, or as fast as the caps allow
      x -= excess / slope;
    }
    for (std::size_t node = strokes_[j].first + 1; node < strokes_[j].last; ++node)
      result_.u[node] = std::min(nodes_.cap[node], x * x);
  }

  bool holds(std::size_t j) const {
    if (!(strokes_[j].length > 0.0)) return true;
    double seconds = 0.0;
    for (std::size_t i = strokes_[j].first; i < strokes_[j].last; ++i)
      seconds += time_between(nodes_.pieces[i], result_.u[i], result_.u[i + 1]);
    return std::abs(seconds - dwell_[static_cast<Index>(j)]) <= kHeld * dwell_[static_cast<Index>(j)];
  }

  const SpeedNodes& nodes_;
  const std::vector<StrokePieces>& strokes_;
  const Eigen::VectorXd& dwell_;
  NaturalSpeeds result_;
};

}  // namespace

std::vector<StrokePieces> pieces_of_strokes(const SpeedNodes& nodes, Index strokes) {
  std::vector<StrokePieces> result(static_cast<std::size_t>(strokes));
  for (std::size_t i = 0; i < nodes.pieces.size(); ++i) {
    const SpeedPiece& piece = nodes.pieces[i];
    if (piece.stroke == StrokeMoves::kNoStroke) continue;
    StrokePieces& stroke = result[static_cast<std::size_t>(piece.stroke)];
    if (stroke.last == 0) stroke.first = i;
    stroke.last = i + 1;
    stroke.length += piece.length;
  }
  return result;
}

NaturalSpeeds natural_speeds(const SpeedNodes& nodes, const std::vector<StrokePieces>& strokes,
                             const Eigen::VectorXd& dwell) {
  return Natural(nodes, strokes, dwell).find();
}

}  // namespace dwell
