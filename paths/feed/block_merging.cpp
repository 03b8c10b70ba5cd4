#include "paths/feed/block_merging.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "paths/feed/stroke_moves.h"

namespace dwell {
namespace {

constexpr double kStraight = 1e-4;     // [rad] of turn that is none
constexpr double kRoundedEnds = 4e-6;  // [mm] by which coordinates turn a move
constexpr double kAtCorner = 2.0;      // blocks from a corner to the next point: half of the way is the corner's
constexpr double kAtEnd = 1.5;         // blocks from the end of a stretch to the second point: one is the first's

/// A move at work: where it ends, how long it is, how many blocks it is worth (at most one).
struct WorthMove {
  Point finish;
  double length, worth;
};

/// Straight on from one corner, or end of a stretch, to the next.
struct StraightRun {
  Point start;
  std::vector<WorthMove> moves;

  Point finish() const { return moves.back().finish; }
  double worth() const {
    double sum = 0.0;
    for (const WorthMove& move : moves) sum += move.worth;
    return sum;
  }
  /// The place that is worth so many blocks from the start.
  Point at(double worth) const {
    Point from = start;
    for (const WorthMove& move : moves) {
      if (worth < move.worth) return from + (worth / move.worth) * (move.finish - from);
      worth -= move.worth;
      from = move.finish;
    }
    return from;
  }
};

bool goes_straight_on(const StraightRun& run, Point to) {
  const Point a = run.finish() - run.start, b = to - run.finish();
  const double turn = std::atan2(std::abs(a.x * b.y - a.y * b.x), dot(a, b));
  return turn <= kStraight + kRoundedEnds * (1.0 / length(a) + 1.0 / length(b));
}

/// Points between the ends of a run: as many as leave every block its worth, spread evenly.
std::vector<Point> points_within(const StraightRun& run, double first_gap, double last_gap) {
  const double worth = run.worth();
  std::vector<Point> points;
  if (worth < first_gap + last_gap) return points;
  const double between = std::floor(worth - first_gap - last_gap);
  const double scale = worth / (first_gap + last_gap + between);
  for (double k = 0.0; k <= between; ++k) points.push_back(run.at(scale * (first_gap + k)));
  return points;
}

/// Dwell points of a stretch whose strokes are cut where these runs turn: moving_strokes reaches half a way beyond its
/// first and last point.
std::vector<Point> points_of_stretch(const std::vector<StraightRun>& runs) {
  std::vector<Point> points;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const bool first = r == 0, last = r + 1 == runs.size();
    for (const Point p : points_within(runs[r], first ? kAtEnd : kAtCorner, last ? kAtEnd : kAtCorner))
      points.push_back(p);
    if (!last) points.push_back(runs[r].finish());
  }
  const Point begin = runs.front().start, end = runs.back().finish();
  if (points.empty()) return {begin + 0.25 * (end - begin), begin + 0.75 * (end - begin)};
  const Point before = begin + (1.0 / 3.0) * (points.front() - begin),
              after = end + (1.0 / 3.0) * (points.back() - end);
  points.insert(points.begin(), before);
  points.push_back(after);
  return points;
}

class Merging {
 public:
  Merging(const ToolPath& path, const Eigen::VectorXd& seconds, double least)
      : path_(path), seconds_(seconds), least_(least), moves_(stroke_moves(path, Motion::Moving)) {}

  MergedPath merge() {
    result_.path.kind = path_.kind;
    result_.path.notes = path_.notes;
    for (std::size_t i = 0; i < moves_.size();) {
      if (moves_.stroke[i] == StrokeMoves::kNoStroke) {
        ++i;
        continue;
      }
      std::size_t end = i;
      while (end < moves_.size() && moves_.stroke[end] != StrokeMoves::kNoStroke) ++end;
      add_stretch(i, end);
      i = end;
    }
    result_.blocks_after = blocks_of(stroke_moves(result_.path, Motion::Moving));
    return std::move(result_);
  }

 private:
  static std::size_t blocks_of(const StrokeMoves& moves) {
    return moves.size() -
           static_cast<std::size_t>(std::count(moves.stroke.begin(), moves.stroke.end(), StrokeMoves::kNoStroke));
  }

  double seconds_of(std::size_t move) const { return moves_.share[move] * seconds_[moves_.stroke[move]]; }

  void add_stretch(std::size_t first, std::size_t end) {
    std::size_t too_short = 0;
    for (std::size_t i = first; i < end; ++i) too_short += static_cast<std::size_t>(seconds_of(i) < least_);
    result_.blocks_before += end - first;
    result_.short_before += too_short;
    const bool halts = std::any_of(moves_.steps.begin() + static_cast<std::ptrdiff_t>(first),
                                   moves_.steps.begin() + static_cast<std::ptrdiff_t>(end),
                                   [](const ProgramStep& step) { return !(step.length() > 0.0); });
    if (too_short > 0 && !halts) return add(points_of_stretch(runs_of(first, end)));
    const auto from = path_.points.begin() + moves_.stroke[first], to = path_.points.begin() + moves_.stroke[end - 1];
    add({from, to + 1});
  }

  std::vector<StraightRun> runs_of(std::size_t first, std::size_t end) const {
    std::vector<StraightRun> runs;
    for (std::size_t i = first; i < end; ++i) {
      const ProgramStep& step = moves_.steps[i];
      if (runs.empty() || !goes_straight_on(runs.back(), step.finish)) runs.push_back({step.start, {}});
      runs.back().moves.push_back({step.finish, step.length(), std::min(1.0, seconds_of(i) / least_)});
    }
    return runs;
  }

  void add(const std::vector<Point>& points) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      result_.path.points.push_back(points[k]);
      result_.path.lifted.push_back(static_cast<char>(k == 0));
    }
  }

  const ToolPath& path_;
  const Eigen::VectorXd& seconds_;
  double least_;
  StrokeMoves moves_;
  MergedPath result_;
};

}  // namespace

MergedPath merge_short_blocks(const ToolPath& path, const Eigen::VectorXd& seconds, double least_seconds) {
  return Merging(path, seconds, least_seconds).merge();
}

}  // namespace dwell
