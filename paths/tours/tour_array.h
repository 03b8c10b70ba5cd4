#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/point.h"

namespace dwell {

/// A closed tour of cities 0..n-1 and a dummy city n that costs nothing to visit and stands between the two ends of an
/// open path, held as an array. City i is the i-th point of the path given. Every change is a reversal of a stretch and
/// is logged, so that it can be undone. improve_tour works on it.
class TourArray {
 public:
  using City = std::int32_t;
  using Length = std::int64_t;  // 2^-36 of the diagonal of the points' box; a path of 2^26 points cannot overflow

  /// At least one point; all finite. With fixed_start the dummy city stays beside city 0: parting them costs more than
  /// any move gains.
  TourArray(const std::vector<Point>& path, bool fixed_start);

  City dummy() const { return dummy_; }
  City size() const { return dummy_ + 1; }
  City at(City position) const { return order_[index(position)]; }
  City position(City city) const { return position_[index(city)]; }
  City next(City city) const {
    const City p = position(city) + 1;
    return order_[index(p == size() ? 0 : p)];
  }
  City previous(City city) const {
    const City p = position(city);
    return order_[index(p == 0 ? dummy_ : p - 1)];
  }
  Length distance(City a, City b) const;

  /// The number of cities from position i onwards to position j, both included.
  City count(City i, City j) const { return j - i + 1 + (j < i ? size() : 0); }
  City wrapped(City position) const { return position >= size() ? position - size() : position; }

  /// Reverses the stretch of positions i..j (onwards, across the end of the array if j < i).
  void reverse(City i, City j);
  /// Gives the same tour, perhaps run the other way round, for at most half the work: if the rest is shorter, it is
  /// reversed instead.
  void reverse_shorter(City i, City j);
  /// The number of cities that reverse_shorter would move.
  City shorter_count(City i, City j) const;

  std::size_t mark() const { return log_.size(); }
  void undo_to(std::size_t mark);
  void forget() { log_.clear(); }

  /// The cities of the open path in order; from city 0 if the start is fixed.
  std::vector<City> open_path() const;

 private:
  static std::size_t index(City city) { return static_cast<std::size_t>(city); }
  void turn(City i, City j);

  City dummy_;
  bool fixed_start_;
  std::vector<Point> places_;  // in units of Length
  std::vector<City> order_, position_;
  std::vector<std::pair<City, City>> log_;
};

}  // namespace dwell
