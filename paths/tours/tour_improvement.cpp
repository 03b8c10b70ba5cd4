#include "paths/tours/tour_improvement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "paths/domain/point_limit.h"
#include "paths/tours/tour_search.h"

namespace dwell {
namespace {

using City = TourArray::City;
using Length = TourArray::Length;

constexpr auto kMaxTourPoints = static_cast<std::size_t>(kMaxPathPoints);
constexpr City kLongestKick = 50;    // cities of each of the two stretches
constexpr int kDraws = 30;           // of a place for a kick
constexpr double kDrift = 1e-12;     // of the length
constexpr Index kKicksPerAsk = 256;  // kicks

void check(const std::vector<Point>& points, const std::vector<Index>& order, const TourOptions& options) {
  if (points.empty()) throw InputError("tour: no points; at least one is required");
  if (points.size() > kMaxTourPoints) {
    throw InputError(fmt::format("tour: {}; at most {} accepted", counted(points.size(), "point"), kMaxTourPoints));
  }
  Point low = points.front(), high = points.front();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point p = points[i];
    if (!(std::isfinite(p.x) && std::isfinite(p.y))) {
      throw InputError(fmt::format("tour: point {} is ({}, {}); required finite", i + 1, p.x, p.y));
    }
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  if (!std::isfinite(distance(low, high))) {
    throw InputError(fmt::format("tour: the points reach from ({}, {}) to ({}, {}); required a finite distance", low.x,
                                 low.y, high.x, high.y));
  }
  if (order.size() != points.size()) {
    throw InputError(fmt::format("tour: the order has {} entries for {}; required one each", order.size(),
                                 counted(points.size(), "point")));
  }
  std::vector<char> seen(points.size(), 0);
  for (const Index i : order) {
    if (i < 0 || static_cast<std::size_t>(i) >= points.size() || seen[static_cast<std::size_t>(i)]) {
      throw InputError(
          fmt::format("tour: the order has the index {} twice or outside 0 to {}; required every point once", i,
                      points.size() - 1));
    }
    seen[static_cast<std::size_t>(i)] = 1;
  }
  if (options.kicks && *options.kicks < 0) {
    throw InputError(fmt::format("tour: kicks = {}; required >= 0", *options.kicks));
  }
}

/// Makes two neighbouring stretches of the tour change places. This is a segment insertion, which single reversals of
/// stretches cannot make without a longer tour in between.
class Kicks {
 public:
  Kicks(TourArray& tour, TourSearch& search, std::uint64_t seed)
      : tour_(tour), search_(search), random_(seed), longest_(std::min<City>(kLongestKick, (tour.size() - 2) / 3)) {}

  bool possible() const { return longest_ >= 1; }

  /// Kicks the tour, improves it around the kick, and undoes both if the tour became longer. True if the kick stays.
  bool kick() {
    tour_.forget();
    const City first = draw(longest_), second = draw(longest_);
    City start = place();  // the first stretch follows; or the drawn place is one of the other two cuts
    const std::array<City, 3> back{0, first, first + second};
    start -= back[static_cast<std::size_t>(draw(3) - 1)];
    if (start < 0) start += tour_.size();
    const auto at = [&](City k) { return tour_.wrapped(start + k); };
    const std::array<City, 6> ends{tour_.at(at(0)),
                                   tour_.at(at(1)),
                                   tour_.at(at(first)),
                                   tour_.at(at(first + 1)),
                                   tour_.at(at(first + second)),
                                   tour_.at(at(first + second + 1))};
    const auto d = [&](std::size_t a, std::size_t b) { return tour_.distance(ends[a], ends[b]); };
    const Length longer = d(0, 3) + d(4, 1) + d(2, 5) - d(0, 1) - d(2, 3) - d(4, 5);
    tour_.reverse(at(1), at(first + second));
    tour_.reverse(at(1), at(second));
    tour_.reverse(at(second + 1), at(first + second));
    for (const City c : ends) search_.enqueue(c);
    if (search_.run(false, {}) >= longer) return true;
    tour_.undo_to(0);
    return false;
  }

 private:
  /// A random number 1..most. std::uniform_int_distribution would give other numbers in other libraries.
  City draw(City most) { return 1 + static_cast<City>(random_() % static_cast<std::uint64_t>(most)); }

  /// A position at random; if a few draws find one, a position whose move to the next city is longer than it need be.
  City place() {
    City position = 0;
    for (int k = 0; k < kDraws; ++k) {
      position = draw(tour_.size()) - 1;
      const City a = tour_.at(position), b = tour_.next(a);
      if (a == tour_.dummy() || b == tour_.dummy()) continue;
      if (!search_.shortest_possible(a, tour_.distance(a, b))) break;
    }
    return position;
  }

  TourArray& tour_;
  TourSearch& search_;
  std::mt19937_64 random_;
  City longest_;
};

}  // namespace

double tour_length(const std::vector<Point>& points, const std::vector<Index>& order) {
  double sum = 0.0;
  for (std::size_t j = 1; j < order.size(); ++j) {
    sum += distance(points[static_cast<std::size_t>(order[j - 1])], points[static_cast<std::size_t>(order[j])]);
  }
  return sum;
}

ImprovedTour improve_tour(const std::vector<Point>& points, const std::vector<Index>& order, const TourOptions& options,
                          const Progress& progress) {
  check(points, order, options);
  std::vector<Point> path;
  path.reserve(order.size());
  for (const Index i : order) path.push_back(points[static_cast<std::size_t>(i)]);

  ImprovedTour result;
  result.length_before = tour_length(points, order);
  TourArray tour(path, options.fixed_start);
  TourSearch search(path, tour, progress);
  search.enqueue_all();
  bool stopped = false;
  const auto stop = [&] {
    progress.check();
    return stopped = stopped || (options.stop && options.stop());
  };
  search.run(true, stop);
  Kicks kicks(tour, search, options.seed);
  const Index budget = kicks.possible() ? options.kicks.value_or(static_cast<Index>(points.size())) : 0;
  while (result.kicks < budget && !stopped) {
    if (kicks.kick()) ++result.kicks_kept;
    if (++result.kicks % kKicksPerAsk == 0) stop();
  }
  result.moves = search.moves();
  result.stopped = stopped;
  for (const City city : tour.open_path()) result.order.push_back(order[static_cast<std::size_t>(city)]);
  result.length_after = tour_length(points, result.order);
  if (!(result.length_before - result.length_after > kDrift * result.length_before)) {  // nothing gained but drift
    result.order = order;
    result.length_after = result.length_before;
  }
  return result;
}

}  // namespace dwell
