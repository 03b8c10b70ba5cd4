#include "paths/tours/tour_array.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dwell {
namespace {

constexpr double kUnits = 68719476736.0;  // 2^36
constexpr double kHalf = 0.5;
constexpr TourArray::Length kBond = TourArray::Length{1} << 40;  // more than any gain of one move

}  // namespace

TourArray::TourArray(const std::vector<Point>& path, bool fixed_start)
    : dummy_(static_cast<City>(path.size())),
      fixed_start_(fixed_start),
      places_(path.size()),
      order_(path.size() + 1),
      position_(path.size() + 1) {
  std::iota(order_.begin(), order_.end(), 0);
  position_ = order_;
  Point low = path.front(), high = path.front();
  for (const Point p : path) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double diagonal = dwell::distance(low, high);
  if (!(diagonal > 0.0)) return;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Point p = path[i] - low;
    places_[i] = {p.x / diagonal * kUnits, p.y / diagonal * kUnits};
  }
}

TourArray::Length TourArray::distance(City a, City b) const {
  if (a == dummy_ || b == dummy_) return fixed_start_ && std::min(a, b) == 0 ? -kBond : 0;
  const Point d = places_[index(a)] - places_[index(b)];
  return static_cast<Length>(std::sqrt(d.x * d.x + d.y * d.y) + kHalf);  // std::llround costs more than the square root
}

void TourArray::turn(City i, City j) {
  for (City swaps = count(i, j) / 2; swaps > 0; --swaps) {
    const City a = order_[index(i)], b = order_[index(j)];
    order_[index(i)] = b;
    position_[index(b)] = i;
    order_[index(j)] = a;
    position_[index(a)] = j;
    if (++i == size()) i = 0;
    if (--j < 0) j = dummy_;
  }
}

void TourArray::reverse(City i, City j) {
  log_.emplace_back(i, j);
  turn(i, j);
}

void TourArray::reverse_shorter(City i, City j) {
  if (2 * count(i, j) > size()) {
    const City after = wrapped(j + 1);
    j = i == 0 ? dummy_ : i - 1;
    i = after;
  }
  reverse(i, j);
}

TourArray::City TourArray::shorter_count(City i, City j) const {
  const City inside = count(i, j);
  return std::min(inside, size() - inside);
}

void TourArray::undo_to(std::size_t mark) {
  while (log_.size() > mark) {
    turn(log_.back().first, log_.back().second);
    log_.pop_back();
  }
}

std::vector<TourArray::City> TourArray::open_path() const {
  std::vector<City> cities;
  cities.reserve(places_.size());
  const bool backwards = fixed_start_ && previous(dummy_) == 0;
  for (City k = 1; k < size(); ++k) {
    cities.push_back(at(wrapped(position(dummy_) + (backwards ? size() - k : k))));
  }
  return cities;
}

}  // namespace dwell
