#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace dwell {

/// A symmetric positive definite matrix with four diagonals beside the main one, and its solution by L D L' without
/// pivoting.
class BandedSystem {
 public:
  static constexpr std::size_t kBeside = 4;

  explicit BandedSystem(std::size_t size) : rows_(size) {}

  void clear();
  /// Adds to the element (row, row + beside), which is also (row + beside, row); 0 <= beside <= kBeside.
  void add(std::size_t row, std::size_t beside, double value) { rows_[row][beside] += value; }
  /// Makes row and column those of the unit matrix.
  void fix(std::size_t row);
  /// Overwrites the matrix with its factors, and `x` with the solution. Cost 30 multiply-adds a row.
  void solve(std::vector<double>& x);

 private:
  std::vector<std::array<double, kBeside + 1>> rows_;  // upper part
};

}  // namespace dwell
