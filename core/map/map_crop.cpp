#include "core/map/map_crop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.h"

namespace dwell {
namespace {

struct Span {
  Index first = 0, last = -1;
};

/// The pixels of a line whose centres lie in [low, high], apart from rounding.
Span span_of(double origin, double pitch, Index count, double low, double high) {
  constexpr double kRounding = 1e-9;  // pixels
  const auto end = static_cast<double>(count);
  const double first = std::clamp(std::ceil((low - origin) / pitch - kRounding), 0.0, end);
  const double last = std::clamp(std::floor((high - origin) / pitch + kRounding), -1.0, end - 1.0);
  return {static_cast<Index>(first), static_cast<Index>(last)};
}

HeightMap part_of(const HeightMap& map, Span rows, Span cols) {
  const Grid& g = map.grid;
  HeightMap part(Grid{rows.last - rows.first + 1, cols.last - cols.first + 1, g.pitch_x, g.pitch_y,
                      g.centre(rows.first, cols.first)});
  for (Index r = 0; r < part.grid.rows; ++r) {
    std::copy_n(map.values.begin() + g.index(r + rows.first, cols.first), part.grid.cols,
                part.values.begin() + part.grid.index(r, 0));
  }
  part.history = map.history;
  return part;
}

}  // namespace

Point middle_of_data(const HeightMap& map) {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}, high = -1.0 * low;
  for (const Index i : finite_pixels(map)) {
    const Point p = map.grid.centre(i);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return midpoint(low, high);
}

HeightMap crop(const HeightMap& map, Point low, Point high) {
  const Grid& g = map.grid;
  const Span cols = span_of(g.origin.x, g.pitch_x, g.cols, low.x, high.x);
  const Span rows = span_of(g.origin.y, g.pitch_y, g.rows, low.y, high.y);
  if (rows.first <= rows.last && cols.first <= cols.last) {
    HeightMap part = part_of(map, rows, cols);
    if (part.valid_pixels() > 0) return part;
  }
  throw InputError(fmt::format(
      "crop to x = {} to {} mm, y = {} to {} mm leaves no pixel with data; the map has pixel centres at x = "
      "{} to {} mm, y = {} to {} mm",
      low.x, high.x, low.y, high.y, g.x(0), g.x(g.cols - 1), g.y(0), g.y(g.rows - 1)));
}

HeightMap crop_to_data(const HeightMap& map) {
  Span rows{map.grid.rows, -1}, cols{map.grid.cols, -1};
  for (const Index pixel : finite_pixels(map)) {
    const Index row = pixel / map.grid.cols, col = pixel % map.grid.cols;
    rows = {std::min(rows.first, row), std::max(rows.last, row)};
    cols = {std::min(cols.first, col), std::max(cols.last, col)};
  }
  if (rows.last < 0) throw InputError("crop to the data: the map has no finite pixel; at least one is required");
  return part_of(map, rows, cols);
}

}  // namespace dwell
