// field_of_dwell: the mosaic of squares that shows a path's dwell.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/numerics/median.h"
#include "runs/drawing/plot_field.h"

namespace dwell {
namespace {

constexpr double kWidestSquare = 400.0;  // pixels; also the square of a point alone, which is drawn 1 mm wide
constexpr double kOverlap = 1.75;        // side of a square over its spacing: closes the gaps of uneven paths
constexpr std::size_t kPointsBetweenChecks = 1000000;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The dwell points that fall on one pixel.
struct Seed {
  int col = 0;
  int row = 0;
  double dwell = 0.0;    // mean [s]
  double spacing = 0.0;  // to the neighbours [pixels]
};

struct Extent {
  Point low{kInfinity, kInfinity};
  Point high{-kInfinity, -kInfinity};
};

Extent bounding_box(const ToolPath& path) {
  Extent box;
  for (const Point p : path.points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

// Pixels of the figure per mm such that the box and half a spacing around it have about the edge of a plot.
double dwell_scale(const Extent& box, std::size_t points, const FieldEdges& edges) {
  const Point size = box.high - box.low;
  const double longer = std::max(size.x, size.y);
  const double shorter = std::min(size.x, size.y);
  if (!(longer > 0.0)) return kWidestSquare;
  const double target = longer >= kLongAspect * shorter ? edges.longest : edges.square;
  const double intervals = std::max(1.0, std::sqrt(static_cast<double>(points)) - 1.0);
  return target / (longer * (1.0 + 1.0 / intervals));
}

std::vector<Seed> seeds_of(const ToolPath& path, const std::vector<double>& dwell, const Extent& box, double scale,
                           int cols, int rows, const Progress& progress) {
  std::vector<double> sum(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows), 0.0);
  std::vector<int> count(sum.size(), 0);
  for (std::size_t j = 0; j < path.size(); ++j) {
    if (j % kPointsBetweenChecks == 0) progress.check();
    if (!std::isfinite(dwell[j])) continue;
    const auto col = std::lround((path.points[j].x - box.low.x) * scale);
    const auto row = std::lround((path.points[j].y - box.low.y) * scale);
    const std::size_t at = static_cast<std::size_t>(row * cols + col);
    sum[at] += dwell[j];
    ++count[at];
  }
  std::vector<Seed> seeds;
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const std::size_t at =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(col);
      if (count[at] > 0) seeds.push_back({col, row, sum[at] / count[at], 0.0});
    }
  }
  return seeds;
}

// Seeds in square buckets, about two each, listed bucket after bucket.
class Buckets {
 public:
  Buckets(const std::vector<Seed>& seeds, int cols, int rows) : seeds_(seeds) {
    const double area = static_cast<double>(cols) * static_cast<double>(rows);
    edge_ = std::max(1, static_cast<int>(std::ceil(std::sqrt(2.0 * area / static_cast<double>(seeds.size())))));
    across_ = (cols - 1) / edge_ + 1;
    up_ = (rows - 1) / edge_ + 1;
    begin_.assign(static_cast<std::size_t>(across_) * static_cast<std::size_t>(up_) + 1, 0);
    for (const Seed& s : seeds) ++begin_[bucket(s.col / edge_, s.row / edge_) + 1];
    for (std::size_t b = 1; b < begin_.size(); ++b) begin_[b] += begin_[b - 1];
    members_.resize(seeds.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      members_[next[bucket(seeds[i].col / edge_, seeds[i].row / edge_)]++] = i;
    }
  }

  // Third smallest of the distances to the nearest seed in each quadrant, or the largest there is; infinite if no
  // seed lies within the search, eight buckets each way.
  double spacing(const Seed& at) const {
    std::array<double, 4> squared;
    squared.fill(kInfinity);
    for (int ring = 0; ring <= 8; ++ring) {
      visit_ring(at, ring, squared);
      std::array<double, 4> sorted = squared;
      std::sort(sorted.begin(), sorted.end());
      const double reach = static_cast<double>(ring) * edge_;
      if (sorted[2] <= reach * reach) return std::sqrt(sorted[2]);
    }
    std::sort(squared.begin(), squared.end());
    for (const int k : {2, 1}) {
      if (std::isfinite(squared[static_cast<std::size_t>(k)])) return std::sqrt(squared[static_cast<std::size_t>(k)]);
    }
    return std::sqrt(squared[0]);
  }

 private:
  std::size_t bucket(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(x);
  }

  void visit_ring(const Seed& at, int ring, std::array<double, 4>& squared) const {
    const int x = at.col / edge_;
    const int y = at.row / edge_;
    for (int by = std::max(0, y - ring); by <= std::min(up_ - 1, y + ring); ++by) {
      const bool whole_row = by == y - ring || by == y + ring;
      const int stride = whole_row || ring == 0 ? 1 : 2 * ring;
      for (int bx = x - ring; bx <= x + ring; bx += stride) {
        if (bx < 0 || bx >= across_) continue;
        visit(at, bucket(bx, by), squared);
      }
    }
  }

  void visit(const Seed& at, std::size_t b, std::array<double, 4>& squared) const {
    for (std::size_t m = begin_[b]; m < begin_[b + 1]; ++m) {
      const Seed& other = seeds_[members_[m]];
      const int dx = other.col - at.col;
      const int dy = other.row - at.row;
      if (dx == 0 && dy == 0) continue;
      // Half-open quadrants: each axis belongs to the one that follows it anticlockwise.
      const std::size_t quadrant = dx > 0 && dy >= 0 ? 0 : dx <= 0 && dy > 0 ? 1 : dx < 0 ? 2 : 3;
      squared[quadrant] = std::min(squared[quadrant], static_cast<double>(dx) * dx + static_cast<double>(dy) * dy);
    }
  }

  const std::vector<Seed>& seeds_;
  int edge_ = 1;
  int across_ = 1;
  int up_ = 1;
  std::vector<std::size_t> begin_;
  std::vector<std::size_t> members_;
};

// Sets every spacing; returns their median. A spacing far above it (a point at the end of a gap) is cut to 1.5 times
// it.
double set_spacings(std::vector<Seed>& seeds, int cols, int rows) {
  const Buckets buckets(seeds, cols, rows);
  std::vector<double> known;
  known.reserve(seeds.size());
  for (Seed& s : seeds) {
    s.spacing = buckets.spacing(s);
    if (std::isfinite(s.spacing)) known.push_back(s.spacing);
  }
  const double median = known.empty() ? kWidestSquare : std::min(upper_median(std::move(known)), kWidestSquare);
  for (Seed& s : seeds) {
    s.spacing = std::isfinite(s.spacing) ? std::min({s.spacing, 1.5 * median, kWidestSquare}) : median;
  }
  return median;
}

void paint(const std::vector<Seed>& seeds, int margin, PlotField& field) {
  std::vector<float> nearest(field.values.size(), std::numeric_limits<float>::infinity());
  for (const Seed& s : seeds) {
    const int half = static_cast<int>(0.5 * kOverlap * s.spacing) + 2;  // both positions are rounded to pixels
    const int col = s.col + margin;
    const int row = s.row + margin;
    for (int r = std::max(0, row - half); r <= std::min(field.rows - 1, row + half); ++r) {
      for (int c = std::max(0, col - half); c <= std::min(field.cols - 1, col + half); ++c) {
        const auto squared = static_cast<float>((r - row) * (r - row) + (c - col) * (c - col));
        float& best = nearest[field.index(r, c)];
        if (!(squared < best)) continue;
        best = squared;
        field.at(r, c) = s.dwell;
      }
    }
  }
}

}  // namespace

PlotField field_of_dwell(const ToolPath& path, const std::vector<double>& dwell, const FieldEdges& edges,
                         const Progress& progress) {
  validate(path);
  if (dwell.size() != path.size()) {
    throw InputError(
        fmt::format("{} for a path of {} points; one each required", counted(dwell.size(), "dwell time"), path.size()));
  }
  const Extent box = bounding_box(path);
  const double scale = dwell_scale(box, path.size(), edges);
  const int cols = static_cast<int>(std::lround((box.high.x - box.low.x) * scale)) + 1;
  const int rows = static_cast<int>(std::lround((box.high.y - box.low.y) * scale)) + 1;
  std::vector<Seed> seeds = seeds_of(path, dwell, box, scale, cols, rows, progress);
  progress.check();
  const double spacing = seeds.empty() ? kWidestSquare : set_spacings(seeds, cols, rows);
  const int margin = static_cast<int>(0.5 * spacing) + 1;

  progress.check();
  PlotField field;
  field.cols = cols + 2 * margin;
  field.rows = rows + 2 * margin;
  field.left = box.low.x - (margin + 0.5) / scale;
  field.right = field.left + field.cols / scale;
  field.bottom = box.low.y - (margin + 0.5) / scale;
  field.top = field.bottom + field.rows / scale;
  field.values.assign(static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows),
                      std::numeric_limits<double>::quiet_NaN());
  paint(seeds, margin, field);
  return field;
}

}  // namespace dwell
