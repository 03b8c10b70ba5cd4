#include "core/motion/tool_path.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"

namespace dwell {
namespace {

/// A piece of path without lifts: dwell points [first, last).
struct Piece {
  std::size_t first, last;
};

/// Nodes halfway between neighbours, the ends extended straight on. nodes[k] is where the stroke of point first + k
/// begins.
std::vector<Point> halfway_nodes(const ToolPath& path, Piece piece) {
  const auto& p = path.points;
  std::vector<Point> nodes(piece.last - piece.first + 1);
  for (std::size_t j = piece.first + 1; j < piece.last; ++j) nodes[j - piece.first] = midpoint(p[j - 1], p[j]);
  if (nodes.size() == 2) {
    nodes = {p[piece.first], p[piece.first]};
  } else {
    nodes.front() = p[piece.first] - (nodes[1] - p[piece.first]);
    nodes.back() = p[piece.last - 1] + (p[piece.last - 1] - nodes[nodes.size() - 2]);
  }
  return nodes;
}

/// The nodes of the chain of equal steps that has these points as midpoints; nothing if there is none. From the first
/// straight step on, q_j = 2 p_j - q_(j-1); each further straight step gives its node anew, so that rounding does not
/// add up.
std::vector<Point> chain_nodes(const ToolPath& path, Piece piece) {
  const auto& p = path.points;
  const std::size_t count = piece.last - piece.first;
  if (count < 3) return {};
  const double step = distance(p[piece.first], p[piece.first + 1]);
  const double slack = kEqualSteps * step;
  if (!(step > 0.0)) return {};
  std::vector<Point> nodes(count + 1);
  nodes[0] = p[piece.first] - 0.5 * (p[piece.first + 1] - p[piece.first]);
  for (std::size_t k = 0; k < count; ++k) {
    const Point here = p[piece.first + k];
    nodes[k + 1] = here + (here - nodes[k]);
    const double taken = distance(nodes[k], nodes[k + 1]);
    const bool whole = std::abs(taken - step) <= slack;
    if (k + 1 == count) return whole || taken < step ? nodes : std::vector<Point>{};  // the last may be cut short
    if (!whole) return {};
    const Point next = p[piece.first + k + 1];
    if (!(distance(here, next) >= 0.5 * step - slack)) return {};  // turns back more sharply than 120 degrees
    const bool straight = std::abs(distance(here, next) - step) <= slack &&
                          (k == 0 || distance(next - here, here - p[piece.first + k - 1]) <= slack);
    if (!straight) continue;
    if (!(distance(midpoint(here, next), nodes[k + 1]) <= slack)) return {};
    nodes[k + 1] = midpoint(here, next);
  }
  return {};
}

}  // namespace

std::vector<Stroke> moving_strokes(const ToolPath& path) {
  std::vector<Stroke> strokes(path.size());
  for (std::size_t first = 0; first < path.size();) {
    std::size_t last = first + 1;
    while (last < path.size() && !path.lifted[last]) ++last;
    std::vector<Point> nodes = chain_nodes(path, {first, last});
    if (nodes.empty()) nodes = halfway_nodes(path, {first, last});
    for (std::size_t j = first; j < last; ++j) strokes[j] = {nodes[j - first], path.points[j], nodes[j - first + 1]};
    first = last;
  }
  return strokes;
}

std::vector<Stroke> halting_strokes(const ToolPath& path) {
  std::vector<Stroke> strokes(path.size());
  for (std::size_t j = 0; j < path.size(); ++j) strokes[j] = {path.points[j], path.points[j], path.points[j]};
  return strokes;
}

void validate(const ToolPath& path) {
  if (path.points.empty()) throw InputError("tool path has no dwell points; at least one is required");
  if (path.lifted.size() != path.points.size()) {
    throw InputError(
        fmt::format("tool path has {} but {} lift flags", counted(path.points.size(), "point"), path.lifted.size()));
  }
  for (std::size_t j = 0; j < path.size(); ++j) {
    if (!std::isfinite(path.points[j].x) || !std::isfinite(path.points[j].y)) {
      throw InputError(fmt::format("tool path point {} = ({}, {}) mm; coordinates must be finite", j + 1,
                                   path.points[j].x, path.points[j].y));
    }
  }
}

}  // namespace dwell
