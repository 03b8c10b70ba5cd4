#include "solvers/matched/two_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dwell {
namespace {

constexpr std::array<double, 5> kRelation = {0.125, 0.5, 0.75, 0.5, 0.125};

Index floor_half(Index i) { return i >= 0 ? i / 2 : -((1 - i) / 2); }

/// Calls visit(fine line, weight) for the fine lines of a coarse one.
template <class Visit>
void for_relation(Index middle, Index lines, const Visit& visit) {
  for (Index k = 0; k < 5; ++k) {
    const Index line = middle + k - 2;
    if (line >= 0 && line < lines) visit(line, kRelation[static_cast<std::size_t>(k)]);
  }
}

}  // namespace

TwoScale::TwoScale(const Grid& fine, Point origin) : fine_(fine), coarse_(fine) {
  const auto first_row = static_cast<Index>(std::llround((fine.origin.y - origin.y) / fine.pitch_y));
  const auto first_col = static_cast<Index>(std::llround((fine.origin.x - origin.x) / fine.pitch_x));
  const Index row0 = floor_half(first_row - 1), col0 = floor_half(first_col - 1);
  coarse_.rows = floor_half(first_row + fine.rows + 1) - row0 + 1;
  coarse_.cols = floor_half(first_col + fine.cols + 1) - col0 + 1;
  coarse_.pitch_x = 2.0 * fine.pitch_x;
  coarse_.pitch_y = 2.0 * fine.pitch_y;
  coarse_.origin =
      origin + Point{coarse_.pitch_x * static_cast<double>(col0), coarse_.pitch_y * static_cast<double>(row0)};
  row_shift_ = 2 * row0 - first_row;
  col_shift_ = 2 * col0 - first_col;
  rows_.resize(coarse_.rows * fine.cols);
}

void TwoScale::restrict_to(const Vector& fine, Vector& coarse) {
  rows_.setZero();
  for (Index r = 0; r < coarse_.rows; ++r) {
    for_relation(2 * r + row_shift_, fine_.rows, [&](Index line, double weight) {
      rows_.segment(r * fine_.cols, fine_.cols) += weight * fine.segment(line * fine_.cols, fine_.cols);
    });
  }
  coarse.resize(coarse_.size());
  for (Index i = 0; i < coarse_.size(); ++i) {
    const double* row = rows_.data() + i / coarse_.cols * fine_.cols;
    double sum = 0.0;
    for_relation(2 * (i % coarse_.cols) + col_shift_, fine_.cols,
                 [&](Index line, double weight) { sum += weight * row[line]; });
    coarse[i] = sum;
  }
}

void TwoScale::prolong(const Vector& coarse, Vector& fine) {
  rows_.setZero();
  for (Index i = 0; i < coarse_.size(); ++i) {
    double* row = rows_.data() + i / coarse_.cols * fine_.cols;
    for_relation(2 * (i % coarse_.cols) + col_shift_, fine_.cols,
                 [&](Index line, double weight) { row[line] += weight * coarse[i]; });
  }
  fine.setZero(fine_.size());
  for (Index r = 0; r < coarse_.rows; ++r) {
    for_relation(2 * r + row_shift_, fine_.rows, [&](Index line, double weight) {
      fine.segment(line * fine_.cols, fine_.cols) += weight * rows_.segment(r * fine_.cols, fine_.cols);
    });
  }
}

}  // namespace dwell
