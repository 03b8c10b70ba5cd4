#include "solvers/problem/bounded_chain.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace dwell {
namespace {

constexpr int kMostRounds = 60;
// A free stretch that nothing holds has a singular T: its last pivot is kept above this share of the diagonal.
constexpr double kLeastPivot = 1e-14;

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
}

double BoundedChain::room(Index j) const {
  return room_.size() == 0 ? std::numeric_limits<double>::infinity() : room_[j];
}

void BoundedChain::minimise(const Vector& c, Vector& s) {
  if (s.size() != size()) s.setZero(size());
  for (Index j = 0; j < size(); ++j) {
    // A variable that nothing ties down stands where its cost pushes it: solving for it would divide by 0.
    const bool loose = !(diagonal_[j] > 0.0);
    At& at = at_[static_cast<std::size_t>(j)];
    at = s[j] <= 0.0 || loose ? At::Zero : s[j] >= room(j) ? At::Room : At::Free;
  }
  for (int round = 0; round < kMostRounds; ++round) {
    solve_free(c, s);
    multipliers(c, s, multipliers_);
    if (update_bounds(s, multipliers_) == 0) break;
  }
  s = s.cwiseMax(0.0);
  if (room_.size() != 0) s = s.cwiseMin(room_);
}

/// Elimination without pivoting, as T is positive definite on the free stretches; what is at a bound enters as given.
void BoundedChain::solve_free(const Vector& c, Vector& s) {
  const Index n = size();
  const auto is_free = [&](Index j) { return at_[static_cast<std::size_t>(j)] == At::Free; };
  for (Index j = 0; j < n; ++j)
    if (!is_free(j)) s[j] = at_[static_cast<std::size_t>(j)] == At::Zero ? 0.0 : room_[j];
  for (Index j = 0; j < n; ++j) {
    if (!is_free(j)) continue;
    double right = -c[j], pivot = diagonal_[j];
    if (j > 0 && is_free(j - 1)) {
      const double factor = off_[j] / pivot_[j - 1];
      pivot -= factor * off_[j];
      right -= factor * s[j - 1];
    } else if (j > 0) {
      right -= off_[j] * s[j - 1];
    }
    if (j + 1 < n && !is_free(j + 1)) right -= off_[j + 1] * s[j + 1];
    pivot_[j] = std::max(pivot, kLeastPivot * diagonal_[j]);
    s[j] = right;
  }
  for (Index j = n - 1; j >= 0; --j) {
    if (!is_free(j)) continue;
    if (j + 1 < n && is_free(j + 1)) s[j] -= off_[j + 1] * s[j + 1];
    s[j] /= pivot_[j];
  }
}

/// Returns how many variables left a bound or met one.
Index BoundedChain::update_bounds(const Vector& s, const Vector& multipliers) {
  Index changes = 0;
  for (Index j = 0; j < size(); ++j) {
    At& at = at_[static_cast<std::size_t>(j)];
    At next = at;
    const bool loose = !(diagonal_[j] > 0.0);
    if (at == At::Free) {
      next = s[j] < 0.0 ? At::Zero : s[j] > room(j) ? At::Room : At::Free;
    } else if (at == At::Zero && multipliers[j] < 0.0) {
      next = !loose ? At::Free : room_.size() != 0 ? At::Room : At::Zero;
    } else if (at == At::Room && multipliers[j] > 0.0) {
      next = loose ? At::Zero : At::Free;
    }
    changes += next != at;
    at = next;
  }
  return changes;
}

void BoundedChain::multipliers(const Vector& c, const Vector& s, Vector& result) const {
  const Index n = size();
  result.resize(n);
  for (Index j = 0; j < n; ++j) {
    double sum = diagonal_[j] * s[j];
    if (j > 0) sum += off_[j] * s[j - 1];
    if (j + 1 < n) sum += off_[j + 1] * s[j + 1];
    result[j] = sum + c[j];
  }
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
