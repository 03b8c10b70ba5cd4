#include "paths/curves/fibonacci.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/poll.h"
#include "paths/curves/centred_curve.h"
#include "paths/domain/path_domain.h"
#include "paths/domain/point_limit.h"
#include "paths/metrics/path_metrics.h"

namespace dwell {
namespace {

constexpr double kFarthest = 0.78;                // of the pitch: no place is farther from a point of the lattice
constexpr double kLongestMove = 2.5;              // of the pitch
constexpr double kZoneEnd = 0.28791399679201635;  // sqrt(5) phi / 4 pi: k / F^2 where arms of F and of phi F are alike

double checked_pitch(double pitch) {
  if (std::isfinite(pitch) && pitch > 0.0) return pitch;
  throw InputError(fmt::format("fibonacci: pitch = {} mm; required {}", pitch, pitch > 0.0 ? "finite" : "> 0"));
}

double checked_overrun(double overrun) {
  if (std::isfinite(overrun) && overrun >= 0.0) return overrun;
  throw InputError(fmt::format("fibonacci: overrun = {} mm; required finite and >= 0", overrun));
}

/// A stretch of an arm within the domain: points first, first + F, ..., count of them.
struct Piece {
  Index first = 0;
  Index count = 0;
  bool done = false;
};

class FibonacciPlanner {
 public:
  FibonacciPlanner(const HeightMap& map, const FibonacciOptions& options, const Progress& progress)
      : progress_(progress),
        poll_(progress),
        pitch_(checked_pitch(options.pitch)),
        domain_(map,
                std::max({checked_overrun(options.overrun.value_or(0.0)), kFarthest * pitch_,
                          0.5 * std::hypot(map.grid.pitch_x, map.grid.pitch_y)}),
                "fibonacci", "overrun", progress),
        centre_(options.centre.value_or(domain_.middle())) {
    if (!std::isfinite(centre_.x) || !std::isfinite(centre_.y)) {
      throw InputError(fmt::format("fibonacci: centre = {}/{} mm; required finite", centre_.x, centre_.y));
    }
    const Interval radius = radial_range(map, centre_, domain_.reach());
    const double first = std::floor(index_at(radius.low)), last = std::ceil(index_at(radius.high));
    if (!(last - first < kMaxPathPoints && last < 0x1p53)) {
      throw InputError(
          fmt::format("fibonacci: pitch = {} mm makes {:.3g} points from {:.6g} to {:.6g} mm from the centre; at most "
                      "{:.0e} accepted, make the pitch larger",
                      pitch_, last - first, radius.low, radius.high, kMaxPathPoints));
    }
    first_ = static_cast<Index>(std::max(first, 0.0));
    end_ = static_cast<Index>(last) + 1;
    path_.kind = "fibonacci";
  }

  ToolPath run() {
    Index before = 1, arms = 1;  // Fibonacci numbers
    for (Index begin = 0; begin < end_;) {
      const auto zone_end =
          static_cast<Index>(std::ceil(kZoneEnd * static_cast<double>(arms) * static_cast<double>(arms)));
      const Index end = std::min(zone_end, end_);
      begin = std::max(begin, first_);
      if (begin < end) {
        append_zone(begin, end, arms, before);
        begin = end;
      }
      before = std::exchange(arms, arms + before);
    }
    describe();
    return std::move(path_);
  }

 private:
  double index_at(double radius) const { return std::numbers::pi * (radius / pitch_) * (radius / pitch_) - 0.5; }

  Point place(Index k) const {
    // The golden angle is (3 - sqrt(5)) / 2 turns. In 64-bit fixed point, whole turns overflow and so drop out by
    // themselves.
    constexpr std::uint64_t kGoldenAngle = 7046029254386353130u;  // round(2^64 (3 - sqrt(5)) / 2)
    const double turns = static_cast<double>(static_cast<std::uint64_t>(k) * kGoldenAngle) * 0x1p-64;
    const double angle = 2.0 * std::numbers::pi * turns;
    const double radius = pitch_ * std::sqrt((static_cast<double>(k) + 0.5) / std::numbers::pi);
    return {centre_.x + radius * std::cos(angle), centre_.y + radius * std::sin(angle)};
  }

  Point at(Index k) const { return zone_[static_cast<std::size_t>(k - zone_begin_)]; }

  /// Points [begin, end) along their `arms` arms; `before` is the Fibonacci number before that.
  void append_zone(Index begin, Index end, Index arms, Index before) {
    zone_begin_ = begin;
    zone_.resize(static_cast<std::size_t>(end - begin));
    std::vector<char> inside(zone_.size());
    for (Index k = begin; k < end; ++k) {
      const auto i = static_cast<std::size_t>(k - begin);
      poll_.step();
      zone_[i] = place(k);
      inside[i] = domain_.contains(zone_[i]) ? 1 : 0;
    }
    cut_arms(inside, end, std::min(arms, end - begin), arms, before);
    // Chains of neighbouring pieces, one after the other; each piece begins or continues one chain.
    stride_ = arms;
    const std::size_t count = pieces_.size();
    const std::size_t start = nearest_arm();
    for (std::size_t n = 0; n < count; ++n) {
      for (Piece& piece : pieces_[(start + n) % count]) {
        if (piece.done) continue;
        append(piece);
        std::size_t arm = (start + n + 1) % count;
        for (Piece* next = neighbour(arm); next != nullptr; next = neighbour(arm)) {
          append(*next);
          arm = (arm + 1) % count;
        }
      }
    }
  }

  /// pieces_[i] = pieces of arm i, arms in the order in which they lie about the centre. Arm number i of them is that
  /// of point i * before modulo `arms`, for F(n) F(n-2) - F(n-1)^2 = +-1 makes F(n-1) the step from arm to arm.
  void cut_arms(const std::vector<char>& inside, Index end, Index used, Index arms, Index before) {
    pieces_.assign(static_cast<std::size_t>(used), {});
    std::size_t arm = 0;
    for (Index i = 0, j = 0; i < arms; ++i, j = (j + before) % arms) {
      poll_.step();
      if (zone_begin_ + j >= end) continue;
      std::vector<Piece>& pieces = pieces_[arm++];
      bool within = false;
      for (Index k = zone_begin_ + j; k < end; k += arms) {
        poll_.step();
        const bool in = inside[static_cast<std::size_t>(k - zone_begin_)] != 0;
        if (in && !within) pieces.push_back({k});
        if (in) ++pieces.back().count;
        within = in;
      }
    }
  }

  Index last(const Piece& piece) const { return piece.first + stride_ * (piece.count - 1); }

  /// Distance from the tool to the nearer end of a piece.
  double away(const Piece& piece) const {
    const Point tool = path_.points.back();
    return std::min(distance(tool, at(piece.first)), distance(tool, at(last(piece))));
  }

  std::size_t nearest_arm() const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t arm = 0; arm < pieces_.size() && !path_.points.empty(); ++arm) {
      for (const Piece& piece : pieces_[arm]) {
        if (away(piece) >= least) continue;
        least = away(piece);
        best = arm;
      }
    }
    return best;
  }

  /// The piece of an arm that the tool can go on to without being lifted, or none.
  Piece* neighbour(std::size_t arm) {
    Piece* best = nullptr;
    poll_.step();
    for (Piece& piece : pieces_[arm]) {
      if (!piece.done && away(piece) <= kLongestMove * pitch_ && (best == nullptr || away(piece) < away(*best))) {
        best = &piece;
      }
    }
    return best;
  }

  void append(Piece& piece) {
    piece.done = true;
    const bool backwards = !path_.points.empty() && distance(path_.points.back(), at(last(piece))) <
                                                        distance(path_.points.back(), at(piece.first));
    for (Index n = 0; n < piece.count; ++n) {
      poll_.step();
      const Point p = at(piece.first + stride_ * (backwards ? piece.count - 1 - n : n));
      path_.lifted.push_back(n == 0 && !reaches(p) ? 1 : 0);
      path_.points.push_back(p);
    }
  }

  bool reaches(Point p) const {
    if (path_.points.empty()) return false;
    const Point tool = path_.points.back();
    return distance(tool, p) <= kLongestMove * pitch_ && domain_.contains(midpoint(tool, p));
  }

  void describe() {
    if (path_.size() < 2) return;
    const PathMetrics metrics = path_metrics(path_, progress_);
    path_.notes.push_back(fmt::format(
        "the tour through {} is {:.4g} times (points - 1) * pitch long, lifted moves included ({} of "
        "them, {:.4g} mm)",
        counted(metrics.points, "point"), metrics.point_length / (static_cast<double>(metrics.points - 1) * pitch_),
        metrics.lifts, metrics.lifted_length));
  }

  const Progress& progress_;
  Poll poll_;
  double pitch_;
  PathDomain domain_;
  Point centre_;
  Index first_ = 0, end_ = 0;  // points that may be in the domain
  ToolPath path_;
  // Of the present zone:
  Index zone_begin_ = 0;
  Index stride_ = 1;  // from point to point of an arm
  std::vector<Point> zone_;
  std::vector<std::vector<Piece>> pieces_;
};

}  // namespace

FibonacciOptions parse_fibonacci_options(const SpecText& spec) {
  spec.accept_only({"pitch", "overrun", "centre"});
  FibonacciOptions options;
  options.pitch = spec.number("pitch");
  options.overrun = spec.optional_number("overrun");
  options.centre = spec.optional_point("centre");
  return options;
}

std::vector<PathDistance> fibonacci_distances(const FibonacciOptions& options) { return {{"pitch", options.pitch}}; }

ToolPath fibonacci_path(const HeightMap& map, const FibonacciOptions& options, const Progress& progress) {
  return FibonacciPlanner(map, options, progress).run();
}

}  // namespace dwell
