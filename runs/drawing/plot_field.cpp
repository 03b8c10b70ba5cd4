#include "runs/drawing/plot_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/median.h"

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

// What is kept of the blocks of one row of the figure.
struct Block {
  double sum = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  Index count = 0;

  void take(double v) {
    if (!std::isfinite(v)) return;
    sum += v;
    least = std::min(least, v);
    most = std::max(most, v);
    ++count;
  }
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : kNothing; }
  double farthest() const { return most - mean() >= mean() - least ? most : least; }

  static constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
};

// Rows of the map are read in their order, each once for every row of the figure that shows it.
std::vector<Block> blocks_of(const HeightMap& map, Span rows, const std::vector<Span>& across) {
  std::vector<Block> blocks(across.size());
  for (Index r = rows.first; r < rows.last; ++r) {
    for (std::size_t c = 0; c < across.size(); ++c) {
      for (Index k = across[c].first; k < across[c].last; ++k) blocks[c].take(map.at(r, k));
    }
  }
  return blocks;
}

// Shows the height of a block that is farthest from its mean instead of the mean, where it stands out.
void keep_peaks(PlotField& field, const std::vector<double>& farthest) {
  std::vector<double> distances;
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  for (std::size_t i = 0; i < farthest.size(); ++i) {
    const double mean = field.values[i];
    if (std::isnan(mean)) continue;
    lower = std::min(lower, mean);
    upper = std::max(upper, mean);
    distances.push_back(std::abs(farthest[i] - mean));
  }
  const double typical = distances.empty() ? 0.0 : upper_median(std::move(distances));
  const double least = std::max(kPeakOverTypical * typical, kPeakOverSpan * (upper - lower));
  for (std::size_t i = 0; i < farthest.size(); ++i) {
    if (std::abs(farthest[i] - field.values[i]) > least) field.values[i] = farthest[i];
  }
}

// Pixels of the figure per mm.
double figure_scale(const Grid& grid, const FieldEdges& edges) {
  const double fine = std::min(grid.pitch_x, grid.pitch_y);
  const double longer = std::max(grid.width(), grid.height());
  const double shorter = std::min(grid.width(), grid.height());
  const double target = longer >= kLongAspect * shorter ? edges.longest : edges.square;
  const double enlarged = target * fine / longer;
  return (enlarged >= 1.0 ? std::floor(enlarged) : enlarged) / fine;
}

}  // namespace

PlotField field_of_map(const HeightMap& map, const FieldEdges& edges, const Progress& progress) {
  const Grid& g = map.grid;
  const double scale = figure_scale(g, edges);
  PlotField field;
  field.cols = std::max(kThinnestEdge, static_cast<int>(std::lround(g.width() * scale)));
  field.rows = std::max(kThinnestEdge, static_cast<int>(std::lround(g.height() * scale)));
  field.left = g.origin.x - 0.5 * g.pitch_x;
  field.right = field.left + g.width();
  field.bottom = g.origin.y - 0.5 * g.pitch_y;
  field.top = field.bottom + g.height();
  const std::size_t pixels = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  field.values.reserve(pixels);
  std::vector<double> farthest;
  farthest.reserve(pixels);

  const std::vector<Span> across = share(g.cols, field.cols), up = share(g.rows, field.rows);
  for (const Span& rows : up) {
    progress.check();
    for (const Block& block : blocks_of(map, rows, across)) {
      field.values.push_back(block.mean());
      farthest.push_back(block.farthest());
    }
  }
  keep_peaks(field, farthest);
  return field;
}

}  // namespace dwell
