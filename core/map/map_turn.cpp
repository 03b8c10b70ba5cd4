#include "core/map/map_turn.h"

#include "core/base/grid_limit.h"

namespace dwell {
namespace {

bool exchanges_axes(GridTurn turn) {
  return turn == GridTurn::Quarter || turn == GridTurn::ThreeQuarters || turn == GridTurn::Transpose;
}

/// Linear index in `to` of the pixel that lies at (row, col) in `from`.
Index target_of(GridTurn turn, const Grid& from, const Grid& to, Index row, Index col) {
  switch (turn) {
    case GridTurn::FlipX:
      return to.index(row, from.cols - 1 - col);
    case GridTurn::FlipY:
      return to.index(from.rows - 1 - row, col);
    case GridTurn::Quarter:
      return to.index(col, from.rows - 1 - row);
    case GridTurn::Half:
      return to.index(from.rows - 1 - row, from.cols - 1 - col);
    case GridTurn::ThreeQuarters:
      return to.index(from.cols - 1 - col, row);
    case GridTurn::Transpose:
      return to.index(col, row);
  }
  return 0;
}

Grid turned_grid(const Grid& g, GridTurn turn, std::optional<Point> about) {
  Grid result = exchanges_axes(turn) ? Grid{g.cols, g.rows, g.pitch_y, g.pitch_x, {}} : g;
  // If a map that keeps its axes is turned about its middle, its origin stays the same to the last bit.
  if (!about && !exchanges_axes(turn)) return result;
  const Point middle = middle_of(g);
  result.origin = {};
  result.origin = (about ? turn_point(middle, turn, *about) : middle) - middle_of(result);
  return result;
}

}  // namespace

Point turn_point(Point p, GridTurn turn, Point about) {
  const Point d = p - about;
  switch (turn) {
    case GridTurn::FlipX:
      return about + Point{-d.x, d.y};
    case GridTurn::FlipY:
      return about + Point{d.x, -d.y};
    case GridTurn::Quarter:
      return about + Point{-d.y, d.x};
    case GridTurn::Half:
      return about - d;
    case GridTurn::ThreeQuarters:
      return about + Point{d.y, -d.x};
    case GridTurn::Transpose:
      return about + Point{d.y, d.x};
  }
  return p;
}

HeightMap turn_map(const HeightMap& map, GridTurn turn, std::optional<Point> about) {
  HeightMap result(turned_grid(map.grid, turn, about));
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      result.values[static_cast<std::size_t>(target_of(turn, map.grid, result.grid, row, col))] = map.at(row, col);
    }
  }
  result.history = map.history;
  return result;
}

}  // namespace dwell
