#include "paths/lines/run_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/poll.h"

namespace dwell {
namespace {

/// The runs that are not visited yet; finds the next one up or down from any.
class Unvisited {
 public:
  explicit Unvisited(std::size_t count) : up_(count + 1), down_(count + 1) {
    std::iota(up_.begin(), up_.end(), Index{0});      // up_[i]: a run >= i, `count` if none
    std::iota(down_.begin(), down_.end(), Index{0});  // down_[i + 1]: 1 + a run <= i, 0 if none
  }
  Index at_or_after(Index run) { return find(up_, run); }
  Index at_or_before(Index run) { return find(down_, run + 1) - 1; }
  void visit(Index run) {
    up_[static_cast<std::size_t>(run)] = run + 1;
    down_[static_cast<std::size_t>(run + 1)] = run;
  }

 private:
  static Index find(std::vector<Index>& next, Index i) {
    Index root = i;
    while (next[static_cast<std::size_t>(root)] != root) root = next[static_cast<std::size_t>(root)];
    while (i != root) {
      Index& link = next[static_cast<std::size_t>(i)];
      i = link;
      link = root;
    }
    return root;
  }

  std::vector<Index> up_, down_;
};

struct Candidate {
  double squared = std::numeric_limits<double>::infinity();
  Index run = -1;
  bool backwards = false;
};

class Orderer {
 public:
  Orderer(const std::vector<LineRun>& runs, double pitch, double step)
      : runs_(runs), pitch_(pitch), step_(step), left_(runs.size()) {
    const Index lines = runs.empty() ? 0 : runs.back().line + 1;
    begin_.assign(static_cast<std::size_t>(lines + 1), 0);
    for (const LineRun& run : runs) ++begin_[static_cast<std::size_t>(run.line + 1)];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  }

  std::vector<OrderedRun> order(double link, const Progress& progress) {
    Poll poll(progress, 1024);
    std::vector<OrderedRun> order;
    order.reserve(runs_.size());
    if (runs_.empty()) return order;
    take({0.0, 0, false}, true, order);
    while (order.size() < runs_.size()) {
      poll.step();
      Candidate best;
      for (const Index line : {line_ + direction_, line_ - direction_, line_}) consider_line(line, best);
      // Infinite if no move is to be lifted, and still there may be no run on these lines.
      const double farthest = link * link;
      const bool near = best.run >= 0 && best.squared <= farthest;
      if (!near) best = nearest_of_all();
      take(best, !near && std::isfinite(farthest), order);
    }
    return order;
  }

 private:
  const LineRun& run(Index i) const { return runs_[static_cast<std::size_t>(i)]; }
  Index count() const { return static_cast<Index>(runs_.size()); }
  Index begin_of(Index line) const { return begin_[static_cast<std::size_t>(line)]; }

  void take(const Candidate& candidate, bool lifted, std::vector<OrderedRun>& order) {
    const LineRun& next = run(candidate.run);
    if (next.line != line_) direction_ = next.line > line_ ? 1 : -1;
    line_ = next.line;
    at_ = candidate.backwards ? next.first : next.last;
    left_.visit(candidate.run);
    order.push_back({candidate.run, candidate.backwards, lifted});
  }

  double across(Index line) const { return pitch_ * static_cast<double>(line - line_); }

  void consider(Index i, Candidate& best) const {
    const double dy = across(run(i).line);
    const auto squared = [&](Index end) {
      const double dx = step_ * static_cast<double>(end - at_);
      return dx * dx + dy * dy;
    };
    const double forwards = squared(run(i).first), backwards = squared(run(i).last);
    if (std::min(forwards, backwards) < best.squared) {
      best = {std::min(forwards, backwards), i, backwards < forwards};
    }
  }

  /// Runs of a line are disjoint, so the nearest end is one of the next run on either side of the present place. One of
  /// these runs may cover that place.
  void consider_line(Index line, Candidate& best) {
    if (line < 0 || line + 1 >= static_cast<Index>(begin_.size())) return;
    const Index begin = begin_of(line), end = begin_of(line + 1);
    const auto after = std::upper_bound(runs_.begin() + begin, runs_.begin() + end, at_,
                                        [](Index at, const LineRun& r) { return at < r.first; });
    const auto split = static_cast<Index>(after - runs_.begin());
    const Index below = left_.at_or_before(split - 1), above = left_.at_or_after(split);
    if (below >= begin) consider(below, best);
    if (above < end) consider(above, best);
  }

  Candidate nearest_of_all() {
    Candidate best;
    consider_line(line_, best);
    const auto worth = [&](Index line) { return across(line) * across(line) < best.squared; };
    for (Index next = left_.at_or_after(begin_of(line_ + 1)); next < count();) {
      const Index line = run(next).line;
      if (!worth(line)) break;
      consider_line(line, best);
      next = left_.at_or_after(begin_of(line + 1));
    }
    for (Index next = left_.at_or_before(begin_of(line_) - 1); next >= 0;) {
      const Index line = run(next).line;
      if (!worth(line)) break;
      consider_line(line, best);
      next = left_.at_or_before(begin_of(line) - 1);
    }
    return best;
  }

  const std::vector<LineRun>& runs_;
  double pitch_, step_;
  Unvisited left_;
  std::vector<Index> begin_;  // of each line's runs, and the end
  Index line_ = 0;
  Index at_ = 0;
  Index direction_ = 1;
};

}  // namespace

std::vector<OrderedRun> order_runs(const std::vector<LineRun>& runs, double pitch, double step, double link,
                                   const Progress& progress) {
  return Orderer(runs, pitch, step).order(link, progress);
}

}  // namespace dwell
