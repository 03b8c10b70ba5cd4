#include "solvers/problem/bounded_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace dwell {
namespace {

constexpr double kMostSweeps = 50.0;  // seen: 2 to 8
constexpr Index kAggregate = 8;       // variables of a coarse one
constexpr Index kCoarseFrom = 256;
constexpr double kRounding = 1e-12;  // of the diagonal: what is left of springs alone
// A free stretch that nothing holds has a singular T: its last pivot is kept above this share of the diagonal.
constexpr double kLeastPivot = 1e-14;

/// T is the sum of what ties each variable to 0 and of springs between neighbours. A coarse variable stands for
/// kAggregate of them: the ties add up, and the springs between two middles stand in series.
std::unique_ptr<BoundedChain> coarser(const Vector& diagonal, const Vector& off, const Vector& room) {
  const Index n = diagonal.size(), cells = (n + kAggregate - 1) / kAggregate;
  Vector d = Vector::Zero(cells), o = Vector::Zero(cells), most;
  if (room.size() != 0) most = Vector::Constant(cells, std::numeric_limits<double>::infinity());
  double give = 0.0;  // of the springs since the last middle
  for (Index j = 0; j < n; ++j) {
    const Index cell = j / kAggregate, begin = cell * kAggregate, end = std::min(begin + kAggregate, n);
    const double tie = diagonal[j] + off[j] + (j + 1 < n ? off[j + 1] : 0.0);
    if (tie > kRounding * diagonal[j]) d[cell] += tie;
    if (room.size() != 0) most[cell] = std::min(most[cell], room[j]);
    if (j > 0) give += 1.0 / std::abs(off[j]);  // infinite where nothing ties j to j - 1
    if (j != (begin + end) / 2) continue;
    if (cell > 0) o[cell] = -1.0 / give;
    give = 0.0;
  }
  for (Index cell = 0; cell < cells; ++cell)
    d[cell] = std::max(0.0, d[cell] - o[cell] - (cell + 1 < cells ? o[cell + 1] : 0.0));
  return std::make_unique<BoundedChain>(std::move(d), std::move(o), std::move(most));
}

}  // namespace

BoundedChain::BoundedChain(Vector diagonal, Vector off, Vector room)
    : diagonal_(std::move(diagonal)), off_(std::move(off)), room_(std::move(room)) {
  if (off_.size() != size() || (room_.size() != 0 && room_.size() != size()))
    throw std::invalid_argument("BoundedChain: diagonal, off and room differ in size");
  if (size() == 0) return;
  off_[0] = 0.0;
  if (!(diagonal_.array() >= 0.0).all() || !(off_.array() <= 0.0).all() || !(room_.array() >= 0.0).all())
    throw std::invalid_argument("BoundedChain: diagonal and room must be >= 0, off <= 0");
  at_.resize(static_cast<std::size_t>(size()));
  pivot_.resize(size());
  if (size() >= kCoarseFrom) coarse_ = coarser(diagonal_, off_, room_);
}

double BoundedChain::room(Index j) const {
  return room_.size() == 0 ? std::numeric_limits<double>::infinity() : room_[j];
}

void BoundedChain::minimise(const Vector& c, Vector& s) {
  s.setZero(size());
  if (coarse_) start_coarse(c, s);
  start_from(s);
  sweeps_ = 0.0;
  for (std::vector<Range> ranges{{0, size()}}; !ranges.empty() && sweeps_ < kMostSweeps;) {
    Index solved = 0;
    for (const Range& range : ranges) {
      solve_free(c, range, s);
      solved += range.end - range.begin;
    }
    sweeps_ += static_cast<double>(solved) / static_cast<double>(size());
    ranges = ranges_about(update_bounds(c, ranges, s));
  }
  s = s.cwiseMax(0.0);
  if (room_.size() != 0) s = s.cwiseMin(room_);
}

void BoundedChain::start_coarse(const Vector& c, Vector& s) {
  Vector sums = Vector::Zero(coarse_->size()), coarse;
  for (Index j = 0; j < size(); ++j) sums[j / kAggregate] += c[j];
  coarse_->minimise(sums, coarse);
  for (Index j = 0; j < size(); ++j) s[j] = coarse[j / kAggregate];
}

void BoundedChain::start_from(const Vector& s) {
  for (Index j = 0; j < size(); ++j) {
    // A variable that nothing ties down stands where its cost pushes it: solving for it would divide by 0.
    const bool loose = !(diagonal_[j] > 0.0);
    const bool full = room_.size() != 0 && s[j] >= room_[j];
    at(j) = s[j] <= 0.0 || loose ? At::Zero : full ? At::Room : At::Free;
  }
}

/// Elimination without pivoting, as T is positive definite on the free stretches; what is at a bound enters as given.
/// No free variable lies next to the range.
void BoundedChain::solve_free(const Vector& c, Range range, Vector& s) {
  for (Index j = range.begin; j < range.end; ++j)
    if (!is_free(j)) s[j] = at(j) == At::Zero ? 0.0 : room_[j];
  for (Index j = range.begin; j < range.end; ++j) {
    if (!is_free(j)) continue;
    double right = -c[j], pivot = diagonal_[j];
    if (j > 0 && is_free(j - 1)) {
      const double factor = off_[j] / pivot_[j - 1];
      pivot -= factor * off_[j];
      right -= factor * s[j - 1];
    } else if (j > 0) {
      right -= off_[j] * s[j - 1];
    }
    if (j + 1 < size() && !is_free(j + 1)) right -= off_[j + 1] * s[j + 1];
    pivot_[j] = std::max(pivot, kLeastPivot * diagonal_[j]);
    s[j] = right;
  }
  for (Index j = range.end - 1; j >= range.begin; --j) {
    if (!is_free(j)) continue;
    if (j + 1 < size() && is_free(j + 1)) s[j] -= off_[j + 1] * s[j + 1];
    s[j] /= pivot_[j];
  }
}

/// Where a variable should stand next, by its value and, at a bound, by its multiplier.
BoundedChain::At BoundedChain::next(const Vector& c, const Vector& s, Index j) const {
  const At now = at_[static_cast<std::size_t>(j)];
  if (now == At::Free) return s[j] < 0.0 ? At::Zero : s[j] > room(j) ? At::Room : At::Free;
  const double multiplier = multiplier_at(c, s, j);
  const bool loose = !(diagonal_[j] > 0.0);
  if (now == At::Zero && multiplier < 0.0) return !loose ? At::Free : room_.size() != 0 ? At::Room : At::Zero;
  if (now == At::Room && multiplier > 0.0) return loose ? At::Zero : At::Free;
  return now;
}

/// Frees variables and puts them at bounds in the ranges and right beside them, where values are new; returns which.
std::vector<Index> BoundedChain::update_bounds(const Vector& c, const std::vector<Range>& ranges, const Vector& s) {
  std::vector<Index> changed;
  Index done = 0;
  for (const Range& range : ranges) {
    for (Index j = std::max(done, range.begin - 1); j < std::min(size(), range.end + 1); ++j) {
      const At then = next(c, s, j);
      if (then != at(j)) changed.push_back(j);
      at(j) = then;
    }
    done = std::min(size(), range.end + 1);
  }
  return changed;
}

/// The stretches that have to be solved anew: a changed variable with the free ones on either side.
std::vector<BoundedChain::Range> BoundedChain::ranges_about(const std::vector<Index>& changed) const {
  std::vector<Range> ranges;
  for (const Index j : changed) {
    if (!ranges.empty() && j < ranges.back().end) continue;
    Range range{j, j + 1};
    while (range.begin > 0 && is_free(range.begin - 1)) --range.begin;
    while (range.end < size() && is_free(range.end)) ++range.end;
    if (!ranges.empty() && range.begin <= ranges.back().end) {
      ranges.back().end = range.end;
    } else {
      ranges.push_back(range);
    }
  }
  return ranges;
}

double BoundedChain::multiplier_at(const Vector& c, const Vector& s, Index j) const {
  double sum = diagonal_[j] * s[j];
  if (j > 0) sum += off_[j] * s[j - 1];
  if (j + 1 < size()) sum += off_[j + 1] * s[j + 1];
  return sum + c[j];
}

void BoundedChain::multipliers(const Vector& c, const Vector& s, Vector& result) const {
  result.resize(size());
  for (Index j = 0; j < size(); ++j) result[j] = multiplier_at(c, s, j);
}

double BoundedChain::value(const Vector& c, const Vector& s) const {
  double quadratic = 0.0;
  for (Index j = 0; j < size(); ++j) {
    quadratic += 0.5 * diagonal_[j] * s[j] * s[j];
    if (j > 0) quadratic += off_[j] * s[j] * s[j - 1];
  }
  return quadratic + c.dot(s);
}

}  // namespace dwell
