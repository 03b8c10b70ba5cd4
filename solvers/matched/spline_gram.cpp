#include "solvers/matched/spline_gram.h"

#include <algorithm>

#include "core/numerics/bspline.h"
#include "solvers/problem/simd.h"

namespace dwell {
namespace {

/// What is taken of the splines along one axis.
enum class Along { Value, Slope, Step };

/// The weights on its four nodes of a map line, k pixels beyond the second of them. A step from there ends at the third
/// node at the latest, where these four still are all that count.
std::array<double, 4> line_weights(Index k, Index factor, Along take) {
  const double f = static_cast<double>(k) / static_cast<double>(factor), g = 1.0 - f;
  if (take == Along::Value) return bspline_weights(f);
  if (take == Along::Step) {
    const std::array<double, 4> from = bspline_weights(f),
                                to = bspline_weights(static_cast<double>(k + 1) / static_cast<double>(factor));
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2], to[3] - from[3]};
  }
  const double per_pixel = 1.0 / static_cast<double>(factor);
  return {-0.5 * g * g * per_pixel, (1.5 * f - 2.0) * f * per_pixel, (2.0 - 1.5 * g) * g * per_pixel,
          0.5 * f * f * per_pixel};
}

/// Position of (a, b) in the upper triangle of a symmetric 4 x 4 table, row by row.
constexpr std::size_t triangle(std::size_t a, std::size_t b) {
  if (a > b) return triangle(b, a);
  return a * 4 - a * (a + 1) / 2 + b;
}

std::vector<std::array<double, 10>> products_by_phase(Index factor, Along take) {
  std::vector<std::array<double, 10>> result(static_cast<std::size_t>(factor));
  for (Index k = 0; k < factor; ++k) {
    const auto w = line_weights(k, factor, take);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a; b < 4; ++b) result[static_cast<std::size_t>(k)][triangle(a, b)] = w[a] * w[b];
    }
  }
  return result;
}

}  // namespace

SplineGram::SplineGram(const Grid& map, CoarseFactor factor, int threads)
    : map_(map),
      lattice_(lattice_of(map, factor)),
      factor_(factor),
      sampling_(map, factor, threads),
      threads_(threads) {
  stencil_.assign(static_cast<std::size_t>(lattice_.size() * kWidth * kWidth), 0.0F);
}

// A band, the pixels between two coarse rows, adds to four rows of stencils. Blocks of bands are at least so long that
// every other one shares no row with the next but one: first these at once, then the others.
void SplineGram::add(const std::vector<Index>& pixels, const Vector& weights, Take take, double scale) {
  constexpr Index kBlock = 8;
  const auto along = [take](Take slope, Take step) {
    return take == slope ? Along::Slope : take == step ? Along::Step : Along::Value;
  };
  const Products along_x = products_by_phase(factor_.x, along(Take::SlopeX, Take::StepX));
  const Products along_y = products_by_phase(factor_.y, along(Take::SlopeY, Take::StepY));
  const Addend addend{pixels, weights, scale, along_x, along_y};
  const Index bands = (map_.rows + factor_.y - 1) / factor_.y, blocks = (bands + kBlock - 1) / kBlock;
  for (const Index first : {Index{0}, Index{1}}) {
#pragma omp parallel for num_threads(threads_) schedule(static, 1)
    for (Index block = first; block < blocks; block += 2)
      add_bands(addend, block * kBlock, std::min(bands, (block + 1) * kBlock));
  }
}

// The weights are products of x and y, so sums are gathered first along a row of pixels within one coarse column (10
// products), then over the rows within one coarse row (10 x 10), and only then scattered.
void SplineGram::add_bands(const Addend& addend, Index first, Index last) {
  const std::vector<Index>& pixels = addend.pixels;
  Products row_sums(static_cast<std::size_t>(lattice_.cols));
  std::vector<char> touched(row_sums.size());
  Cells cells(row_sums.size());
  for (auto& cell : cells) cell.fill(0.0);
  const auto index_of_row = [&](Index row) {
    return static_cast<std::size_t>(std::lower_bound(pixels.begin(), pixels.end(), row * map_.cols) - pixels.begin());
  };
  Index band = first;
  const std::size_t end = index_of_row(last * factor_.y);
  for (std::size_t i = index_of_row(first * factor_.y); i < end;) {
    const Index row = pixels[i] / map_.cols;
    if (row / factor_.y != band) add_band(cells, band);
    band = row / factor_.y;
    for (auto& sums : row_sums) sums.fill(0.0);
    std::fill(touched.begin(), touched.end(), char{0});
    for (; i < end && pixels[i] / map_.cols == row; ++i) {
      const Index col = pixels[i] % map_.cols;
      const double w = addend.scale * (addend.weights.size() == 0 ? 1.0 : addend.weights[static_cast<Index>(i)]);
      const auto cell = static_cast<std::size_t>(col / factor_.x);
      const auto& x = addend.along_x[static_cast<std::size_t>(col % factor_.x)];
      touched[cell] = 1;
      for (std::size_t k = 0; k < 10; ++k) row_sums[cell][k] += w * x[k];
    }
    const auto& y = addend.along_y[static_cast<std::size_t>(row % factor_.y)];
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (!touched[c]) continue;
      for (std::size_t j = 0; j < 10; ++j) {
        for (std::size_t k = 0; k < 10; ++k) cells[c][j * 10 + k] += y[j] * row_sums[c][k];
      }
    }
  }
  add_band(cells, band);
}

/// Scatters the sums of one coarse row of cells and clears them.
void SplineGram::add_band(Cells& cells, Index first_row) {
  for (Index c = 0; c + 3 < lattice_.cols; ++c) {
    auto& cell = cells[static_cast<std::size_t>(c)];
    for (Index ij = 0; ij < 16; ++ij) {
      const Index i = ij / 4, j = ij % 4;
      for (Index ab = 0; ab < 16; ++ab) {
        const Index a = ab / 4, b = ab % 4;
        const Index offset = (j - i + kReach) * kWidth + (b - a + kReach);
        stencil_[static_cast<std::size_t>(((first_row + i) * kWidth * kWidth + offset) * lattice_.cols + c + a)] +=
            static_cast<float>(cell[triangle(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) * 10 +
                                    triangle(static_cast<std::size_t>(a), static_cast<std::size_t>(b))]);
      }
    }
    cell.fill(0.0);
  }
}

void SplineGram::apply(const Vector& d, Vector& out) const {
  out.resize(lattice_.size());
  apply_to_stretch(d, out);
}

void SplineGram::apply_to_stretch(const Eigen::Ref<const Vector>& d, Eigen::Ref<Vector> out) const {
  constexpr Index kWorthThreads = 8000;  // nodes
#pragma omp parallel for num_threads(threads_) schedule(static) if (threads_ > 1 && lattice_.size() >= kWorthThreads)
  for (Index r = 0; r < lattice_.rows; ++r) apply_row(r, d.data(), out.data());
}

namespace {

DWELL_SIMD void add_product(const float* a, const double* b, double* to, Index n) {
  for (Index i = 0; i < n; ++i) to[i] += static_cast<double>(a[i]) * b[i];
}

}  // namespace

void SplineGram::apply_row(Index r, const double* d, double* out) const {
  const Index cols = lattice_.cols;
  double* to = out + r * cols;
  std::fill(to, to + cols, 0.0);
  for (Index dy = std::max(-kReach, -r); dy <= std::min(kReach, lattice_.rows - 1 - r); ++dy) {
    const double* from = d + (r + dy) * cols;
    for (Index dx = -kReach; dx <= kReach; ++dx) {
      const float* s = stencil_.data() + ((r * kWidth + dy + kReach) * kWidth + dx + kReach) * cols;
      const Index begin = std::max<Index>(0, -dx), end = std::min(cols, cols - dx);
      add_product(s + begin, from + begin + dx, to + begin, end - begin);
    }
  }
}

}  // namespace dwell
