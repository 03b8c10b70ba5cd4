#include "core/removal/scattered_removal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "core/base/memory.h"
#include "core/motion/stroke_quadrature.h"
#include "core/numerics/bspline.h"

namespace dwell {
namespace {

struct NodeWeight {
  std::int32_t node;
  double weight;
};

/// Lattice nodes [first_row, last_row] x [first_col, last_col].
struct NodeBox {
  Index first_row, last_row, first_col, last_col;

  Index rows() const { return last_row - first_row + 1; }
  Index cols() const { return last_col - first_col + 1; }
  NodeBox with(const NodeBox& other) const {
    return {std::min(first_row, other.first_row), std::max(last_row, other.last_row),
            std::min(first_col, other.first_col), std::max(last_col, other.last_col)};
  }
};

/// B-spline weights of one stroke on the lattice, without nodes that reach no pixel. They are summed in a small box of
/// nodes, so a stroke that lies in one box has one entry for each node, in ascending order. A longer stroke is cut into
/// boxes, and nodes at the cuts have several entries.
class StrokeSpreader {
 public:
  StrokeSpreader(const Grid& map, const PaddedConvolution& convolution)
      : map_(map), convolution_(convolution), reach_(reach_of(map, convolution)) {}

  /// Appends the entries of a stroke.
  void spread(const Stroke& stroke, std::vector<NodeWeight>& entries) {
    points_.clear();
    append_stroke_quadrature(stroke, map_, reach_, points_);
    supports_.clear();
    for (const QuadraturePoint& q : points_) add_support(q);
    for (std::size_t begin = 0; begin < supports_.size();) begin = spread_box(begin, entries);
  }

 private:
  /// The 4 x 4 nodes that a quadrature point reaches.
  struct Support {
    NodeBox box;
    std::array<double, 4> wx, wy;  // wy with the point's own weight
  };

  /// Where a point must lie to reach a node that a pixel feels: a point reaches two nodes on either side.
  static LatticeBox reach_of(const Grid& map, const PaddedConvolution& convolution) {
    const auto beyond_x = static_cast<double>(convolution.half_cols() + 2),
               beyond_y = static_cast<double>(convolution.half_rows() + 2);
    return {-beyond_x, static_cast<double>(map.cols - 1) + beyond_x, -beyond_y,
            static_cast<double>(map.rows - 1) + beyond_y};
  }

  void add_support(const QuadraturePoint& q) {
    const double u = (q.position.x - map_.origin.x) / map_.pitch_x;
    const double v = (q.position.y - map_.origin.y) / map_.pitch_y;
    const double fu = std::floor(u), fv = std::floor(v);
    const auto row = static_cast<Index>(fv), col = static_cast<Index>(fu);
    Support support{{row - 1, row + 2, col - 1, col + 2}, bspline_weights(u - fu), bspline_weights(v - fv)};
    for (double& w : support.wy) w *= q.weight;
    supports_.push_back(support);
  }

  /// Spreads those supports from `begin` on that fit into one box of at most kCells nodes; returns the first that does
  /// not.
  std::size_t spread_box(std::size_t begin, std::vector<NodeWeight>& entries) {
    constexpr Index kCells = 1024;
    NodeBox box = supports_[begin].box;
    std::size_t end = begin + 1;
    for (; end < supports_.size(); ++end) {
      const NodeBox wider = box.with(supports_[end].box);
      if (wider.rows() * wider.cols() > kCells) break;
      box = wider;
    }
    const Index cols = box.cols();
    cells_.assign(static_cast<std::size_t>(box.rows() * cols), 0.0);
    for (std::size_t k = begin; k < end; ++k) {
      const Support& s = supports_[k];
      double* cell = cells_.data() + (s.box.first_row - box.first_row) * cols + (s.box.first_col - box.first_col);
      for (std::size_t i = 0; i < 4; ++i, cell += cols) {
        for (std::size_t j = 0; j < 4; ++j) cell[j] += s.wy[i] * s.wx[j];
      }
    }
    const double* cell = cells_.data();
    for (Index row = box.first_row; row <= box.last_row; ++row) {
      for (Index col = box.first_col; col <= box.last_col; ++col, ++cell) {
        if (!(*cell > 0.0)) continue;
        const Index node = convolution_.node(row, col);
        if (node >= 0) entries.push_back({static_cast<std::int32_t>(node), *cell});
      }
    }
    return end;
  }

  const Grid& map_;
  const PaddedConvolution& convolution_;
  LatticeBox reach_;
  std::vector<QuadraturePoint> points_;
  std::vector<Support> supports_;
  std::vector<double> cells_;
};

/// Nodes are numbered in 32 bits.
void check_size(PaddedConvolution& convolution) {
  if (convolution.field().size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw std::length_error("padded map has more than 2^31 pixels");
  }
}

// Blocks of strokes, each of which may scatter into a field of its own.
constexpr Index kBlocks = 16;

Index block_begin(Index block, Index strokes) { return block * strokes / kBlocks; }

/// Whether fields for all blocks are small beside the weights, which then need not be held by node as well.
bool scatters_in_blocks(PaddedConvolution& convolution, double weights) {
  constexpr double kSmall = 0.25;
  return static_cast<double>(convolution.field().size()) * static_cast<double>(kBlocks) < kSmall * weights;
}

/// A run of neighbouring strokes, spread by one thread.
struct SpreadRun {
  SpreadRun(const Grid& map, const PaddedConvolution& convolution) : spreader(map, convolution) {}

  void spread(std::span<const Stroke> strokes) {
    entries.clear();
    ends.clear();
    for (const Stroke& stroke : strokes) {
      spreader.spread(stroke, entries);
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
  constexpr std::size_t kRun = 8192;  // strokes; a few MB of entries, and few barriers
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

/// The entries of a stroke on average, from strokes evenly spread over the path.
double entries_a_stroke(const Grid& map, const PaddedConvolution& convolution, const std::vector<Stroke>& strokes) {
  constexpr std::size_t kSample = 2048;
  const std::size_t step = std::max<std::size_t>(1, strokes.size() / kSample);
  StrokeSpreader spreader(map, convolution);
  std::vector<NodeWeight> entries;
  std::size_t sampled = 0;
  for (std::size_t k = 0; k < strokes.size(); k += step, ++sampled) spreader.spread(strokes[k], entries);
  return sampled == 0 ? 0.0 : static_cast<double>(entries.size()) / static_cast<double>(sampled);
}

}  // namespace

ScatteredRemoval::ScatteredRemoval(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                                   const std::vector<Stroke>& strokes, int threads)
    : RemovalOperator(static_cast<Index>(pixels.size()), static_cast<Index>(strokes.size())),
      convolution_(map, pixels, kernel.surface.coefficients(), kernel.half_rows, kernel.half_cols, threads),
      threads_(threads) {
  check_size(convolution_);
  const double weights = entries_a_stroke(map, convolution_, strokes) * static_cast<double>(strokes.size());
  const bool blocks = scatters_in_blocks(convolution_, weights);
  reserve_weights(weights, blocks ? 1.0 : 2.0);
  by_stroke_.begin.reserve(strokes.size() + 1);
  by_stroke_.begin.push_back(0);
  spread_all(map, convolution_, strokes, threads, [this](std::span<const NodeWeight> entries) {
    for (const NodeWeight& entry : entries) {
      by_stroke_.index.push_back(entry.node);
      by_stroke_.weight.push_back(entry.weight);
    }
    by_stroke_.begin.push_back(static_cast<Index>(by_stroke_.index.size()));
  });
  if (blocks) {
    block_fields_.resize(static_cast<std::size_t>(kBlocks) * convolution_.field().size());
  } else {
    transpose_weights();
  }
}

void ScatteredRemoval::reserve_weights(double expected, double orders) {
  // A little less is asked for than is expected, so that nothing is refused that would just fit.
  constexpr double kBytes = sizeof(std::int32_t) + sizeof(double), kCertain = 0.95, kRoom = 1.02;
  require_memory(kCertain * kBytes * orders * expected, fmt::format("the removal operator of {} dwell points", cols()));
  // A vector that grows by itself holds up to three times its values for a while.
  by_stroke_.index.reserve(static_cast<std::size_t>(kRoom * expected));
  by_stroke_.weight.reserve(static_cast<std::size_t>(kRoom * expected));
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
  block_fields_.empty() ? gather_by_node(t) : scatter_in_blocks(t);
  convolution_.convolve(removal.data());
}

void ScatteredRemoval::gather_by_node(const Vector& t) {
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
}

void ScatteredRemoval::scatter_in_blocks(const Vector& t) {
  const std::span<double> field = convolution_.field();
  const auto nodes = static_cast<Index>(field.size());
#pragma omp parallel num_threads(threads_)
  {
#pragma omp for schedule(static, 1)
    for (Index b = 0; b < kBlocks; ++b) {
      double* own = block_fields_.data() + b * nodes;
      std::fill(own, own + nodes, 0.0);
      const Index end = block_begin(b + 1, cols());
      for (Index j = block_begin(b, cols()); j < end; ++j) {
        const Index last = by_stroke_.begin[static_cast<std::size_t>(j) + 1];
        for (Index k = by_stroke_.begin[static_cast<std::size_t>(j)]; k < last; ++k)
          own[by_stroke_.index[static_cast<std::size_t>(k)]] += by_stroke_.weight[static_cast<std::size_t>(k)] * t[j];
      }
    }
#pragma omp for schedule(static)
    for (Index node = 0; node < nodes; ++node) {
      double sum = 0.0;
      for (Index b = 0; b < kBlocks; ++b) sum += block_fields_[static_cast<std::size_t>(b * nodes + node)];
      field[static_cast<std::size_t>(node)] = sum;
    }
  }
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

Vector scattered_removal_once(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                              const std::vector<Stroke>& strokes, const Vector& t, int threads) {
  if (t.size() != static_cast<Index>(strokes.size())) {
    throw std::invalid_argument("scattered_removal_once: one time a stroke is required");
  }
  PaddedConvolution convolution(map, pixels, kernel.surface.coefficients(), kernel.half_rows, kernel.half_cols,
                                threads);
  check_size(convolution);
  convolution.clear_field();
  const std::span<double> field = convolution.field();
  const double weights = entries_a_stroke(map, convolution, strokes) * static_cast<double>(strokes.size());
  std::vector<double> own(scatters_in_blocks(convolution, weights) ? field.size() : 0, 0.0);
  double* to = own.empty() ? field.data() : own.data();
  Index j = 0, block = 0;
  spread_all(map, convolution, strokes, threads, [&](std::span<const NodeWeight> entries) {
    for (const NodeWeight& entry : entries) to[entry.node] += entry.weight * t[j];
    ++j;
    if (own.empty() || j != block_begin(block + 1, t.size())) return;
    for (std::size_t node = 0; node < own.size(); ++node) field[node] += own[node];
    std::fill(own.begin(), own.end(), 0.0);
    while (block < kBlocks && block_begin(block + 1, t.size()) == j) ++block;
  });
  Vector removal(static_cast<Index>(pixels.size()));
  convolution.convolve(removal.data());
  return removal;
}

}  // namespace dwell
