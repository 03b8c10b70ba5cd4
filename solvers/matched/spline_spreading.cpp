#include "solvers/matched/spline_spreading.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/numerics/bspline.h"
#include "solvers/problem/simd.h"

namespace dwell {
namespace {

constexpr double kLongestPiece = 0.25;  // of the pitch
constexpr double kMostPieces = 1e5;     // of a stroke: as long as a hundred lattices
constexpr Index kWorthThreads = 20000;  // strokes

/// The point a share of the way along the stroke.
Point along(const Stroke& s, double share) {
  const double first = distance(s.start, s.via), second = distance(s.via, s.finish), at = share * (first + second);
  if (at <= first) return first > 0.0 ? s.start + (at / first) * (s.via - s.start) : s.via;
  return s.via + ((at - first) / second) * (s.finish - s.via);
}

/// Whether some of the stroke may lie on the lattice: what lies beyond is moved to its edge (dwell_lattice), where one
/// place does for all of it.
bool may_touch(const Grid& lattice, const Stroke& s) {
  const auto [low_x, high_x] = std::minmax({s.start.x, s.via.x, s.finish.x});
  const auto [low_y, high_y] = std::minmax({s.start.y, s.via.y, s.finish.y});
  return high_x >= lattice.x(0) && low_x <= lattice.x(lattice.cols - 1) && high_y >= lattice.y(0) &&
         low_y <= lattice.y(lattice.rows - 1);
}

}  // namespace

SplineSpreading::SplineSpreading(const Grid& lattice, const std::vector<Stroke>& strokes, StrokePart part, int threads)
    : lattice_(lattice), weights_(kPhases + 1), threads_(threads) {
  if (lattice.size() > std::numeric_limits<std::int32_t>::max()) throw std::length_error("lattice has too many nodes");
  for (int k = 0; k <= kPhases; ++k) {
    const auto w = bspline_weights(static_cast<double>(k) / kPhases);
    for (std::size_t i = 0; i < 4; ++i) weights_[static_cast<std::size_t>(k)][i] = static_cast<float>(w[i]);
  }
  begin_.reserve(strokes.size() + 1);
  places_.reserve(strokes.size());
  begin_.push_back(0);
  const double longest = kLongestPiece * std::min(lattice.pitch_x, lattice.pitch_y);
  for (const Stroke& s : strokes) {
    const double length = part == StrokePart::Whole && may_touch(lattice, s) ? s.length() : 0.0;
    const int pieces = static_cast<int>(std::clamp(std::ceil(length / longest), 1.0, kMostPieces));
    for (int k = 0; k < pieces; ++k) append(length > 0.0 ? along(s, (k + 0.5) / pieces) : s.via);
    if (places_.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
      throw std::length_error("path has too many points on the lattice");
    begin_.push_back(static_cast<std::int32_t>(places_.size()));
  }
  if (threads_ > 1 && this->strokes() >= kWorthThreads)
    partial_.assign(static_cast<std::size_t>(threads_ - 1), Vector(lattice_.size()));
}

void SplineSpreading::append(Point p) {
  const double u = (p.x - lattice_.origin.x) / lattice_.pitch_x, v = (p.y - lattice_.origin.y) / lattice_.pitch_y;
  const double fu = std::clamp(std::floor(u), 1.0, static_cast<double>(lattice_.cols - 3));
  const double fv = std::clamp(std::floor(v), 1.0, static_cast<double>(lattice_.rows - 3));
  const auto phase = [](double f) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(f, 0.0, 1.0) * kPhases));
  };
  places_.push_back(
      {static_cast<std::int32_t>((static_cast<Index>(fv) - 1) * lattice_.cols + static_cast<Index>(fu) - 1),
       phase(u - fu), phase(v - fv)});
}

DWELL_SIMD void SplineSpreading::spread_range(const double* dwell, Index from, Index to, double* nodes) const {
  const Index cols = lattice_.cols;
  for (Index j = from; j < to; ++j) {
    const std::int32_t begin = begin_[static_cast<std::size_t>(j)], end = begin_[static_cast<std::size_t>(j) + 1];
    const double value = dwell[j] / static_cast<double>(end - begin);
    for (std::int32_t k = begin; k < end; ++k) {
      const Place at = places_[static_cast<std::size_t>(k)];
      const auto &x = weights_[at.x], &y = weights_[at.y];
      double* node = nodes + at.first;
      for (std::size_t r = 0; r < 4; ++r, node += cols) {
        const double row = value * static_cast<double>(y[r]);
        for (std::size_t c = 0; c < 4; ++c) node[c] += row * static_cast<double>(x[c]);
      }
    }
  }
}

void SplineSpreading::spread(const Eigen::Ref<const Vector>& t, Vector& nodes) {
  nodes.setZero(lattice_.size());
  if (partial_.empty()) {
    spread_range(t.data(), 0, strokes(), nodes.data());
    return;
  }
  // A lattice of its own for every thread: cheap, since the lattice is coarse, and the order of summation is fixed.
#pragma omp parallel for num_threads(threads_) schedule(static, 1)
  for (int k = 0; k < threads_; ++k) {
    Vector& to = k == 0 ? nodes : partial_[static_cast<std::size_t>(k - 1)];
    if (k > 0) to.setZero();
    spread_range(t.data(), strokes() * k / threads_, strokes() * (k + 1) / threads_, to.data());
  }
  for (const Vector& part : partial_) nodes += part;
}

void SplineSpreading::gather(const Eigen::Ref<const Vector>& nodes, Eigen::Ref<Vector> t) const {
  const int parts = partial_.empty() ? 1 : threads_;
#pragma omp parallel for num_threads(parts) schedule(static, 1) if (parts > 1)
  for (int k = 0; k < parts; ++k)
    gather_range(nodes.data(), strokes() * k / parts, strokes() * (k + 1) / parts, t.data());
}

DWELL_SIMD void SplineSpreading::gather_range(const double* nodes, Index from, Index to, double* t) const {
  const Index cols = lattice_.cols;
  for (Index j = from; j < to; ++j) {
    const std::int32_t begin = begin_[static_cast<std::size_t>(j)], end = begin_[static_cast<std::size_t>(j) + 1];
    double sum = 0.0;
    for (std::int32_t k = begin; k < end; ++k) {
      const Place at = places_[static_cast<std::size_t>(k)];
      const auto &x = weights_[at.x], &y = weights_[at.y];
      const double* node = nodes + at.first;
      std::array<double, 4> row{};
      for (std::size_t r = 0; r < 4; ++r, node += cols) {
        for (std::size_t c = 0; c < 4; ++c) row[c] += static_cast<double>(y[r]) * node[c];
      }
      for (std::size_t c = 0; c < 4; ++c) sum += static_cast<double>(x[c]) * row[c];
    }
    t[j] = sum / static_cast<double>(end - begin);
  }
}

DwellLattice dwell_lattice(const RemovalGeometry& g, CoarseFactor factor) {
  /// First and last cell of the coarse lattice along one axis that holds a stroke.
  struct Range {
    double origin, pitch, least, most;
    double first = std::numeric_limits<double>::infinity(), last = -first;

    // Three cells beyond the reach of the kernel: a stroke moved there stands on nodes that no pixel feels.
    Range(double map_origin, double map_pitch, Index pixels, Index reach, Index step)
        : origin(map_origin),
          pitch(map_pitch * static_cast<double>(step)),
          least(-std::ceil(static_cast<double>(reach) / static_cast<double>(step)) - 3.0),
          most(std::ceil(static_cast<double>(pixels + reach) / static_cast<double>(step)) + 3.0) {}
    void take(double at) {
      const double cell = std::clamp(std::floor((at - origin) / pitch), least, most);
      first = std::min(first, cell);
      last = std::max(last, cell);
    }
  };
  Range y(g.lattice.origin.y, g.lattice.pitch_y, g.lattice.rows, g.kernel.half_rows, factor.y);
  Range x(g.lattice.origin.x, g.lattice.pitch_x, g.lattice.cols, g.kernel.half_cols, factor.x);
  for (const Stroke& s : g.strokes) {
    for (const Point p : {s.start, s.via, s.finish}) {
      y.take(p.y);
      x.take(p.x);
    }
  }
  if (g.strokes.empty()) {
    y.take(g.lattice.origin.y);
    x.take(g.lattice.origin.x);
  }
  DwellLattice result;
  result.first_row = static_cast<Index>(y.first) - 1;
  result.first_col = static_cast<Index>(x.first) - 1;
  result.lattice = {static_cast<Index>(y.last - y.first) + 4,
                    static_cast<Index>(x.last - x.first) + 4,
                    x.pitch,
                    y.pitch,
                    {x.origin + x.pitch * static_cast<double>(result.first_col),
                     y.origin + y.pitch * static_cast<double>(result.first_row)}};
  return result;
}

}  // namespace dwell
