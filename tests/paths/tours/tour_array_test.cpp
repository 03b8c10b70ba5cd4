#include "paths/tours/tour_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "paths/tours/tour_search.h"

namespace dwell {
namespace {

using City = TourArray::City;

std::vector<Point> scattered(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(-3.0, 5.0), y(10.0, 40.0);
  std::vector<Point> points(n);
  for (Point& p : points) p = {x(random), y(random)};
  return points;
}

std::vector<City> cities(const TourArray& tour) {
  std::vector<City> all;
  for (City k = 0; k < tour.size(); ++k) all.push_back(tour.at(k));
  return all;
}

/// The neighbours of every city, which say all about a closed tour but its direction and beginning.
std::vector<std::pair<City, City>> links(const std::vector<City>& closed) {
  std::vector<std::pair<City, City>> result;
  for (std::size_t k = 0; k < closed.size(); ++k) {
    const City a = closed[k], b = closed[(k + 1) % closed.size()];
    result.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(TourArray, ReversesAcrossItsEndAndUndoes) {
  std::mt19937 random(2);
  TourArray tour(scattered(12, 1), false);
  std::vector<City> plain = cities(tour);
  const std::vector<City> given = plain;
  for (int k = 0; k < 200; ++k) {
    const City i = static_cast<City>(random() % 13), j = static_cast<City>(random() % 13);
    const City n = tour.count(i, j);
    std::vector<City> stretch;
    for (City m = 0; m < n; ++m) stretch.push_back(plain[static_cast<std::size_t>((i + m) % 13)]);
    for (City m = 0; m < n; ++m) {
      plain[static_cast<std::size_t>((i + m) % 13)] = stretch[static_cast<std::size_t>(n - 1 - m)];
    }
    const std::vector<City> before = cities(tour);
    const std::size_t mark = tour.mark();
    tour.reverse_shorter(i, j);
    EXPECT_EQ(links(cities(tour)), links(plain));
    EXPECT_LE(tour.shorter_count(i, j), 6);
    tour.undo_to(mark);
    EXPECT_EQ(cities(tour), before);
    tour.reverse(i, j);
    plain = cities(tour);
    for (City p = 0; p < 13; ++p) EXPECT_EQ(tour.position(tour.at(p)), p);
  }
  tour.undo_to(0);
  EXPECT_EQ(cities(tour), given);
}

TEST(TourArray, GainsOfTheSearchAreExactlyWhatTheTourLoses) {
  for (const bool fixed : {false, true}) {
    for (const std::size_t n : {5u, 40u, 700u}) {
      const std::vector<Point> path = scattered(n, static_cast<unsigned>(n));
      TourArray tour(path, fixed);
      const auto total = [&] {
        TourArray::Length sum = 0;
        for (City k = 0; k < tour.size(); ++k) sum += tour.distance(tour.at(k), tour.next(tour.at(k)));
        return sum;
      };
      const TourArray::Length before = total();
      TourSearch search(path, tour);
      search.enqueue_all();
      const TourArray::Length gained = search.run(false, {});
      EXPECT_GT(gained, 0);
      EXPECT_EQ(before - total(), gained);
      if (fixed) {
        EXPECT_EQ(tour.open_path().front(), 0);
      }
      tour.undo_to(0);
      EXPECT_EQ(total(), before);
    }
  }
}

}  // namespace
}  // namespace dwell
