#include "paths/lines/corner_rounding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/poll.h"
#include "paths/domain/point_limit.h"
#include "paths/domain/rounding.h"

namespace dwell {
namespace {

constexpr double kStraight = 1e-6;  // bends by less than this [rad] do not end a leg
constexpr double kDegree = std::numbers::pi / 180.0;

/// A place where the path bends or a piece begins or ends.
struct Vertex {
  std::size_t point = 0;
  double corner = 0.0;       // [rad], counter-clockwise positive; 0 at the ends of a piece
  double trim = 0.0;         // what the arc takes of both legs [mm]; 0 = no arc
  std::size_t on_arc = 0;    // dwell points on the arc
  bool ends_piece = false;   // the last of its piece: the next vertex begins another
  bool turned_back = false;  // too sharp for an arc
};

struct Rounding {
  std::vector<Vertex> vertices;  // in path order, each piece from its first point to its last
  std::size_t points = 0;        // of the result
  std::size_t rounded = 0;
  std::size_t tight = 0;  // of them, with less than the radius asked for
  std::size_t turned_back = 0;
  double least_radius = std::numeric_limits<double>::infinity();
};

double angle_between(Point from, Point to) {
  return std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
}

/// The corners of the path, before their trims and points are chosen. A point that repeats its neighbour ends a leg but
/// is no corner.
std::vector<Vertex> bends(const ToolPath& path, const Progress& progress) {
  Poll poll(progress);
  const auto& p = path.points;
  std::vector<Vertex> vertices;
  for (std::size_t j = 0; j < path.size(); ++j) {
    poll.step();
    const bool begins = j == 0 || path.lifted[j];
    const bool ends = j + 1 == path.size() || path.lifted[j + 1];
    Vertex vertex;
    vertex.point = j;
    vertex.ends_piece = ends;
    if (!begins && !ends) {
      const Point in = p[j] - p[j - 1], out = p[j + 1] - p[j];
      const bool moves = in != Point{} && out != Point{};
      if (moves) vertex.corner = angle_between(in, out);
      if (moves && std::abs(vertex.corner) <= kStraight) continue;
    }
    vertices.push_back(vertex);
  }
  return vertices;
}

/// Dwell points of the leg from one vertex towards another that are nearer than `trim`, without the vertex itself.
std::size_t cut_off(const std::vector<Point>& p, std::size_t vertex, std::size_t other, double trim) {
  std::size_t count = 0;
  const double least = trim * (1.0 - kRounding);
  for (std::size_t j = vertex; j != other;) {
    j = other > vertex ? j + 1 : j - 1;
    if (j == other || distance(p[j], p[vertex]) >= least) break;
    ++count;
  }
  return count;
}

std::size_t points_on_arc(const std::vector<Point>& p, const Vertex& before, const Vertex& v, const Vertex& after,
                          double radius) {
  const std::size_t cut = 1 + cut_off(p, v.point, before.point, v.trim) + cut_off(p, v.point, after.point, v.trim);
  const double spacing = std::min(distance(p[v.point - 1], p[v.point]), distance(p[v.point], p[v.point + 1]));
  const double corner = std::abs(v.corner);
  const double close = std::min(radius * corner / spacing, 2.0 * static_cast<double>(cut));
  const double smooth = corner / (kArcTurnDeg * kDegree);
  return static_cast<std::size_t>(std::ceil(std::max(smooth, close) - kRounding));
}

Rounding plan(const ToolPath& path, double radius, const Progress& progress) {
  Poll poll(progress, 4096);
  const auto& p = path.points;
  Rounding plan{bends(path, progress)};
  plan.points = path.size();
  for (std::size_t i = 0; i < plan.vertices.size(); ++i) {
    poll.step();
    Vertex& v = plan.vertices[i];
    const double corner = std::abs(v.corner);
    if (!(corner > kLeftCornerDeg * kDegree * (1.0 + kRounding))) continue;
    if (corner > kTurnBackDeg * kDegree) {
      ++plan.turned_back;
      continue;
    }
    const Vertex& before = plan.vertices[i - 1];
    const Vertex& after = plan.vertices[i + 1];
    const double room = 0.5 * std::min(distance(p[before.point], p[v.point]), distance(p[v.point], p[after.point]));
    // An arc that takes T of both legs has radius T / tan(phi / 2) and departs from the corner by T tan(phi / 4).
    const double wanted = radius * std::tan(0.5 * corner);
    v.trim = std::min({wanted, room, radius / std::tan(0.25 * corner)});
    const double taken = v.trim / std::tan(0.5 * corner);
    v.on_arc = points_on_arc(p, before, v, after, taken);
    plan.points += v.on_arc;
    ++plan.rounded;
    if (v.trim < wanted * (1.0 - kRounding)) ++plan.tight;
    plan.least_radius = std::min(plan.least_radius, taken);
  }
  return plan;
}

void append_arc(const std::vector<Point>& p, const Vertex& v, ToolPath& result) {
  const Point in = p[v.point] - p[v.point - 1];
  const Point along = (1.0 / length(in)) * in;
  const double side = v.corner > 0.0 ? 1.0 : -1.0;
  const Point across = side * Point{-along.y, along.x};
  const double radius = v.trim / std::tan(0.5 * std::abs(v.corner));
  const Point centre = p[v.point] - v.trim * along + radius * across;
  for (std::size_t i = 0; i < v.on_arc; ++i) {
    const double turned = std::abs(v.corner) * (static_cast<double>(i) + 0.5) / static_cast<double>(v.on_arc);
    result.points.push_back(centre + (radius * std::sin(turned)) * along - (radius * std::cos(turned)) * across);
    result.lifted.push_back(0);
  }
}

std::string note(const Rounding& plan, double radius) {
  std::string text = fmt::format("corners rounded with radius {:.6g} mm: {}", radius, plan.rounded);
  if (plan.tight > 0) {
    text += fmt::format(", {} of them with less for want of room (least {:.3g} mm)", plan.tight, plan.least_radius);
  }
  if (plan.turned_back > 0) {
    text += fmt::format("; turn-backs of more than {} degrees kept: {}", kTurnBackDeg, plan.turned_back);
  }
  return text;
}

}  // namespace

ToolPath round_corners(const ToolPath& path, double radius, const Progress& progress) {
  if (!(std::isfinite(radius) && radius >= 0.0)) {
    throw InputError(fmt::format("{}: corner = {} mm; required finite and >= 0", path.kind, radius));
  }
  validate(path);
  if (radius == 0.0) return path;
  const Rounding rounding = plan(path, radius, progress);
  if (!(static_cast<double>(rounding.points) <= kMaxPathPoints)) {
    throw InputError(fmt::format("{}: with its corners rounded the path has up to {}; at most {:.0e} accepted",
                                 path.kind, counted(rounding.points, "point"), kMaxPathPoints));
  }
  const auto& p = path.points;
  ToolPath result{path.kind, {}, {}, path.notes};
  result.points.reserve(rounding.points);
  result.lifted.reserve(rounding.points);
  Poll poll(progress);
  const auto keep = [&](std::size_t j) {
    poll.step();
    result.points.push_back(p[j]);
    result.lifted.push_back(path.lifted[j]);
  };
  for (std::size_t i = 0; i < rounding.vertices.size(); ++i) {
    const Vertex& v = rounding.vertices[i];
    if (v.on_arc > 0) {
      append_arc(p, v, result);
    } else {
      keep(v.point);
    }
    if (v.ends_piece) continue;
    const Vertex& next = rounding.vertices[i + 1];
    for (std::size_t j = v.point + 1; j < next.point; ++j) {
      const bool cut = distance(p[j], p[v.point]) < v.trim * (1.0 - kRounding) ||
                       distance(p[j], p[next.point]) < next.trim * (1.0 - kRounding);
      if (!cut) keep(j);
    }
  }
  result.notes.push_back(note(rounding, radius));
  return result;
}

}  // namespace dwell
