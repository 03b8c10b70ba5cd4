#pragma once

// A slow answer about a machine that blends corners, which shares no code with what it judges.

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/motion/program.h"

namespace dwell::test {

struct BlendOracleMachine {
  double tolerance, acceleration, across_share, along_share;
  bool as_needed;
};

/// The way of a tool along lines and the arcs between them, as very many places in a row; of each what holds there. The
/// tool is then moved over it in steps of 0.1 ms: as fast as its acceleration, the feed and what is ahead allow.
class BlendOracle {
 public:
  BlendOracle(const std::vector<ProgramStep>& steps, const BlendOracleMachine& machine) : machine_(machine) {
    std::vector<Point> touches_out(steps.size()), touches_in(steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) touches_in[i] = steps[i].start, touches_out[i] = steps[i].finish;
    std::vector<Arc> arcs(steps.size());
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
      arcs[i] = arc_between(steps[i], steps[i + 1]);
      touches_out[i] = arcs[i].begin;
      touches_in[i + 1] = arcs[i].end;
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
      add_line(touches_in[i], touches_out[i], speed_of(steps[i]));
      if (i + 1 < steps.size()) add_arc(arcs[i], speed_of(steps[i]), speed_of(steps[i + 1]));
    }
    passes_.push_back(places_.size() - 1);
    look_ahead();
    run();
  }

  /// Where it is after a time, and how long it takes.
  Point place(double seconds) const {
    const double k = seconds / kStep;
    const auto i = std::min(static_cast<std::size_t>(k), track_.size() - 2);
    return track_[i] +
           (std::min(k, static_cast<double>(track_.size() - 1)) - static_cast<double>(i)) * (track_[i + 1] - track_[i]);
  }
  double total() const { return passed_.back(); }
  /// When it is in the middle of the arc after step i, or at the end.
  double passes(std::size_t i) const { return passed_[i]; }
  const std::vector<Point>& track() const { return track_; }
  static constexpr double kStep = 1e-4;  // [s]

 private:
  struct Arc {
    Point begin, end, centre;
    double radius = 0.0, speed = 0.0, first = 0.0, sweep = 0.0;
  };

  static double speed_of(const ProgramStep& step) { return distance(step.start, step.finish) / step.seconds; }

  /// By the centre on the line that halves the angle of the corner, and its feet on both moves.
  Arc arc_between(const ProgramStep& a, const ProgramStep& b) const {
    const Point corner = a.finish;
    const double la = distance(a.start, a.finish), lb = distance(b.start, b.finish), least = std::min(la, lb);
    const Point back = (1.0 / la) * (a.start - corner), on = (1.0 / lb) * (b.finish - corner);
    const double opening = std::acos(std::clamp(dot(back, on), -1.0, 1.0)), half = 0.5 * opening;
    // A circle of radius r touches both at r / tan(half) from the corner, and comes within r / sin(half) - r of it.
    const double e = std::min(machine_.tolerance, 0.25 * least);
    double r = std::min(e / (1.0 / std::sin(half) - 1.0), 0.5 * least * std::tan(half));
    double v = std::sqrt(machine_.across_share * machine_.acceleration * r);
    if (machine_.as_needed) {
      v = std::min(v, std::max(speed_of(a), speed_of(b)));
      const double gain = machine_.along_share * machine_.acceleration, room = r / std::tan(half);
      const double reached = std::min(v, std::sqrt(2.0 * gain * room));
      const double turn = std::acos(-1.0) - opening;
      r = std::max(v * v / (machine_.across_share * machine_.acceleration), std::min(r, v * (reached / gain) / turn));
    }
    const Point middle = back + on;
    Arc arc;
    arc.centre = corner + (r / std::sin(half) / length(middle)) * middle;
    arc.begin = corner + dot(arc.centre - corner, back) * back;
    arc.end = corner + dot(arc.centre - corner, on) * on;
    arc.radius = r;
    arc.speed = v;
    const Point p = arc.begin - arc.centre, q = arc.end - arc.centre;
    arc.first = std::atan2(p.y, p.x);
    arc.sweep = std::atan2(p.x * q.y - p.y * q.x, dot(p, q));
    return arc;
  }

  void add_place(Point place, double speed, double acceleration) {
    ways_.push_back(places_.empty() ? 0.0 : ways_.back() + distance(places_.back(), place));
    places_.push_back(place);
    most_.push_back(speed);
    gains_.push_back(acceleration);
  }

  void add_line(Point from, Point to, double speed) {
    const int parts = std::max(1, static_cast<int>(distance(from, to) / 2e-4));
    for (int k = 0; k <= parts; ++k)
      add_place(from + (static_cast<double>(k) / parts) * (to - from), speed, machine_.acceleration);
  }

  void add_arc(const Arc& arc, double before, double after) {
    const int parts = 2 * std::max(8, static_cast<int>(arc.radius * std::abs(arc.sweep) / 4e-4));
    for (int k = 0; k <= parts; ++k) {
      const double angle = arc.first + arc.sweep * k / parts;
      const double speed = std::min(arc.speed, 2 * k < parts   ? before
                                               : 2 * k > parts ? after
                                                               : std::min(before, after));
      add_place(arc.centre + arc.radius * Point{std::cos(angle), std::sin(angle)}, speed,
                machine_.along_share * machine_.acceleration);
      if (2 * k == parts) passes_.push_back(places_.size() - 1);
    }
  }

  /// What lies ahead may hold it back: the speed from which it can still slow down in time.
  void look_ahead() {
    most_.back() = 0.0;
    for (std::size_t k = most_.size() - 1; k-- > 0;) {
      const double gain = std::min(gains_[k], gains_[k + 1]), way = ways_[k + 1] - ways_[k];
      most_[k] = std::min(most_[k], std::sqrt(most_[k + 1] * most_[k + 1] + 2.0 * gain * way));
    }
  }

  void run() {
    double s = 0.0, v = 0.0, clock = 0.0;
    std::size_t at = 0, next = 0;
    track_.push_back(places_.front());
    while (s < ways_.back() - 1e-6) {  // over the last nanometre it would crawl
      const double faster = std::min(v + gains_[at] * kStep, most_at(at, s + 0.5 * (v + gains_[at] * kStep) * kStep));
      const double way = std::max(0.5 * (v + faster) * kStep, 1e-9);
      const double from = s;
      s = std::min(ways_.back(), s + way);
      while (next < passes_.size() && ways_[passes_[next]] <= s) {
        passed_.push_back(clock + kStep * (ways_[passes_[next]] - from) / way);
        ++next;
      }
      while (at + 2 < ways_.size() && ways_[at + 1] <= s) ++at;
      clock += kStep;
      v = faster;
      const double share = (s - ways_[at]) / std::max(1e-12, ways_[at + 1] - ways_[at]);
      track_.push_back(places_[at] + std::min(1.0, share) * (places_[at + 1] - places_[at]));
    }
    while (passed_.size() < passes_.size()) passed_.push_back(clock);
  }

  double most_at(std::size_t at, double s) const {
    while (at + 2 < ways_.size() && ways_[at + 1] <= s) ++at;
    const double share = std::clamp((s - ways_[at]) / std::max(1e-12, ways_[at + 1] - ways_[at]), 0.0, 1.0);
    return std::sqrt(most_[at] * most_[at] + share * (most_[at + 1] * most_[at + 1] - most_[at] * most_[at]));
  }

  BlendOracleMachine machine_;
  std::vector<Point> places_, track_;
  std::vector<double> ways_, most_, gains_, passed_;
  std::vector<std::size_t> passes_;
};

}  // namespace dwell::test
