#include "paths/feed/constant_schedule.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "paths/feed/least_dwell.h"
#include "paths/feed/lift_rests.h"
#include "paths/feed/look_ahead.h"
#include "paths/feed/trapezoid.h"

namespace dwell {
namespace {

constexpr std::size_t kMovesOfABlock = 48;  // about; in the last rounds little changes, and in few places
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

/// Blocks of moves that end where strokes do.
std::vector<std::size_t> blocks_of(const StrokeMoves& moves) {
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const bool in_stroke = i > 0 && moves.stroke[i] != StrokeMoves::kNoStroke && moves.stroke[i - 1] == moves.stroke[i];
    if (begins.empty() || (!in_stroke && i - begins.back() >= kMovesOfABlock)) begins.push_back(i);
  }
  return begins;
}

class Scheduling {
 public:
  Scheduling(const StrokeMoves& moves, const KinematicPath& path, const Eigen::VectorXd& wanted)
      : moves_(moves),
        path_(path),
        wanted_(wanted),
        ranges_(moves_of_strokes(moves)),
        at_rest_(ranges_.size(), 0),
        ahead_(path, blocks_of(moves)) {
    for_strokes([&](std::size_t block, std::size_t j) {
      const double length = length_of(j);
      if (length > 0.0) set_feed(block, j, std::min(most(j), length / std::max(seconds(j), 1e-300)));
    });
  }

  int run() {
    for (int round = 1; round <= kMostRounds; ++round) {
      ahead_.update();
      double change = 0.0;
      for_strokes([&](std::size_t block, std::size_t j) {
        if (at_rest_[j] != 0 && same_ends(j)) return;
        if (!(length_of(j) > 0.0)) return;
        const double was = ahead_.feed(ranges_[j].first);
        double next = feed_for_time(trapezoids(j), seconds(j), most(j));
        if (round > kUndampedRounds) next = 0.5 * (was + next);
        const double moved = std::abs(next - was) / next;
        at_rest_[j] = static_cast<char>(moved <= kAtRest);
        if (moved > kAtRest) set_feed(block, j, next);
        change = std::max(change, moved);
      });
      if (change <= kAtRest) return round;
    }
    return kMostRounds;
  }

  ConstantSchedule schedule() {
    ahead_.update();
    ConstantSchedule result;
    result.seconds = wanted_;
    result.feed.assign(ranges_.size(), 0.0);
    for (std::size_t j = 0; j < ranges_.size(); ++j) {
      if (!(length_of(j) > 0.0)) continue;
      const double feed = ahead_.feed(ranges_[j].first);
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
  /// The strokes of blocks through which the last update went, or of all before the first.
  template <class Action>
  void for_strokes(const Action& action) {
    for (std::size_t b = 0; b < ahead_.blocks(); ++b) {
      if (begun_ && !ahead_.touched(b)) continue;
      Index before = StrokeMoves::kNoStroke;
      for (std::size_t i = ahead_.begin_of(b); i < ahead_.end_of(b); ++i) {
        const Index j = moves_.stroke[i];
        if (j != StrokeMoves::kNoStroke && j != before) action(b, static_cast<std::size_t>(j));
        before = j;
      }
    }
    begun_ = true;
  }
  /// Whether the last update changed no speed at a stroke's nodes.
  bool same_ends(std::size_t j) const {
    for (std::size_t node = ranges_[j].first; node <= ranges_[j].last; ++node) {
      if (ahead_.changed(node)) return false;
    }
    return true;
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
  void set_feed(std::size_t block, std::size_t j, double feed) {
    for (std::size_t i = ranges_[j].first; i < ranges_[j].last; ++i) ahead_.set_feed(block, i, feed);
  }
  const std::vector<Trapezoid>& trapezoids(std::size_t j) {
    scratch_.clear();
    const std::vector<double>& u = ahead_.squared();
    for (std::size_t i = ranges_[j].first; i < ranges_[j].last; ++i) {
      if (path_.arcs.empty()) {
        scratch_.push_back({path_.moves[i].length, path_.moves[i].acceleration, std::sqrt(u[i]), std::sqrt(u[i + 1]),
                            std::numeric_limits<double>::infinity(), path_.moves[i].jerk});
        continue;
      }
      move_parts(path_, i, ahead_.feed(i), u[i], u[i + 1]).for_each([this](const Trapezoid& part, std::size_t) {
        scratch_.push_back(part);
      });
    }
    return scratch_;
  }

  const StrokeMoves& moves_;
  const KinematicPath& path_;
  const Eigen::VectorXd& wanted_;
  std::vector<Range> ranges_;
  std::vector<char> at_rest_;  // strokes whose feed no longer changes
  LookAhead ahead_;
  bool begun_ = false;
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
