#pragma once

#include <memory>
#include <vector>

#include "core/removal/removal_operator.h"

namespace dwell {

/// A convex quadratic over variables in a row, each tied to its neighbours only, within bounds:
///
///   minimise  1/2 s'T s + c's   subject to  0 <= s <= room
///
/// T is symmetric, tridiagonal and positive semidefinite, with no positive entry off its diagonal. That is what
/// smoothness along a path, and nothing else, asks of the dwell.
///
/// Solved by the primal-dual active set method (Hintermueller, Ito, Kunisch, SIAM J. Optim. 13 (2003) 865), which for
/// such T is monotone and finite: bounds that hold with a multiplier of the right sign stay, the others are freed or
/// met, and between them every free stretch is one tridiagonal solve. A round solves the stretches anew in which
/// something changed: all of them in the first, few in the last.
///
/// The end of a free stretch moves outward by one variable a round, so a start that is far off costs hundreds of
/// rounds. The start is therefore the minimiser of a chain of an eighth as many variables, found in the same way, which
/// leaves each end a few rounds to go: 2 to 8 n variables solved in all, where a start from elsewhere took 400 n.
class BoundedChain {
 public:
  /// diagonal, n. off[j], n: the entry that ties j to j - 1, <= 0; off[0] does not count. room, n, >= 0; empty =
  /// infinite. Throws std::invalid_argument if sizes differ or an entry has the wrong sign.
  BoundedChain(Vector diagonal, Vector off, Vector room);

  Index size() const { return diagonal_.size(); }
  double room(Index j) const;

  /// Overwrites s by a minimiser. Where the minimum is -infinity, or the work is used up, s is some vector within the
  /// bounds that need not be near one: multipliers() tells.
  void minimise(const Vector& c, Vector& s);
  /// The variables that the last minimise() solved for in all its rounds, coarser chains apart, over n.
  double sweeps() const { return sweeps_; }

  /// T s + c: at a minimiser >= 0 where s = 0, <= 0 where s = room, 0 between.
  void multipliers(const Vector& c, const Vector& s, Vector& result) const;
  /// 1/2 s'T s + c's.
  double value(const Vector& c, const Vector& s) const;

 private:
  enum class At : char { Free, Zero, Room };
  struct Range {
    Index begin, end;
  };

  At& at(Index j) { return at_[static_cast<std::size_t>(j)]; }
  bool is_free(Index j) const { return at_[static_cast<std::size_t>(j)] == At::Free; }
  At at(Index j) const { return at_[static_cast<std::size_t>(j)]; }
  void start_from(const Vector& s);
  void start_coarse(const Vector& c, Vector& s);
  void solve_free(const Vector& c, Range range, Vector& s);
  At next(const Vector& c, const Vector& s, Index j) const;
  std::vector<Index> update_bounds(const Vector& c, const std::vector<Range>& ranges, const Vector& s);
  std::vector<Range> ranges_about(const std::vector<Index>& changed) const;
  double multiplier_at(const Vector& c, const Vector& s, Index j) const;

  Vector diagonal_, off_, room_;
  std::vector<At> at_;
  Vector pivot_;
  std::unique_ptr<BoundedChain> coarse_;  // null where n is small
  double sweeps_ = 0.0;
};

}  // namespace dwell
