#include "core/anatomy/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "core/numerics/median.h"

namespace dwell {
namespace {

/// k with its binary digits mirrored about the point: the first so many of these lie evenly in [0, 1) (van der Corput).
double mirrored_digits(unsigned k) {
  double value = 0.0, digit = 0.5;
  for (; k > 0; k >>= 1U, digit *= 0.5) value += (k & 1U) != 0 ? digit : 0.0;
  return value;
}

/// Ways from half of the reach to all of it, over half a turn, each pair of pixels once; then those along the row and
/// the column.
std::vector<Surroundings::Way> ways_about(const Grid& grid, double reach, Index& all_round) {
  constexpr double kGolden = 0.6180339887498949;
  std::vector<Surroundings::Way> ways;
  std::set<std::pair<Index, Index>> seen;
  for (unsigned k = 0; k < 4 * Surroundings::kAllRound && static_cast<Index>(ways.size()) < Surroundings::kAllRound;
       ++k) {
    const double turn = std::fmod(kGolden * k, 1.0);
    const double radius = reach * std::sqrt(0.25 + 0.75 * mirrored_digits(k));
    const auto rows = static_cast<Index>(std::lround(radius * std::sin(std::numbers::pi * turn) / grid.pitch_y));
    const auto cols = static_cast<Index>(std::lround(radius * std::cos(std::numbers::pi * turn) / grid.pitch_x));
    const bool turned = rows < 0 || (rows == 0 && cols < 0);
    const std::pair<Index, Index> way{turned ? -rows : rows, turned ? -cols : cols};
    if (way != std::pair<Index, Index>{0, 0} && seen.insert(way).second) ways.push_back({way.first, way.second});
  }
  all_round = static_cast<Index>(ways.size());
  const auto add_line = [&](double pitch, bool along_row) {
    const auto last = static_cast<Index>(Surroundings::kAlongEdge * reach / pitch);
    for (auto step = static_cast<Index>(std::ceil(0.5 * reach / pitch)); step <= last; ++step)
      ways.push_back(along_row ? Surroundings::Way{0, step} : Surroundings::Way{step, 0});
  };
  add_line(grid.pitch_x, true);
  add_line(grid.pitch_y, false);
  return ways;
}

/// The middle one of so many values, the upper of two. Reorders.
template <std::size_t Size>
double median_of(std::array<double, Size>& values, Index count) {
  const auto middle = values.begin() + count / 2;
  std::nth_element(values.begin(), middle, values.begin() + count);
  return *middle;
}

constexpr auto kEight = static_cast<std::size_t>(Surroundings::kGlancePairs);

/// Calls exchange(i, j), i < j, which is to bring the lesser of two values to place i: afterwards eight are in order
/// (Batcher's merge-exchange sort; Knuth, The Art of Computer Programming 3, 5.3.4).
template <class Exchange>
void sort_eight(const Exchange& exchange) {
  exchange(0, 1), exchange(2, 3), exchange(4, 5), exchange(6, 7), exchange(0, 2), exchange(1, 3), exchange(4, 6),
      exchange(5, 7), exchange(1, 2), exchange(5, 6), exchange(0, 4), exchange(1, 5), exchange(2, 6), exchange(3, 7),
      exchange(2, 4), exchange(3, 5), exchange(1, 2), exchange(3, 4), exchange(5, 6);
}

/// Standard deviation of a pixel per distance of the third of eight pair means from the sixth, of normal noise.
constexpr double kSigmaPerGlance = std::numbers::sqrt2 / 0.94566;

}  // namespace

Surroundings::Surroundings(const HeightMap& map, double reach)
    : map_(map),
      ways_(ways_about(map.grid, std::max(reach, kLeastReach * std::max(map.grid.pitch_x, map.grid.pitch_y)),
                       all_round_)) {
  for (const Way& way : ways_) {
    steps_.push_back(way.rows * map.grid.cols + way.cols);
    const auto number = static_cast<Index>(steps_.size());
    if (number > all_round_) continue;
    most_rows_ = std::max(most_rows_, way.rows);
    most_cols_ = std::max(most_cols_, std::abs(way.cols));
    if (number != kGlancePairs) continue;
    glance_rows_ = most_rows_, glance_cols_ = most_cols_;
  }
}

bool Surroundings::is_within(Index row, Index col) const {
  return row >= most_rows_ && col >= most_cols_ && row + most_rows_ < map_.grid.rows &&
         col + most_cols_ < map_.grid.cols;
}

template <class Take>
bool Surroundings::for_pairs(Index row, Index col, Index from, Index to, const Take& take) const {
  const Grid& g = map_.grid;
  const double* const here = map_.values.data() + g.index(row, col);
  const bool within = to <= all_round_ && is_within(row, col);  // the ways beyond reach farther
  for (Index k = from; k < to; ++k) {
    if (!within) {
      const Way& way = ways_[static_cast<std::size_t>(k)];
      const Index across = std::abs(way.cols);
      if (row < way.rows || row + way.rows >= g.rows || col < across || col + across >= g.cols) continue;
    }
    const Index step = steps_[static_cast<std::size_t>(k)];
    const double one = here[step], other = here[-step];
    if (std::isfinite(one + other) && !take(one, other)) return false;
  }
  return true;
}

std::optional<Deviation> Surroundings::deviation(Index row, Index col) const {
  const double here = map_.at(row, col);
  if (!std::isfinite(here)) return std::nullopt;
  std::array<double, kPairs> means, halves;
  Index count = 0;
  const auto take = [&](double one, double other) {
    halves[static_cast<std::size_t>(count)] = 0.5 * std::abs(one - other);
    means[static_cast<std::size_t>(count++)] = 0.5 * (one + other);
    return count < kPairs;
  };
  const Index some = std::min(tries(kPairs), all_round_);
  const bool beside_edge = for_pairs(row, col, 0, some, take);
  if (beside_edge) count = 0, for_pairs(row, col, all_round_, static_cast<Index>(ways_.size()), take);
  if (count < kFewestPairs) {
    // Beside a slanted edge, but not in a corner, where what pairs there are reach across an edge.
    count = 0, for_pairs(row, col, 0, some, take);
    if (count < std::max(kFewestPairs, some / 4)) return std::nullopt;
  }
  Deviation d;
  d.middle = median_of(means, count);
  for (Index k = 0; k < count; ++k) {
    double& value = means[static_cast<std::size_t>(k)];
    value = std::abs(value - d.middle);
  }
  d.sigma = std::numbers::sqrt2 * kSigmaPerMedianDeviation * median_of(means, count);
  d.height = here - d.middle;
  d.step = median_of(halves, count);
  return d;
}

std::optional<Deviation> Surroundings::glance(Index row, Index col) const {
  const double here = map_.at(row, col);
  if (!std::isfinite(here)) return std::nullopt;
  std::array<double, kEight> means{};
  std::size_t count = 0;
  const auto take = [&](double one, double other) {
    means[count++] = 0.5 * (one + other);
    return count < kEight;
  };
  const bool beside_edge = for_pairs(row, col, 0, std::min(tries(kGlancePairs), all_round_), take);
  if (beside_edge) count = 0, for_pairs(row, col, all_round_, static_cast<Index>(ways_.size()), take);
  if (count < kEight) return std::nullopt;
  sort_eight([&](std::size_t i, std::size_t j) {
    if (means[j] < means[i]) std::swap(means[i], means[j]);
  });
  const double middle = 0.5 * (means[3] + means[4]);
  return Deviation{middle, kSigmaPerGlance * (means[5] - means[2]), here - middle, 0.0};
}

void Surroundings::glance_at_row(Index row, std::span<double> heights, std::span<double> sigmas) const {
  const Grid& g = map_.grid;
  constexpr Index kTogether = 64;
  const auto one_by_one = [&](Index from, Index to) {
    for (Index col = from; col < to; ++col) {
      const auto d = glance(row, col);
      const auto i = static_cast<std::size_t>(col);
      heights[i] = d ? d->height : std::numeric_limits<double>::quiet_NaN();
      sigmas[i] = d ? d->sigma : std::numeric_limits<double>::quiet_NaN();
    }
  };
  const bool inside = row >= glance_rows_ && row + glance_rows_ < g.rows && all_round_ >= kGlancePairs;
  const Index begin = inside ? std::min(glance_cols_, g.cols) : g.cols;
  const Index end = std::max(begin, g.cols - glance_cols_);
  one_by_one(0, begin);
  std::array<std::array<double, kTogether>, kEight> means{};
  std::array<double, kTogether> middles{}, spreads{};
  for (Index first = begin; first < end; first += kTogether) {
    const auto count = static_cast<std::size_t>(std::min(kTogether, end - first));
    const double* const here = map_.values.data() + g.index(row, first);
    double sum = 0.0;  // not finite where one of the pixels is lost
    for (std::size_t k = 0; k < kEight; ++k) {
      const double *const one = here + steps_[k], *const other = here - steps_[k];
      for (std::size_t j = 0; j < count; ++j) means[k][j] = 0.5 * (one[j] + other[j]);
      for (std::size_t j = 0; j < count; ++j) sum += means[k][j];
    }
    if (!std::isfinite(sum)) {
      one_by_one(first, first + static_cast<Index>(count));
      continue;
    }
    for (std::size_t j = 0; j < count; ++j) {
      std::array<double, kEight> v;
      for (std::size_t k = 0; k < kEight; ++k) v[k] = means[k][j];
      sort_eight([&](std::size_t i, std::size_t k) {
        const double a = v[i], b = v[k];
        v[i] = a < b ? a : b;
        v[k] = a < b ? b : a;
      });
      middles[j] = 0.5 * (v[3] + v[4]);
      spreads[j] = kSigmaPerGlance * (v[5] - v[2]);
    }
    for (std::size_t j = 0; j < count; ++j) {
      const auto i = static_cast<std::size_t>(first) + j;
      heights[i] = here[j] - middles[j];
      sigmas[i] = std::isfinite(here[j]) ? spreads[j] : std::numeric_limits<double>::quiet_NaN();
    }
  }
  one_by_one(end, g.cols);
}

}  // namespace dwell
