#include "core/formats/smeared_marker.h"

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

constexpr std::size_t kRim = 2;  // pixels that interpolation smears

/// Marks what is at most kRim from a mark along a line of `count` places, `step` apart.
void widen(std::vector<char>& marks, std::size_t begin, std::size_t count, std::size_t step) {
  std::vector<char> line(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    if (marks[begin + i * step] == 0) continue;
    const std::size_t from = i > kRim ? i - kRim : 0, to = std::min(count, i + kRim + 1);
    std::fill(line.begin() + static_cast<std::ptrdiff_t>(from), line.begin() + static_cast<std::ptrdiff_t>(to), 1);
  }
  for (std::size_t i = 0; i < count; ++i) marks[begin + i * step] = line[i];
}

}  // namespace

MarkerRim rim_of_marker(const std::vector<double>& values, std::size_t cols, double value, double in_file) {
  constexpr double kLeastMark = 99.0, kFarSpans = 10.0;
  constexpr std::ptrdiff_t kLeastRepeats = 4;
  if (cols == 0 || in_file != std::round(in_file) || !(std::abs(in_file) >= kLeastMark)) return MarkerRim::None;
  if (std::count(values.begin(), values.end(), value) < kLeastRepeats) return MarkerRim::None;
  std::vector<char> near(values.size());
  std::transform(values.begin(), values.end(), near.begin(), [&](double v) { return v == value ? 1 : 0; });
  const std::size_t rows = values.size() / cols;
  for (std::size_t row = 0; row < rows; ++row) widen(near, row * cols, cols, 1);
  for (std::size_t col = 0; col < cols; ++col) widen(near, col, rows, cols);
  double low = std::nan(""), high = low;
  std::ptrdiff_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (near[i] != 0 || std::isnan(values[i])) continue;
    ++count;
    if (!(values[i] >= low)) low = values[i];
    if (!(values[i] <= high)) high = values[i];
  }
  const double gap = std::min(std::abs(low - value), std::abs(high - value));
  if (count < kLeastRepeats || !(high > low) || !(gap > kFarSpans * (high - low))) return MarkerRim::None;
  // Heights at the rim that stand about where the part does were not interpolated.
  constexpr double kLeastShare = 0.05;
  const bool between = std::any_of(values.begin(), values.end(), [&](double v) {
    return v != value && !std::isnan(v) && std::max(low - v, v - high) > kLeastShare * gap;
  });
  return between ? MarkerRim::Interpolated : MarkerRim::Sharp;
}

}  // namespace dwell
