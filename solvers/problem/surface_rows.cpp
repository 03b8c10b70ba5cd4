#include "solvers/problem/surface_rows.h"

#include <algorithm>

namespace dwell {

SurfaceRows::SurfaceRows(const Grid& map, const std::vector<Index>& pixels, bool with_heights)
    : pixels_(static_cast<Index>(pixels.size())),
      with_heights_(with_heights),
      per_pitch_x_(1.0 / map.pitch_x),
      per_pitch_y_(1.0 / map.pitch_y) {
  std::size_t above = 0;  // runs one row ahead
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const bool row_ends = (pixels[i] + 1) % map.cols == 0;
    if (!row_ends && i + 1 < pixels.size() && pixels[i + 1] == pixels[i] + 1) left_.push_back(static_cast<Index>(i));
    while (above < pixels.size() && pixels[above] < pixels[i] + map.cols) ++above;
    if (above < pixels.size() && pixels[above] == pixels[i] + map.cols)
      below_.emplace_back(static_cast<Index>(i), static_cast<Index>(above));
  }
}

std::pair<Index, Index> SurfaceRows::pair(Index k) const {
  if (k >= pairs_x()) return below_[static_cast<std::size_t>(k - pairs_x())];
  const Index left = left_[static_cast<std::size_t>(k)];
  return {left, left + 1};
}

void SurfaceRows::apply(const Vector& heights, Vector& rows) const {
  rows.resize(this->rows());
  rows.head(this->heights()) = heights.head(this->heights());
  double* to = rows.data() + this->heights();
  const double* z = heights.data();
  for (const Index left : left_) *to++ = per_pitch_x_ * (z[left + 1] - z[left]);
  for (const auto& [below, above] : below_) *to++ = per_pitch_y_ * (z[above] - z[below]);
}

void SurfaceRows::apply_adjoint(const Vector& rows, Vector& heights) const {
  heights.resize(pixels_);
  if (with_heights_) {
    heights = rows.head(pixels_);
  } else {
    heights.setZero();
  }
  const double* from = rows.data() + this->heights();
  double* z = heights.data();
  for (const Index left : left_) {
    const double slope = per_pitch_x_ * *from++;
    z[left + 1] += slope;
    z[left] -= slope;
  }
  for (const auto& [below, above] : below_) {
    const double slope = per_pitch_y_ * *from++;
    z[above] += slope;
    z[below] -= slope;
  }
}

RowsOfRemoval::RowsOfRemoval(RemovalOperator& removal, const SurfaceRows& rows)
    : RemovalOperator(rows.rows(), removal.cols()), removal_(removal), rows_(rows) {}

void RowsOfRemoval::do_apply(const Vector& t, Vector& rows) {
  removal_.apply(t, heights_);
  rows_.apply(heights_, rows);
}

void RowsOfRemoval::do_apply_adjoint(const Vector& rows, Vector& t) {
  rows_.apply_adjoint(rows, heights_);
  removal_.apply_adjoint(heights_, t);
}

}  // namespace dwell
