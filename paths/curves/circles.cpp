#include "paths/curves/circles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/counted.h"
#include "core/base/poll.h"

namespace dwell {
namespace {

constexpr double kFewestOnCircle = 3.0;
constexpr double kLongestArc = 7.0 / 6.0;  // of the step: a circle of 3.5 steps gets three arcs

/// A stretch of the dwell points of one circle, [begin, begin + count) modulo their number.
struct Arc {
  std::size_t begin, count;
};

class CirclesPlanner {
 public:
  CirclesPlanner(const HeightMap& map, const CirclesOptions& options, const Progress& progress)
      : part_(map, options, kLongestArc, "circles", progress), poll_(progress), side_(options.clockwise ? -1.0 : 1.0) {
    path_.kind = "circles";
  }

  ToolPath run() {
    const double first = std::max(std::ceil(part_.radius.low / part_.pitch - 0.5), 0.0);
    const double last = std::floor(part_.radius.high / part_.pitch - 0.5);
    const double circles = last - first + 1.0;
    const double turns = 0.5 * circles * (first + last + 1.0);  // sum of i + 1/2
    const double points = 2.0 * std::numbers::pi * part_.pitch / part_.step * turns + kFewestOnCircle * circles;
    part_.check_size(points, "circles");
    path_.points.reserve(part_.about_points(points));
    path_.lifted.reserve(path_.points.capacity());
    for (double i = first; i <= last; ++i) append_circle((i + 0.5) * part_.pitch);
    if (broken_ > 0) {
      path_.notes.push_back(fmt::format("{} of {} {} broken by the edge of the part and run in pieces, lifted between",
                                        broken_, counted(circles_, "circle"), broken_ == 1 ? "is" : "are"));
    }
    return std::move(path_);
  }

 private:
  void append_circle(double radius) {
    const double count = std::max(std::round(2.0 * std::numbers::pi * radius / part_.step), kFewestOnCircle);
    const double arc = 2.0 * std::numbers::pi * radius / count;
    look_round(radius, static_cast<std::size_t>(count), arc);
    std::vector<Arc> arcs = arcs_inside();
    if (arcs.empty()) return;
    ++circles_;
    if (arcs.front().count < inside_.size()) ++broken_;
    if (!path_.points.empty()) {
      const Point tool = path_.points.back();
      const auto nearest = std::min_element(arcs.begin(), arcs.end(), [&](const Arc& a, const Arc& b) {
        return distance(tool, ring_[a.begin]) < distance(tool, ring_[b.begin]);
      });
      std::rotate(arcs.begin(), nearest, arcs.end());
    }
    for (const Arc& piece : arcs) append_arc(piece, arc);
    last_arc_ = arc;
  }

  /// Fills inside_, and ring_ where it is set.
  void look_round(double radius, std::size_t count, double arc) {
    ring_.resize(count);
    inside_.assign(count, 0);
    const double turn = 2.0 * std::numbers::pi / static_cast<double>(count);
    double sure = 0.0;  // so many of the following points are known to be inside
    for (std::size_t k = 0; k < count; ++k) {
      poll_.step();
      const double angle = turn * (static_cast<double>(k) + 0.5);
      const Point p{part_.centre.x + radius * std::cos(angle), part_.centre.y + side_ * radius * std::sin(angle)};
      if (--sure < 0.0) {
        const DomainView view = part_.domain.look(p);
        sure = std::floor(std::min(view.holds_for / arc * (1.0 - 1e-9), static_cast<double>(count)));
        if (!view.inside) {
          k += static_cast<std::size_t>(sure);
          sure = 0.0;
          continue;
        }
      }
      ring_[k] = p;
      inside_[k] = 1;
    }
  }

  std::vector<Arc> arcs_inside() const {
    const std::size_t count = inside_.size();
    const auto outside = static_cast<std::size_t>(std::find(inside_.begin(), inside_.end(), 0) - inside_.begin());
    if (outside == count) return {{0, count}};
    std::vector<Arc> arcs;
    bool within = false;
    for (std::size_t n = 1; n < count; ++n) {
      const std::size_t k = (outside + n) % count;
      if (inside_[k] != 0) {
        if (!within) arcs.push_back({k, 0});
        ++arcs.back().count;
      }
      within = inside_[k] != 0;
    }
    return arcs;
  }

  void append_arc(const Arc& piece, double arc) {
    for (std::size_t n = 0; n < piece.count; ++n) {
      poll_.step();
      const Point p = ring_[(piece.begin + n) % ring_.size()];
      path_.lifted.push_back(n == 0 && !reaches(p, arc) ? 1 : 0);
      path_.points.push_back(p);
    }
    last_arc_ = arc;
  }

  /// Whether the tool goes on to the beginning of an arc without being lifted.
  bool reaches(Point p, double arc) const {
    if (path_.points.empty()) return false;
    const Point tool = path_.points.back();
    return distance(tool, p) <= part_.pitch + 0.5 * (last_arc_ + arc) && part_.domain.contains(midpoint(tool, p));
  }

  CentredDomain part_;
  Poll poll_;
  double side_;
  ToolPath path_;
  std::vector<Point> ring_;   // dwell points of the present circle
  std::vector<char> inside_;  // whether they are in the domain
  double last_arc_ = 0.0;     // distance of dwell points along the circle where the tool is
  std::size_t circles_ = 0;
  std::size_t broken_ = 0;
};

}  // namespace

CirclesOptions parse_circles_options(const SpecText& spec) { return {parse_centred_curve(spec)}; }

std::vector<PathDistance> circles_distances(const CirclesOptions& options) {
  return {{"pitch", options.pitch}, {"step", options.step.value_or(0.0)}};
}

ToolPath circles_path(const HeightMap& map, const CirclesOptions& options, const Progress& progress) {
  ToolPath path = CirclesPlanner(map, options, progress).run();
  if (options.from_edge) reverse(path);
  return path;
}

}  // namespace dwell
