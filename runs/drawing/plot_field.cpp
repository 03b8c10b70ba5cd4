#include "runs/drawing/plot_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dwell {
namespace {

constexpr int kThinnestEdge = 8;

// Source pixels [first, last) that one pixel of the picture shows.
struct Span {
  Index first = 0;
  Index last = 0;
};

// Shares `count` source pixels among `size` picture pixels: those whose centres fall on a picture pixel, or the
// nearest one where none does.
std::vector<Span> share(Index count, int size) {
  std::vector<Span> spans(static_cast<std::size_t>(size));
  const double ratio = static_cast<double>(count) / size;
  for (int i = 0; i < size; ++i) {
    Span& s = spans[static_cast<std::size_t>(i)];
    s.first = std::clamp<Index>(std::lround(std::ceil(ratio * i - 0.5 - 1e-9)), 0, count - 1);
    s.last = std::clamp<Index>(std::lround(std::ceil(ratio * (i + 1) - 0.5 - 1e-9)), 0, count);
    if (s.last <= s.first) {
      s.first = std::clamp<Index>(static_cast<Index>(std::floor(ratio * (i + 0.5))), 0, count - 1);
      s.last = s.first + 1;
    }
  }
  return spans;
}

double finite_mean(const HeightMap& map, Span rows, Span cols) {
  double sum = 0.0;
  Index count = 0;
  for (Index r = rows.first; r < rows.last; ++r) {
    for (Index c = cols.first; c < cols.last; ++c) {
      const double v = map.at(r, c);
      if (!std::isfinite(v)) continue;
      sum += v;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

// Picture pixels per mm.
double picture_scale(const Grid& grid) {
  const double fine = std::min(grid.pitch_x, grid.pitch_y);
  const double longer = std::max(grid.width(), grid.height());
  const double shorter = std::min(grid.width(), grid.height());
  const double edge = longer / fine;
  const double target = longer >= kLongAspect * shorter ? kLongPlotEdge : kPlotEdge;
  if (edge <= kLongPlotEdge) return std::max(1.0, std::floor(target / edge)) / fine;
  return 1.0 / (std::ceil(edge / kLongPlotEdge) * fine);
}

}  // namespace

PlotField field_of_map(const HeightMap& map) {
  const Grid& g = map.grid;
  const double scale = picture_scale(g);
  PlotField field;
  field.cols = std::max(kThinnestEdge, static_cast<int>(std::lround(g.width() * scale)));
  field.rows = std::max(kThinnestEdge, static_cast<int>(std::lround(g.height() * scale)));
  field.left = g.origin.x - 0.5 * g.pitch_x;
  field.right = field.left + g.width();
  field.bottom = g.origin.y - 0.5 * g.pitch_y;
  field.top = field.bottom + g.height();
  field.values.resize(static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows));

  const std::vector<Span> across = share(g.cols, field.cols);
  const std::vector<Span> up = share(g.rows, field.rows);
  for (int r = 0; r < field.rows; ++r) {
    for (int c = 0; c < field.cols; ++c) {
      field.at(r, c) = finite_mean(map, up[static_cast<std::size_t>(r)], across[static_cast<std::size_t>(c)]);
    }
  }
  return field;
}

}  // namespace dwell
