#include "core/removal/lattice_removal.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/motion/stroke_quadrature.h"

namespace dwell {
namespace {

constexpr double kTolerance = 1e-9;  // of a pixel: far below what a machine can place, far above rounding

struct LatticePosition {
  Index row, col;
};

LatticePosition nearest_pixel(const Grid& map, Point p) {
  return {static_cast<Index>(std::llround((p.y - map.origin.y) / map.pitch_y)),
          static_cast<Index>(std::llround((p.x - map.origin.x) / map.pitch_x))};
}

/// Displacement of `a` from `b` in pixels, less its nearest whole number, is within tolerance of `shift` pixels.
bool same_shift(const Grid& map, Point a, Point b, LatticePosition shift) {
  const double du = (a.x - b.x) / map.pitch_x - static_cast<double>(shift.col);
  const double dv = (a.y - b.y) / map.pitch_y - static_cast<double>(shift.row);
  return std::abs(du) <= kTolerance && std::abs(dv) <= kTolerance;
}

/// Whether a stroke is not much longer than the map, which is padded by its length, and its distance from another a
/// number of pixels that can be counted.
bool lies_near(const Grid& map, const Stroke& s, const Stroke& other) {
  constexpr double kFar = 1e9;
  const auto within = [&map](Point a, Point b, double pixels) {
    return std::abs(a.x - b.x) <= pixels * map.pitch_x && std::abs(a.y - b.y) <= pixels * map.pitch_y;
  };
  constexpr Index kShort = 64;  // on the smallest of maps
  const auto longest = static_cast<double>(kShort + 4 * std::max(map.rows, map.cols));
  return within(s.start, s.via, longest) && within(s.finish, s.via, longest) && within(s.via, other.via, kFar);
}

LatticePosition shift_between(const Grid& map, Point a, Point b) {
  return {static_cast<Index>(std::llround((a.y - b.y) / map.pitch_y)),
          static_cast<Index>(std::llround((a.x - b.x) / map.pitch_x))};
}

/// The removal function averaged over `stroke`, sampled at whole pixels from `anchor` (a pixel centre).
std::vector<double> averaged_kernel(const Grid& map, const RemovalKernel& kernel, const Stroke& stroke, Point anchor,
                                    Index half_rows, Index half_cols) {
  std::vector<QuadraturePoint> points;
  append_stroke_quadrature(stroke, map, points);
  std::vector<double> samples(static_cast<std::size_t>((2 * half_rows + 1) * (2 * half_cols + 1)), 0.0);
  std::size_t k = 0;
  for (Index r = -half_rows; r <= half_rows; ++r) {
    for (Index c = -half_cols; c <= half_cols; ++c, ++k) {
      const Point pixel = anchor + Point{map.pitch_x * static_cast<double>(c), map.pitch_y * static_cast<double>(r)};
      for (const QuadraturePoint& q : points) samples[k] += q.weight * kernel.rate(pixel - q.position);
    }
  }
  return samples;
}

}  // namespace

bool LatticeRemoval::commensurate(const Grid& map, const std::vector<Stroke>& strokes) {
  for (const Stroke& s : strokes) {
    const Stroke& first = strokes.front();
    if (!lies_near(map, s, first)) return false;
    const LatticePosition shift = shift_between(map, s.via, first.via);
    if (!same_shift(map, s.via, first.via, shift) || !same_shift(map, s.start, first.start, shift) ||
        !same_shift(map, s.finish, first.finish, shift)) {
      return false;
    }
  }
  return !strokes.empty();
}

LatticeRemoval::LatticeRemoval(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                               const std::vector<Stroke>& strokes, int threads)
    : RemovalOperator(static_cast<Index>(pixels.size()), static_cast<Index>(strokes.size())) {
  if (!commensurate(map, strokes))
    throw std::invalid_argument("strokes are not translates of one stroke by whole pixels");
  const Stroke& first = strokes.front();
  const LatticePosition base = nearest_pixel(map, first.via);
  const Point anchor = map.centre(base.row, base.col);
  const auto extra = [](double a, double b, double c, double pitch) {
    return static_cast<Index>(std::ceil(std::max({std::abs(a), std::abs(b), std::abs(c)}) / pitch)) + 2;
  };
  const Point a = first.start - anchor, b = first.via - anchor, c = first.finish - anchor;
  const Index half_rows = kernel.half_rows + extra(a.y, b.y, c.y, map.pitch_y);
  const Index half_cols = kernel.half_cols + extra(a.x, b.x, c.x, map.pitch_x);
  convolution_.emplace(map, pixels, averaged_kernel(map, kernel, first, anchor, half_rows, half_cols), half_rows,
                       half_cols, threads);
  nodes_.reserve(strokes.size());
  for (const Stroke& s : strokes) {
    const LatticePosition shift = shift_between(map, s.via, first.via);
    nodes_.push_back(convolution_->node(base.row + shift.row, base.col + shift.col));
  }
}

void LatticeRemoval::do_apply(const Vector& t, Vector& removal) {
  convolution_->clear_field();
  const auto field = convolution_->field();
  for (Index j = 0; j < cols(); ++j) {
    // Added, not assigned: a path may visit a lattice point twice.
    if (nodes_[static_cast<std::size_t>(j)] >= 0)
      field[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(j)])] += t[j];
  }
  convolution_->convolve(removal.data());
}

void LatticeRemoval::do_apply_adjoint(const Vector& residual, Vector& t) {
  convolution_->correlate(residual.data());
  const auto field = convolution_->field();
  for (Index j = 0; j < cols(); ++j) {
    t[j] = nodes_[static_cast<std::size_t>(j)] >= 0
               ? field[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(j)])]
               : 0.0;
  }
}

}  // namespace dwell
