#include "runs/plan/rest_of_path.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/point.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {
namespace {

constexpr double kSamePlace = 1e-3;  // along a stroke [mm]
constexpr double kSameStroke = 2e-6;

bool is_same(const Stroke& a, const Stroke& b) {
  return distance(a.start, b.start) <= kSameStroke && distance(a.via, b.via) <= kSameStroke &&
         distance(a.finish, b.finish) <= kSameStroke;
}

/// A place on a path, and what follows it.
class Remainder {
 public:
  Remainder(const ToolPath& path, const std::vector<double>& dwell, Motion motion, std::size_t stroke, double done)
      : path_(path), dwell_(dwell), motion_(motion), strokes_(strokes_of(path, motion)), j_(stroke) {
    const Stroke& s = strokes_[j_];
    way_ = done * s.length();
    to_via_ = distance(s.start, s.via);
    left_ = dwell[j_] * (1.0 - done);
    place_ = way_ <= to_via_ ? along(s.start, s.via, way_) : along(s.via, s.finish, way_ - to_via_);
  }

  bool at_beginning() const { return way_ <= kSamePlace; }
  bool before_via() const { return way_ < to_via_ - kSamePlace; }
  bool has_length() const { return motion_ == Motion::Moving && strokes_[j_].length() > 0.0; }
  bool is_straight() const {
    const Stroke& s = strokes_[j_];
    return distance(s.start, s.via) + distance(s.via, s.finish) - distance(s.start, s.finish) <= kSameStroke;
  }

  /// From this stroke's own point on, which has `seconds`.
  RestOfPath from_own_point(double seconds) const {
    RestOfPath rest = tail(j_);
    if (!rest.dwell.empty()) rest.dwell.front() = seconds;
    return rest;
  }
  RestOfPath from_next_point() const { return tail(j_ + 1); }

  /// The stroke as it was from its beginning on.
  std::optional<RestOfPath> whole() const { return checked(from_own_point(left_), {strokes_[j_]}, j_ + 1); }

  /// A point of its own on the way to the stroke's point.
  std::optional<RestOfPath> towards_own_point() const {
    const Stroke& s = strokes_[j_];
    const Point middle = between(place_, s.via, 2.0 / 3.0);
    RestOfPath rest = from_own_point(0.0);
    const double share = distance(place_, middle) / (distance(place_, s.via) + distance(s.via, s.finish));
    rest.dwell.front() = (1.0 - share) * left_;
    prepend(rest, between(place_, s.via, 1.0 / 3.0), share * left_, false);
    return checked(std::move(rest), {{place_, between(place_, s.via, 1.0 / 3.0), middle}, {middle, s.via, s.finish}},
                   j_ + 1);
  }

  /// A straight piece of two points to the stroke's end, and the next point after a lift.
  std::optional<RestOfPath> straight_piece() const {
    const Point end = strokes_[j_].finish, middle = between(place_, end, 0.5);
    RestOfPath rest = from_next_point();
    if (distance(place_, end) <= kSamePlace) {
      if (!rest.dwell.empty()) rest.dwell.front() += left_;
      return checked(std::move(rest), {}, j_ + 1);
    }
    prepend(rest, between(place_, end, 0.75), 0.5 * left_, true);
    prepend(rest, between(place_, end, 0.25), 0.5 * left_, false);
    return checked(std::move(rest),
                   {{place_, between(place_, end, 0.25), middle}, {middle, between(place_, end, 0.75), end}}, j_ + 1);
  }

  /// A point of its own on the way to the next point; of its dwell what the two strokes have there.
  std::optional<RestOfPath> towards_next_point() const {
    if (j_ + 1 >= path_.size() || path_.lifted[j_ + 1] != 0) return std::nullopt;
    const Stroke &s = strokes_[j_], &next = strokes_[j_ + 1];
    const Point middle = between(place_, next.via, 2.0 / 3.0);
    const double own = distance(place_, s.finish), length = distance(place_, middle);
    const double per_mm = own > 0.0 ? left_ / own : 0.0, next_per_mm = dwell_[j_ + 1] / next.length();
    const double seconds = per_mm * std::min(own, length) + next_per_mm * std::max(0.0, length - own);
    RestOfPath rest = from_next_point();
    rest.dwell.front() += left_ - seconds;
    prepend(rest, between(place_, next.via, 1.0 / 3.0), seconds, false);
    return checked(std::move(rest),
                   {{place_, between(place_, next.via, 1.0 / 3.0), middle}, {middle, next.via, next.finish}}, j_ + 2);
  }

  /// Two such pieces, of this stroke and the next one.
  std::optional<RestOfPath> straight_pieces() const {
    if (j_ + 1 >= path_.size()) return std::nullopt;
    const Stroke& next = strokes_[j_ + 1];
    const Point end = strokes_[j_].finish;
    if (distance(place_, end) <= kSamePlace || next.length() - distance(next.start, next.finish) > kSameStroke)
      return std::nullopt;
    RestOfPath rest = tail(j_ + 2);
    std::vector<Stroke> first;
    for (const auto& [from, to, seconds] :
         {std::tuple(next.start, next.finish, dwell_[j_ + 1]), std::tuple(place_, end, left_)}) {
      const Point a = between(from, to, 0.25), middle = between(from, to, 0.5), b = between(from, to, 0.75);
      prepend(rest, b, 0.5 * seconds, true);
      prepend(rest, a, 0.5 * seconds, false);
      first.insert(first.begin(), {Stroke{from, a, middle}, Stroke{middle, b, to}});
    }
    return checked(std::move(rest), first, j_ + 2);
  }

  double left() const { return left_; }
  double length() const { return strokes_[j_].length(); }

 private:
  static Point between(Point a, Point b, double share) { return a + share * (b - a); }
  static Point along(Point a, Point b, double way) {
    const double whole = distance(a, b);
    return whole > 0.0 ? between(a, b, std::min(way / whole, 1.0)) : a;
  }

  RestOfPath tail(std::size_t first) const {
    const auto from = static_cast<std::ptrdiff_t>(first);
    RestOfPath rest;
    rest.path.kind = path_.kind;
    rest.path.points.assign(path_.points.begin() + from, path_.points.end());
    rest.path.lifted.assign(path_.lifted.begin() + from, path_.lifted.end());
    rest.dwell.assign(dwell_.begin() + from, dwell_.end());
    if (!rest.path.lifted.empty()) rest.path.lifted.front() = 1;
    return rest;
  }

  /// A point before the others, which the tool is lifted to; `lifts`: between it and the next one as well.
  static void prepend(RestOfPath& rest, Point point, double seconds, bool lifts) {
    if (!rest.path.lifted.empty()) rest.path.lifted.front() = static_cast<char>(lifts);
    rest.path.points.insert(rest.path.points.begin(), point);
    rest.path.lifted.insert(rest.path.lifted.begin(), 1);
    rest.dwell.insert(rest.dwell.begin(), seconds);
  }

  /// The path, if its strokes are these and then the old ones from `from` on.
  std::optional<RestOfPath> checked(RestOfPath rest, const std::vector<Stroke>& first, std::size_t from) const {
    if (rest.path.points.empty()) return rest;
    const std::vector<Stroke> now = strokes_of(rest.path, motion_);
    if (now.size() != first.size() + strokes_.size() - from) return std::nullopt;
    const auto behind = now.begin() + static_cast<std::ptrdiff_t>(first.size());
    const bool same = std::equal(first.begin(), first.end(), now.begin(), is_same) &&
                      std::equal(behind, now.end(), strokes_.begin() + static_cast<std::ptrdiff_t>(from), is_same);
    return same ? std::optional(std::move(rest)) : std::nullopt;
  }

  const ToolPath& path_;
  const std::vector<double>& dwell_;
  Motion motion_;
  std::vector<Stroke> strokes_;
  std::size_t j_;
  double way_ = 0.0, to_via_ = 0.0, left_ = 0.0;
  Point place_;
};

}  // namespace

RestOfPath rest_of_path(const ToolPath& path, const std::vector<double>& dwell, Motion motion, std::size_t stroke,
                        double done, double max_feed) {
  const Remainder r(path, dwell, motion, stroke, done);
  if (!r.has_length()) return r.from_own_point(r.left());
  std::optional<RestOfPath> rest;
  if (r.at_beginning()) rest = r.whole();
  if (!rest && r.before_via()) rest = r.towards_own_point();
  if (!rest && (!r.before_via() || r.is_straight())) rest = r.straight_piece();
  if (!rest && !r.before_via()) rest = r.towards_next_point();
  if (!rest && (!r.before_via() || r.is_straight())) rest = r.straight_pieces();
  if (rest) return *rest;
  // Less than the stroke takes at the fastest feed is left out or run at that, whichever is nearer.
  const double least = r.length() / max_feed;
  if (r.left() >= least || r.at_beginning()) return r.from_own_point(r.left());
  return r.left() < 0.5 * least ? r.from_next_point() : r.from_own_point(least);
}

}  // namespace dwell
