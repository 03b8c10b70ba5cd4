#include "solvers/spline_spreading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/bspline.h"
#include "solvers/simd.h"

namespace dwell {
namespace {

constexpr double kLongestPiece = 0.25;  // of the pitch
constexpr double kRounding = 1e-6;      // of the pitch
constexpr Index kWorthThreads = 20000;  // strokes

/// The point a share of the way along the stroke.
Point along(const Stroke& s, double share) {
  const double first = distance(s.start, s.via), second = distance(s.via, s.finish), at = share * (first + second);
  if (at <= first) return first > 0.0 ? s.start + (at / first) * (s.via - s.start) : s.via;
  return s.via + ((at - first) / second) * (s.finish - s.via);
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
    const double length = part == StrokePart::Whole ? s.length() : 0.0;
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / longest)));
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
  // Rounding must not carry a point on the first or last line off the lattice.
  const double fu = std::clamp(std::floor(u), 1.0, static_cast<double>(lattice_.cols - 3));
  const double fv = std::clamp(std::floor(v), 1.0, static_cast<double>(lattice_.rows - 3));
  const auto within = [](double f) { return f >= -kRounding && f <= 1.0 + kRounding; };
  if (!(within(u - fu) && within(v - fv)))
    throw std::invalid_argument(fmt::format("point ({}, {}) mm lies off the coarse lattice", p.x, p.y));
  const auto phase = [](double f) {
    return static_cast<std::uint16_t>(std::clamp<long>(std::lround(f * kPhases), 0, kPhases));
  };
  places_.push_back(
      {static_cast<std::int32_t>((static_cast<Index>(fv) - 1) * lattice_.cols + static_cast<Index>(fu) - 1),
       phase(u - fu), phase(v - fv)});
}

DWELL_SIMD void SplineSpreading::spread_range(const Vector& t, Index from, Index to, double* nodes) const {
  const Index cols = lattice_.cols;
  const double* dwell = t.data();
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

void SplineSpreading::spread(const Vector& t, Vector& nodes) {
  nodes.setZero(lattice_.size());
  if (partial_.empty()) {
    spread_range(t, 0, strokes(), nodes.data());
    return;
  }
  // A lattice of its own for every thread: cheap, since the lattice is coarse, and the order of summation is fixed.
#pragma omp parallel for num_threads(threads_) schedule(static, 1)
  for (int k = 0; k < threads_; ++k) {
    Vector& to = k == 0 ? nodes : partial_[static_cast<std::size_t>(k - 1)];
    if (k > 0) to.setZero();
    spread_range(t, strokes() * k / threads_, strokes() * (k + 1) / threads_, to.data());
  }
  for (const Vector& part : partial_) nodes += part;
}

void SplineSpreading::gather(const Vector& nodes, Vector& t) const {
  t.resize(strokes());
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

DwellLattice dwell_lattice(const Grid& map, const std::vector<Stroke>& strokes, CoarseFactor factor) {
  const double pitch_x = map.pitch_x * static_cast<double>(factor.x),
               pitch_y = map.pitch_y * static_cast<double>(factor.y);
  Index first_row = std::numeric_limits<Index>::max(), first_col = first_row, last_row = -first_row,
        last_col = last_row;
  for (const Stroke& s : strokes) {
    for (const Point p : {s.start, s.via, s.finish}) {
      const auto row = static_cast<Index>(std::floor((p.y - map.origin.y) / pitch_y));
      const auto col = static_cast<Index>(std::floor((p.x - map.origin.x) / pitch_x));
      first_row = std::min(first_row, row);
      first_col = std::min(first_col, col);
      last_row = std::max(last_row, row);
      last_col = std::max(last_col, col);
    }
  }
  if (strokes.empty()) first_row = first_col = last_row = last_col = 0;
  DwellLattice result;
  result.first_row = first_row - 1;
  result.first_col = first_col - 1;
  result.lattice = {last_row - first_row + 4, last_col - first_col + 4, pitch_x, pitch_y, {}};
  result.lattice.origin = map.origin + Point{pitch_x * static_cast<double>(result.first_col),
                                             pitch_y * static_cast<double>(result.first_row)};
  return result;
}

}  // namespace dwell
