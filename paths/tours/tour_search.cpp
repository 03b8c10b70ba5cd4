#include "paths/tours/tour_search.h"

#include <algorithm>
#include <array>

#include "core/base/poll.h"
#include "paths/domain/point_tree.h"

namespace dwell {
namespace {

constexpr std::size_t kNeighbours = 8;  // on a full lattice the ring around a point
constexpr int kDepth = 5;
constexpr std::array<std::size_t, kDepth> kBreadth{5, 3, 2, 1, 1};  // chains followed at each depth
constexpr TourArray::City kLongestInsertion = 12;
constexpr TourArray::City kReach = 50'000;  // cities reversed by one move: beyond it, moves cost more than they gain
constexpr int kCitiesPerAsk = 1024;         // cities of the queue

}  // namespace

/// Ways to go on from a chain's last city: the new neighbour, and the city that it is cut from.
struct TourSearch::Chain {
  struct Link {
    City to, cut;
    Length gain;  // if the tour were open between `cut` and the chain's base
  };
  std::array<Link, kBreadth[0]> links;  // best first
  std::size_t count = 0;
  Link closing{0, 0, 0};  // the best way to end the chain; gain = that of the closed tour, 0 = none
};

/// Consecutive cities that may go elsewhere, from first to last in direction `onwards`.
struct TourSearch::Stretch {
  City first, last, before, after;
  City count;
  bool onwards;
};

TourSearch::TourSearch(const std::vector<Point>& path, TourArray& tour, const Progress& progress)
    : tour_(tour), queued_(path.size(), 0) {
  find_neighbours(path, progress);
}

void TourSearch::find_neighbours(const std::vector<Point>& path, const Progress& progress) {
  neighbours_each_ = std::min(kNeighbours, path.size() - 1);
  neighbours_.reserve(neighbours_each_ * path.size());
  const PointTree tree(path, progress);
  Poll poll(progress, 4096);
  std::vector<City> found;
  for (City city = 0; city < tour_.dummy(); ++city) {
    poll.step();
    tree.nearest(city, neighbours_each_, found);
    neighbours_.insert(neighbours_.end(), found.begin(), found.end());
  }
}

void TourSearch::enqueue(City city) {
  if (city == tour_.dummy() || queued_[static_cast<std::size_t>(city)]) return;
  queued_[static_cast<std::size_t>(city)] = 1;
  queue_.push_back(city);
}

void TourSearch::enqueue_all() {
  for (City city = 0; city < tour_.dummy(); ++city) enqueue(city);
}

bool TourSearch::take_next(City& city) {
  if (queue_front_ == queue_.size()) {
    queue_.clear();
    queue_front_ = 0;
    return false;
  }
  if (2 * queue_front_ > queue_.size()) {
    queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(queue_front_));
    queue_front_ = 0;
  }
  city = queue_[queue_front_++];
  queued_[static_cast<std::size_t>(city)] = 0;
  return true;
}

bool TourSearch::shortest_possible(City city, Length move) const {
  if (neighbours_each_ == 0) return true;
  return move <= tour_.distance(city, neighbours_[static_cast<std::size_t>(city) * neighbours_each_]);
}

TourSearch::Length TourSearch::run(bool forget, const std::function<bool()>& stop) {
  Length gained = 0;
  int until_asked = kCitiesPerAsk;
  City city = 0;
  while (take_next(city)) {
    for (Length gain = improve(city); gain > 0; gain = improve(city)) {
      gained += gain;
      ++moves_;
    }
    if (forget) tour_.forget();
    if (--until_asked > 0) continue;
    until_asked = kCitiesPerAsk;
    if (stop && stop()) break;
  }
  return gained;
}

/// Applies the first move found that shortens the tour at a city; returns its gain, 0 if there is none.
TourSearch::Length TourSearch::improve(City city) {
  for (const bool onwards : {false, true}) {
    if (const Length gain = improve_by_insertion(city, onwards); gain > 0) return gain;
  }
  for (const bool onwards : {false, true}) {
    const City last = step(city, onwards);
    if (last == tour_.dummy()) continue;
    const Length gain = improve_by_chain(city, last, tour_.distance(city, last), 0, onwards);
    if (gain > 0) {
      enqueue(city);
      enqueue(last);
      return gain;
    }
  }
  return 0;
}

/// Imagine the tour open between base and last = step(base, onwards). Joining `last` to a city `to` instead, and
/// cutting `to` from `cut` = the city before it as seen from base, leaves the tour open between base and cut: a 2-opt
/// move if closed there, the next link of the chain if not.
void TourSearch::collect(City base, City last, Length gain, int depth, bool onwards, Chain& chain) const {
  const std::size_t breadth = kBreadth[static_cast<std::size_t>(depth)];
  const City* neighbour = &neighbours_[static_cast<std::size_t>(last) * neighbours_each_];
  for (std::size_t k = 0; k < neighbours_each_; ++k) {
    const City to = neighbour[k];
    const Length joined = gain - tour_.distance(last, to);
    if (joined <= 0) return;
    const City cut = step(to, !onwards);
    if (to == base || cut == last) continue;
    const City a = tour_.position(last), b = tour_.position(cut);
    if ((onwards ? tour_.shorter_count(a, b) : tour_.shorter_count(b, a)) > kReach) continue;
    const Chain::Link link{to, cut, joined + tour_.distance(to, cut)};
    if (const Length closed = link.gain - tour_.distance(cut, base); closed > chain.closing.gain) {
      chain.closing = {to, cut, closed};
    }
    if (depth + 1 == kDepth || cut == tour_.dummy()) continue;
    std::size_t place = chain.count;
    while (place > 0 && chain.links[place - 1].gain < link.gain) --place;
    if (place == breadth) continue;
    chain.count = std::min(chain.count + 1, breadth);
    for (std::size_t m = chain.count - 1; m > place; --m) chain.links[m] = chain.links[m - 1];
    chain.links[place] = link;
  }
}

void TourSearch::exchange(City last, City cut, bool onwards) {
  const City a = tour_.position(last), b = tour_.position(cut);
  if (onwards) {
    tour_.reverse_shorter(a, b);
  } else {
    tour_.reverse_shorter(b, a);
  }
}

TourSearch::Length TourSearch::improve_by_chain(City base, City last, Length gain, int depth, bool onwards) {
  Chain chain;
  if (neighbours_each_ == 0) return 0;
  collect(base, last, gain, depth, onwards, chain);
  if (chain.closing.gain > 0) {
    exchange(last, chain.closing.cut, onwards);
    enqueue(chain.closing.to);
    enqueue(chain.closing.cut);
    return chain.closing.gain;
  }
  for (std::size_t k = 0; k < chain.count; ++k) {
    const Chain::Link& link = chain.links[k];
    const std::size_t before = tour_.mark();
    exchange(last, link.cut, onwards);
    const bool now_onwards = tour_.next(base) == link.cut;
    if (const Length closed = improve_by_chain(base, link.cut, link.gain, depth + 1, now_onwards); closed > 0) {
      enqueue(link.to);
      enqueue(link.cut);
      return closed;
    }
    tour_.undo_to(before);
  }
  return 0;
}

/// Or-opt: up to kLongestInsertion cities from `city` on in one direction go between two neighbours elsewhere.
TourSearch::Length TourSearch::improve_by_insertion(City city, bool onwards) {
  Stretch s{city, city, step(city, !onwards), 0, 0, onwards};
  const Length cut = tour_.distance(s.before, city);
  for (s.count = 1; s.count <= kLongestInsertion; ++s.count) {
    if (s.count > 1) s.last = step(s.last, onwards);
    if (s.last == tour_.dummy()) return 0;
    s.after = step(s.last, onwards);
    if (s.last == s.before || s.after == s.before) return 0;
    const Length freed = cut + tour_.distance(s.last, s.after) - tour_.distance(s.before, s.after);
    if (const Length gain = insert_near(s, freed); gain > 0) return gain;
  }
  return 0;
}

TourSearch::Length TourSearch::insert_near(const Stretch& s, Length freed) {
  const Length cut = tour_.distance(s.before, s.first);
  const City* neighbour = &neighbours_[static_cast<std::size_t>(s.first) * neighbours_each_];
  for (std::size_t k = 0; k < neighbours_each_; ++k) {
    const City near = neighbour[k];
    const Length joined = tour_.distance(s.first, near);
    if (cut <= joined) return 0;
    if (freed <= joined) continue;
    const City first = tour_.position(s.first), there = tour_.position(near);
    if ((s.onwards ? tour_.count(first, there) : tour_.count(there, first)) <= s.count) continue;  // in the stretch
    for (const bool side : {false, true}) {
      const City far = step(near, side);
      if (far == s.first || far == s.last) continue;
      const Length gain = freed - joined + tour_.distance(near, far) - tour_.distance(s.last, far);
      if (gain <= 0 || !insert_between(s, near, far)) continue;
      for (const City c : {s.before, s.after, s.first, s.last, near, far}) enqueue(c);
      return gain;
    }
  }
  return 0;
}

/// Carries the stretch along the tour to its place between two neighbours, with s.first beside `near`, by at most three
/// reversals of what lies on the way. Does nothing and returns false if that is farther than the reach.
bool TourSearch::insert_between(const Stretch& s, City near, City far) {
  const City low = s.onwards ? s.first : s.last, high = s.onwards ? s.last : s.first;  // in the tour's order
  const City left = tour_.next(near) == far ? near : far, right = left == near ? far : near;
  const bool same_way_round = (left == near ? s.first : s.last) == low;
  const City ahead = tour_.count(tour_.position(high), tour_.position(left)) - 1;
  const City behind = tour_.count(tour_.position(right), tour_.position(low)) - 1;
  if (std::min(ahead, behind) > kReach) return false;
  if (ahead <= behind) {
    const City i = tour_.position(low), j = tour_.position(left);
    tour_.reverse(i, j);
    const City split = tour_.wrapped(i + ahead);
    tour_.reverse(i, split == 0 ? tour_.dummy() : split - 1);
    if (same_way_round) tour_.reverse(split, j);
  } else {
    const City i = tour_.position(right), j = tour_.position(high);
    tour_.reverse(i, j);
    const City split = tour_.wrapped(i + s.count);
    tour_.reverse(split, j);
    if (same_way_round) tour_.reverse(i, split == 0 ? tour_.dummy() : split - 1);
  }
  return true;
}

}  // namespace dwell
