#include "paths/feed/plan_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"

namespace dwell {
namespace {

// Feed tables hold coordinates to 1e-6 mm, so each is off by at most 0.71e-6 mm in the plane, and the nodes of a
// stroke, halfway between two of them, by no more: a straight stroke stays straight within twice that.
constexpr double kStraightWithin = 2e-6;

double distance_to_segment(Point p, Point a, Point b) {
  const Point d = b - a;
  const double squared = d.x * d.x + d.y * d.y;
  if (!(squared > 0.0)) return distance(p, a);
  const double along = ((p.x - a.x) * d.x + (p.y - a.y) * d.y) / squared;
  return distance(p, a + std::clamp(along, 0.0, 1.0) * d);
}

void add_step(Program& program, Point start, Point finish, double seconds) {
  if (start == finish && !(seconds > 0.0)) return;
  program.steps.push_back({start, finish, seconds, true});
}

void add_stroke(Program& program, const Stroke& stroke, double seconds) {
  if (distance_to_segment(stroke.via, stroke.start, stroke.finish) <= kStraightWithin) {
    add_step(program, stroke.start, stroke.finish, seconds);
    return;
  }
  const double share = distance(stroke.start, stroke.via) / stroke.length();
  add_step(program, stroke.start, stroke.via, share * seconds);
  add_step(program, stroke.via, stroke.finish, (1.0 - share) * seconds);
}

}  // namespace

std::vector<Stroke> strokes_of(const ToolPath& path, Motion motion) {
  return motion == Motion::Moving ? moving_strokes(path) : halting_strokes(path);
}

double dwell_within_feed(std::size_t point, double length, double dwell, double max_feed_mm_per_s) {
  if (!(dwell >= 0.0) || !std::isfinite(dwell)) {
    throw InputError(fmt::format("dwell of point {} = {} s; required finite and >= 0", point, dwell));
  }
  const double least = length / max_feed_mm_per_s;
  if (!(dwell * max_feed_mm_per_s >= length * (1.0 - 1e-6) - 4e-6)) {
    throw InputError(
        fmt::format("dwell of point {} = {} s; its stroke of {} mm takes at least {} s at maximum feed {} mm/s", point,
                    dwell, length, least, max_feed_mm_per_s));
  }
  return std::max(dwell, least);
}

Program program_of(const ToolPath& path, const std::vector<double>& dwell_s, Motion motion, double max_feed_mm_per_s) {
  validate(path);
  if (dwell_s.size() != path.size()) {
    throw InputError(
        fmt::format("tool path has {} but {}", counted(path.size(), "point"), counted(dwell_s.size(), "dwell time")));
  }
  if (!(max_feed_mm_per_s > 0.0) || !std::isfinite(max_feed_mm_per_s)) {
    throw InputError(fmt::format("maximum feed = {} mm/s; required finite and > 0", max_feed_mm_per_s));
  }
  const std::vector<Stroke> strokes = strokes_of(path, motion);
  Program program;
  program.steps.reserve(2 * strokes.size());
  program.fastest_feed = max_feed_mm_per_s;
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    const Stroke& stroke = strokes[j];
    const double seconds = dwell_within_feed(j + 1, stroke.length(), dwell_s[j], max_feed_mm_per_s);
    if (j > 0 && path.lifted[j]) {
      program.steps.push_back({strokes[j - 1].finish, stroke.start, 0.0, false});
      program.rapid_length += distance(strokes[j - 1].finish, stroke.start);
    } else if (j > 0 && motion == Motion::Stop) {
      const Point from = strokes[j - 1].finish;
      add_step(program, from, stroke.start, distance(from, stroke.start) / max_feed_mm_per_s);
    }
    add_stroke(program, stroke, seconds);
  }
  return program;
}

}  // namespace dwell
