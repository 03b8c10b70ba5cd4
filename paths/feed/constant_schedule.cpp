#include "paths/feed/constant_schedule.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "paths/feed/least_dwell.h"
#include "paths/feed/lift_rests.h"
#include "paths/feed/trapezoid.h"

namespace dwell {
namespace {

constexpr int kMostRounds = 60;
constexpr int kUndampedRounds = 5;
constexpr double kAtRest = 1e-10;   // of the feeds
constexpr int kMostPaths = 10;      // whose arcs are those of the feeds found on the one before
constexpr double kSamePath = 1e-6;  // of the feeds

/// The moves of one stroke: [first, last).
struct Range {
  std::size_t first, last;
};

/// The strokes' moves with a length; they are consecutive.
std::vector<Range> moves_of_strokes(const StrokeMoves& moves) {
  std::vector<Range> ranges(static_cast<std::size_t>(moves.strokes), Range{0, 0});
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves.stroke[i] == StrokeMoves::kNoStroke) continue;
    Range& range = ranges[static_cast<std::size_t>(moves.stroke[i])];
    if (range.last == 0) range.first = i;
    range.last = i + 1;
  }
  return ranges;
}

class Scheduling {
 public:
  Scheduling(const StrokeMoves& moves, const KinematicPath& path, const Eigen::VectorXd& wanted)
      : path_(path), wanted_(wanted), ranges_(moves_of_strokes(moves)), at_rest_(ranges_.size(), 0) {
    for (const KinematicMove& move : path.moves) feed_.push_back(move.max_speed);
    for (std::size_t j = 0; j < ranges_.size(); ++j) {
      const double length = length_of(j);
      if (length > 0.0) set_feed(j, std::min(most(j), length / std::max(seconds(j), 1e-300)));
    }
  }

  int run() {
    for (int round = 1; round <= kMostRounds; ++round) {
      const std::vector<double> before = std::exchange(u_, node_speeds_squared(path_, feed_));
      double change = 0.0;
      for (std::size_t j = 0; j < ranges_.size(); ++j) {
        if (!(length_of(j) > 0.0) || (at_rest_[j] != 0 && same_ends(j, before))) continue;
        const double was = feed_[ranges_[j].first];
        double next = feed_for_time(trapezoids(j), seconds(j), most(j));
        if (round > kUndampedRounds) next = 0.5 * (was + next);
        set_feed(j, next);
        const double moved = std::abs(next - was) / next;
        at_rest_[j] = static_cast<char>(moved <= kAtRest);
        change = std::max(change, moved);
      }
      if (change <= kAtRest) return round;
    }
    return kMostRounds;
  }

  ConstantSchedule schedule() {
    u_ = node_speeds_squared(path_, feed_);
    ConstantSchedule result;
    result.seconds = wanted_;
    result.feed.assign(ranges_.size(), 0.0);
    for (std::size_t j = 0; j < ranges_.size(); ++j) {
      if (!(length_of(j) > 0.0)) continue;
      const double feed = feed_[ranges_[j].first];
      result.feed[j] = feed;
      double taken = 0.0;
      for (const Trapezoid& move : trapezoids(j)) taken += time_at_feed(move, feed);
      result.seconds[static_cast<Index>(j)] = taken;
      const double error = (taken - seconds(j)) / seconds(j);
      constexpr double kHeld = 1e-6;
      if (error > kHeld && feed >= most(j)) {
        ++result.too_short;
      } else {
        result.worst_error = std::max(result.worst_error, std::abs(error));
      }
    }
    return result;
  }

 private:
  double seconds(std::size_t j) const { return wanted_[static_cast<Index>(j)]; }
  /// Whether the speeds at a stroke's nodes are those of the round before.
  bool same_ends(std::size_t j, const std::vector<double>& before) const {
    return std::equal(u_.begin() + static_cast<std::ptrdiff_t>(ranges_[j].first),
                      u_.begin() + static_cast<std::ptrdiff_t>(ranges_[j].last) + 1,
                      before.begin() + static_cast<std::ptrdiff_t>(ranges_[j].first));
  }
  double length_of(std::size_t j) const {
    double sum = 0.0;
    for (std::size_t i = ranges_[j].first; i < ranges_[j].last; ++i) sum += path_.moves[i].length;
    return sum;
  }
  double most(std::size_t j) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = ranges_[j].first; i < ranges_[j].last; ++i) least = std::min(least, path_.moves[i].max_speed);
    return least;
  }
  void set_feed(std::size_t j, double feed) {
    for (std::size_t i = ranges_[j].first; i < ranges_[j].last; ++i) feed_[i] = feed;
  }
  const std::vector<Trapezoid>& trapezoids(std::size_t j) {
    scratch_.clear();
    for (std::size_t i = ranges_[j].first; i < ranges_[j].last; ++i) {
      if (path_.arcs.empty()) {
        scratch_.push_back({path_.moves[i].length, path_.moves[i].acceleration, std::sqrt(u_[i]), std::sqrt(u_[i + 1]),
                            std::numeric_limits<double>::infinity(), path_.moves[i].jerk});
        continue;
      }
      move_parts(path_, i, feed_[i], u_[i], u_[i + 1]).for_each([this](const Trapezoid& part, std::size_t) {
        scratch_.push_back(part);
      });
    }
    return scratch_;
  }

  const KinematicPath& path_;
  const Eigen::VectorXd& wanted_;
  std::vector<Range> ranges_;
  std::vector<char> at_rest_;     // strokes whose feed no longer changes
  std::vector<double> feed_, u_;  // of every move, of every node
  std::vector<Trapezoid> scratch_;
};

}  // namespace

ConstantSchedule schedule_constant(const StrokeMoves& moves, const KinematicPath& path, const Machine& machine,
                                   const Eigen::VectorXd& dwell) {
  const Eigen::VectorXd delays = rests_of_strokes(moves, path, machine), moving = (dwell - delays).cwiseMax(0.0);
  Scheduling scheduling(moves, path, moving);
  const int rounds = scheduling.run();
  ConstantSchedule result = scheduling.schedule();
  result.rounds = rounds;
  result.seconds += delays;
  result.halt.reserve(result.feed.size());
  for (Index j = 0; j < dwell.size(); ++j) result.halt.push_back(commanded_halt(dwell[j], delays[j]));
  return result;
}

ConstantSchedule schedule_blended(const StrokeMoves& moves, const Machine& machine, double max_feed,
                                  const Eigen::VectorXd& dwell) {
  std::vector<ProgramStep> steps = moves.steps;
  ConstantSchedule result = schedule_constant(moves, kinematic_path(steps, machine, max_feed), machine, dwell);
  if (machine.corner != CornerRule::Blend || machine.blend_size != BlendSize::AsNeeded) return result;
  for (int round = 1; round <= kMostPaths; ++round) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double feed =
          moves.stroke[i] == StrokeMoves::kNoStroke ? 0.0 : result.feed[static_cast<std::size_t>(moves.stroke[i])];
      steps[i].seconds = feed > 0.0 ? steps[i].length() / feed : 0.0;
    }
    const std::vector<double> before = std::exchange(result.feed, {});
    result = schedule_constant(moves, kinematic_path(steps, machine, max_feed), machine, dwell);
    double change = 0.0;
    for (std::size_t j = 0; j < before.size(); ++j)
      change = std::max(change, std::abs(result.feed[j] - before[j]) / std::max(result.feed[j], 1e-300));
    if (change <= kSamePath) break;
  }
  return result;
}

}  // namespace dwell
