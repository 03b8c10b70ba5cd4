#include "core/tif/removal_orientation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/rotation.h"
#include "core/numerics/spline_surface.h"

namespace dwell {
namespace {

HeightMap with_grid(const HeightMap& like, const Grid& grid) {
  HeightMap map(grid);
  map.history = like.history;
  map.quantity = like.quantity;
  return map;
}

HeightMap mirror_samples(const HeightMap& rates, bool x) {
  Grid g = rates.grid;
  if (x) {
    g.origin.x = -rates.grid.x(g.cols - 1);
  } else {
    g.origin.y = -rates.grid.y(g.rows - 1);
  }
  HeightMap map = with_grid(rates, g);
  for (Index r = 0; r < g.rows; ++r) {
    for (Index c = 0; c < g.cols; ++c) map.at(r, c) = x ? rates.at(r, g.cols - 1 - c) : rates.at(g.rows - 1 - r, c);
  }
  return map;
}

/// (x, y) goes to (-y, x).
HeightMap turned_by_90(const HeightMap& rates) {
  const Grid& g = rates.grid;
  HeightMap map = with_grid(rates, {g.cols, g.rows, g.pitch_y, g.pitch_x, {-g.y(g.rows - 1), g.origin.x}});
  for (Index r = 0; r < map.grid.rows; ++r) {
    for (Index c = 0; c < map.grid.cols; ++c) map.at(r, c) = rates.at(g.rows - 1 - c, r);
  }
  return map;
}

/// The smallest grid about the axis that holds the samples' rectangle, turned.
Grid turned_grid(const Grid& g, const Rotation& turn) {
  const double pitch = std::min(g.pitch_x, g.pitch_y);
  double left = 0.0, right = 0.0, low = 0.0, high = 0.0;
  for (const double x : {g.x(0), g.x(g.cols - 1)}) {
    for (const double y : {g.y(0), g.y(g.rows - 1)}) {
      const Point p = turn({x, y});
      left = std::min(left, p.x), right = std::max(right, p.x);
      low = std::min(low, p.y), high = std::max(high, p.y);
    }
  }
  const double first_col = std::floor(left / pitch), first_row = std::floor(low / pitch);
  return {static_cast<Index>(std::ceil(high / pitch) - first_row) + 1,
          static_cast<Index>(std::ceil(right / pitch) - first_col) + 1,
          pitch,
          pitch,
          {pitch * first_col, pitch * first_row}};
}

/// Whether one of the four samples around a point is not zero.
bool removes_near(const HeightMap& rates, Point p) {
  const Grid& g = rates.grid;
  const Index row = static_cast<Index>(std::floor((p.y - g.origin.y) / g.pitch_y)),
              col = static_cast<Index>(std::floor((p.x - g.origin.x) / g.pitch_x));
  for (Index r = std::max<Index>(row, 0); r <= std::min(row + 1, g.rows - 1); ++r) {
    for (Index c = std::max<Index>(col, 0); c <= std::min(col + 1, g.cols - 1); ++c) {
      if (rates.at(r, c) != 0.0) return true;
    }
  }
  return false;
}

HeightMap turn_samples(const HeightMap& rates, double angle) {
  const Rotation turn(angle);
  const Grid& g = rates.grid;
  HeightMap map = with_grid(rates, turned_grid(g, turn));
  const SplineSurface surface(g, rates.values);
  double sum = 0.0, before = 0.0;
  for (const double v : rates.values) before += v;
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = turn.back(map.grid.centre(i));
    // The spline rings beyond the samples that are not zero; the removal function is zero there.
    map.values[static_cast<std::size_t>(i)] = removes_near(rates, p) ? surface(p) : 0.0;
    sum += map.values[static_cast<std::size_t>(i)];
  }
  const double factor = before * g.pitch_x * g.pitch_y / (sum * map.grid.pitch_x * map.grid.pitch_y);
  if (!(factor > 0.8 && factor < 1.25)) {
    throw InputError(fmt::format(
        "removal function: turned by {} deg its volume changes by a factor {:.4g}; its grid of {:.4g} x {:.4g} mm is "
        "too coarse, or cuts it off",
        angle, 1.0 / factor, g.pitch_x, g.pitch_y));
  }
  for (double& v : map.values) v *= factor;
  return map;
}

}  // namespace

ToolOrientation::Flip parse_flip(const std::string& text) {
  if (text == "none") return ToolOrientation::Flip::None;
  if (text == "x") return ToolOrientation::Flip::X;
  if (text == "y") return ToolOrientation::Flip::Y;
  throw InputError(fmt::format("'{}'; accepted: none, x, y", text));
}

std::string to_string(ToolOrientation::Flip flip) {
  switch (flip) {
    case ToolOrientation::Flip::X:
      return "x";
    case ToolOrientation::Flip::Y:
      return "y";
    default:
      return "none";
  }
}

RemovalFunction oriented(const RemovalFunction& tif, const ToolOrientation& orientation) {
  using Kind = RemovalFunction::Kind;
  if (tif.kind == Kind::Gaussian || tif.kind == Kind::Disc) return tif;
  const double angle = orientation.angle - 360.0 * std::floor(orientation.angle / 360.0);
  const bool flipped = orientation.flip != ToolOrientation::Flip::None;
  if (angle == 0.0 && !flipped) return tif;
  HeightMap rates = flipped ? mirror_samples(tif.samples, orientation.flip == ToolOrientation::Flip::X) : tif.samples;
  const double quarters = angle / 90.0;
  if (quarters == std::floor(quarters)) {
    for (int k = 0; k < static_cast<int>(quarters); ++k) rates = turned_by_90(rates);
  } else {
    rates = turn_samples(rates, angle);
  }
  rates.history.push_back(
      fmt::format("tif: {}turned by {} deg",
                  flipped ? (orientation.flip == ToolOrientation::Flip::X ? "flipped in x, " : "flipped in y, ") : "",
                  orientation.angle));
  RemovalFunction result = measured_removal(rates, {TifCentre::Kind::Given, {}});
  result.kind = tif.kind;
  result.model = tif.model;
  result.file = tif.file;
  result.notes = tif.notes;
  return result;
}

}  // namespace dwell
