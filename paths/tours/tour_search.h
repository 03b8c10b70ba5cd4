#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/progress.h"
#include "paths/tours/tour_array.h"

namespace dwell {

/// The local search of improve_tour: takes cities from a queue and applies the first move that shortens the tour there,
/// until the queue is empty.
class TourSearch {
 public:
  using City = TourArray::City;
  using Length = TourArray::Length;

  /// `path`: the points of the cities, finite.
  TourSearch(const std::vector<Point>& path, TourArray& tour, const Progress& progress = {});

  void enqueue(City city);
  void enqueue_all();

  /// Works through the queue and returns the length gained. forget: the changes need not be undone. Asks `stop` now and
  /// then and returns early if it says so.
  Length run(bool forget, const std::function<bool()>& stop);

  /// Whether a move of this length from the city is no longer than the distance to its nearest neighbour.
  bool shortest_possible(City city, Length move) const;

  std::int64_t moves() const { return moves_; }

 private:
  struct Chain;
  struct Stretch;

  void find_neighbours(const std::vector<Point>& path, const Progress& progress);
  bool take_next(City& city);
  Length improve(City city);
  Length improve_by_chain(City base, City last, Length gain, int depth, bool onwards);
  void collect(City base, City last, Length gain, int depth, bool onwards, Chain& chain) const;
  void exchange(City last, City cut, bool onwards);
  Length improve_by_insertion(City city, bool onwards);
  Length insert_near(const Stretch& stretch, Length freed);
  bool insert_between(const Stretch& stretch, City near, City far);
  City step(City city, bool onwards) const { return onwards ? tour_.next(city) : tour_.previous(city); }

  TourArray& tour_;
  std::size_t neighbours_each_ = 0;
  std::vector<City> neighbours_;  // neighbours_each_ a city, nearest first
  std::vector<City> queue_;
  std::size_t queue_front_ = 0;
  std::vector<char> queued_;
  std::int64_t moves_ = 0;
};

}  // namespace dwell
