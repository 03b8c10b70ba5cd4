#include "core/scattered_removal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "core/bspline.h"
#include "core/stroke_quadrature.h"

namespace dwell {
namespace {

struct NodeWeight {
  std::int32_t node;
  double weight;
};

/// B-spline weights of one stroke on the lattice, one entry a node, ascending; nodes that no pixel feels are left out.
class StrokeSpreader {
 public:
  StrokeSpreader(const Grid& map, const PaddedConvolution& convolution) : map_(map), convolution_(convolution) {}

  const std::vector<NodeWeight>& spread(const Stroke& stroke) {
    points_.clear();
    entries_.clear();
    append_stroke_quadrature(stroke, map_, points_);
    for (const QuadraturePoint& q : points_) append(q);
    merge();
    return entries_;
  }

 private:
  void append(const QuadraturePoint& q) {
    const double u = (q.position.x - map_.origin.x) / map_.pitch_x;
    const double v = (q.position.y - map_.origin.y) / map_.pitch_y;
    const double fu = std::floor(u), fv = std::floor(v);
    constexpr double kFar = 1e9;  // beyond any lattice, and beyond what the conversion below can hold
    if (!(std::abs(fu) < kFar && std::abs(fv) < kFar)) return;
    const auto wx = bspline_weights(u - fu), wy = bspline_weights(v - fv);
    for (std::size_t i = 0; i < 4; ++i) {
      const Index row = static_cast<Index>(fv) - 1 + static_cast<Index>(i);
      for (std::size_t j = 0; j < 4; ++j) {
        const Index node = convolution_.node(row, static_cast<Index>(fu) - 1 + static_cast<Index>(j));
        if (node >= 0) entries_.push_back({static_cast<std::int32_t>(node), q.weight * wy[i] * wx[j]});
      }
    }
  }

  void merge() {
    std::sort(entries_.begin(), entries_.end(), [](const NodeWeight& a, const NodeWeight& b) {
      return a.node != b.node ? a.node < b.node : a.weight < b.weight;
    });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (kept > 0 && entries_[kept - 1].node == entries_[k].node) {
        entries_[kept - 1].weight += entries_[k].weight;
      } else {
        entries_[kept++] = entries_[k];
      }
    }
    entries_.resize(kept);
  }

  const Grid& map_;
  const PaddedConvolution& convolution_;
  std::vector<QuadraturePoint> points_;
  std::vector<NodeWeight> entries_;
};

/// Nodes are numbered in 32 bits.
void check_size(PaddedConvolution& convolution) {
  if (convolution.field().size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw std::length_error("padded map has more than 2^31 pixels");
  }
}

/// A run of neighbouring strokes, spread by one thread.
struct SpreadRun {
  SpreadRun(const Grid& map, const PaddedConvolution& convolution) : spreader(map, convolution) {}

  void spread(std::span<const Stroke> strokes) {
    entries.clear();
    ends.clear();
    for (const Stroke& stroke : strokes) {
      const auto& more = spreader.spread(stroke);
      entries.insert(entries.end(), more.begin(), more.end());
      ends.push_back(entries.size());
    }
  }

  StrokeSpreader spreader;
  std::vector<NodeWeight> entries;
  std::vector<std::size_t> ends;  // of the entries of each stroke
};

/// Calls take(entries) for one stroke after the other in path order, whatever the number of threads that spread them.
template <typename Take>
void spread_all(const Grid& map, const PaddedConvolution& convolution, const std::vector<Stroke>& strokes, int threads,
                const Take& take) {
  constexpr std::size_t kRun = 1024;  // strokes; their entries stay in the cache
  const int count = std::max(threads, 1);
  std::vector<SpreadRun> runs(static_cast<std::size_t>(count), SpreadRun(map, convolution));
  const std::span<const Stroke> all(strokes);
  for (std::size_t begin = 0; begin < all.size(); begin += kRun * runs.size()) {
#pragma omp parallel for num_threads(count) schedule(static, 1)
    for (int k = 0; k < count; ++k) {
      const std::size_t from = std::min(begin + kRun * static_cast<std::size_t>(k), all.size());
      runs[static_cast<std::size_t>(k)].spread(all.subspan(from, std::min(kRun, all.size() - from)));
    }
    for (const SpreadRun& run : runs) {
      const std::span<const NodeWeight> entries(run.entries);
      std::size_t first = 0;
      for (const std::size_t end : run.ends) {
        take(entries.subspan(first, end - first));
        first = end;
      }
    }
  }
}

}  // namespace

ScatteredRemoval::ScatteredRemoval(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                                   const std::vector<Stroke>& strokes, int threads)
    : RemovalOperator(static_cast<Index>(pixels.size()), static_cast<Index>(strokes.size())),
      convolution_(map, pixels, kernel.surface.coefficients(), kernel.half_rows, kernel.half_cols, threads),
      threads_(threads) {
  check_size(convolution_);
  by_stroke_.begin.reserve(strokes.size() + 1);
  by_stroke_.begin.push_back(0);
  spread_all(map, convolution_, strokes, threads, [this](std::span<const NodeWeight> entries) {
    for (const NodeWeight& entry : entries) {
      by_stroke_.index.push_back(entry.node);
      by_stroke_.weight.push_back(entry.weight);
    }
    by_stroke_.begin.push_back(static_cast<Index>(by_stroke_.index.size()));
  });
  transpose_weights();
}

void ScatteredRemoval::transpose_weights() {
  std::vector<std::int32_t> row_of(convolution_.field().size(), 0);
  for (std::int32_t node : by_stroke_.index) ++row_of[static_cast<std::size_t>(node)];
  by_node_.begin.push_back(0);
  for (std::size_t node = 0; node < row_of.size(); ++node) {
    if (row_of[node] == 0) continue;
    by_node_.begin.push_back(by_node_.begin.back() + row_of[node]);
    row_of[node] = static_cast<std::int32_t>(touched_.size());
    touched_.push_back(static_cast<std::int32_t>(node));
  }
  by_node_.index.resize(by_stroke_.index.size());
  by_node_.weight.resize(by_stroke_.weight.size());
  std::vector<Index> next(by_node_.begin.begin(), by_node_.begin.end() - 1);
  for (Index j = 0; j < cols(); ++j) {
    for (Index k = by_stroke_.begin[static_cast<std::size_t>(j)]; k < by_stroke_.begin[static_cast<std::size_t>(j) + 1];
         ++k) {
      const auto node = static_cast<std::size_t>(by_stroke_.index[static_cast<std::size_t>(k)]);
      const auto to = static_cast<std::size_t>(next[static_cast<std::size_t>(row_of[node])]++);
      by_node_.index[to] = static_cast<std::int32_t>(j);
      by_node_.weight[to] = by_stroke_.weight[static_cast<std::size_t>(k)];
    }
  }
}

void ScatteredRemoval::do_apply(const Vector& t, Vector& removal) {
  convolution_.clear_field();
  double* field = convolution_.field().data();
  const auto touched = static_cast<Index>(touched_.size());
  const double* dwell = t.data();
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (Index r = 0; r < touched; ++r) {
    double sum = 0.0;
    for (Index k = by_node_.begin[static_cast<std::size_t>(r)]; k < by_node_.begin[static_cast<std::size_t>(r) + 1];
         ++k) {
      sum += by_node_.weight[static_cast<std::size_t>(k)] * dwell[by_node_.index[static_cast<std::size_t>(k)]];
    }
    field[touched_[static_cast<std::size_t>(r)]] = sum;
  }
  convolution_.convolve(removal.data());
}

void ScatteredRemoval::do_apply_adjoint(const Vector& residual, Vector& t) {
  convolution_.correlate(residual.data());
  const double* field = convolution_.field().data();
  double* dwell = t.data();
  const Index n = cols();
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (Index j = 0; j < n; ++j) {
    double sum = 0.0;
    for (Index k = by_stroke_.begin[static_cast<std::size_t>(j)]; k < by_stroke_.begin[static_cast<std::size_t>(j) + 1];
         ++k) {
      sum += by_stroke_.weight[static_cast<std::size_t>(k)] * field[by_stroke_.index[static_cast<std::size_t>(k)]];
    }
    dwell[j] = sum;
  }
}

Vector removal_once(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                    const std::vector<Stroke>& strokes, const Vector& t, int threads) {
  if (t.size() != static_cast<Index>(strokes.size())) {
    throw std::invalid_argument("removal_once: one time a stroke is required");
  }
  PaddedConvolution convolution(map, pixels, kernel.surface.coefficients(), kernel.half_rows, kernel.half_cols,
                                threads);
  check_size(convolution);
  convolution.clear_field();
  double* field = convolution.field().data();
  Index j = 0;
  spread_all(map, convolution, strokes, threads, [&](std::span<const NodeWeight> entries) {
    for (const NodeWeight& entry : entries) field[entry.node] += entry.weight * t[j];
    ++j;
  });
  Vector removal(static_cast<Index>(pixels.size()));
  convolution.convolve(removal.data());
  return removal;
}

}  // namespace dwell
