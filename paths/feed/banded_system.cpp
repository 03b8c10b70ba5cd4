#include "paths/feed/banded_system.h"

#include <algorithm>

namespace dwell {

void BandedSystem::clear() {
  for (auto& row : rows_) row.fill(0.0);
}

void BandedSystem::fix(std::size_t row) {
  rows_[row].fill(0.0);
  rows_[row][0] = 1.0;
  for (std::size_t k = 1; k <= std::min(kBeside, row); ++k) rows_[row - k][k] = 0.0;
}

void BandedSystem::solve(std::vector<double>& x) {
  const std::size_t n = rows_.size();
  for (std::size_t i = 0; i < n; ++i) {
    auto& row = rows_[i];
    const std::size_t most = std::min(kBeside, n - 1 - i);
    for (std::size_t k = 1; k <= most; ++k) {
      const double factor = row[k] / row[0];
      for (std::size_t m = k; m <= most; ++m) rows_[i + k][m - k] -= factor * row[m];
      x[i + k] -= factor * x[i];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    const auto& row = rows_[i];
    double sum = x[i];
    for (std::size_t k = 1; k <= std::min(kBeside, n - 1 - i); ++k) sum -= row[k] * x[i + k];
    x[i] = sum / row[0];
  }
}

}  // namespace dwell
