#pragma once

// Slow and simple answers about motion, which share no code with what they judge.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/motion/program.h"

namespace dwell::test {

/// The speed of a controller that looks ahead over a chain of straight moves with one acceleration everywhere. At every
/// place its square is the least over all moves of feed^2 + 2 a (way to the move), and over all nodes of their cap + 2
/// a (way to the node): O(moves) for every place, in no order.
class SpeedOracle {
 public:
  SpeedOracle(const std::vector<ProgramStep>& steps, double acceleration, const std::vector<double>& corner)
      : acceleration_(acceleration), corner_(corner) {
    place_.push_back(0.0);
    for (const ProgramStep& step : steps) {
      place_.push_back(place_.back() + step.length());
      feed_.push_back(step.length() / step.seconds);
    }
  }

  double squared_speed(double s) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < feed_.size(); ++i) {
      const double way = std::max({0.0, place_[i] - s, s - place_[i + 1]});
      least = std::min(least, feed_[i] * feed_[i] + 2.0 * acceleration_ * way);
    }
    for (std::size_t i = 0; i < place_.size(); ++i)
      least = std::min(least, corner_[i] + 2.0 * acceleration_ * std::abs(s - place_[i]));
    return least;
  }

  /// Time of move i, by so many parts: exact where the speed's square is linear in the place, which it is piecewise.
  double seconds(std::size_t i, int parts = 4000) const {
    double sum = 0.0, before = std::sqrt(squared_speed(place_[i]));
    for (int k = 1; k <= parts; ++k) {
      const double s = place_[i] + (place_[i + 1] - place_[i]) * k / parts, now = std::sqrt(squared_speed(s));
      sum += 2.0 * (place_[i + 1] - place_[i]) / parts / (before + now);
      before = now;
    }
    return sum;
  }

  double begin_of(std::size_t i) const { return place_[i]; }

 private:
  double acceleration_;
  std::vector<double> corner_, place_, feed_;
};

/// A chain of moves that turns at every node, with feeds between two bounds; without symmetry.
inline std::vector<ProgramStep> crooked_chain(unsigned seed, int moves, double slowest, double fastest) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<ProgramStep> steps;
  Point at{-3.0, 1.5};
  double heading = 0.3;
  for (int i = 0; i < moves; ++i) {
    heading += 2.4 * (unit(random) - 0.4);
    const double length = 0.3 + 1.4 * unit(random), feed = slowest + (fastest - slowest) * unit(random);
    const Point to = at + length * Point{std::cos(heading), std::sin(heading)};
    steps.push_back({at, to, distance(at, to) / feed, true});
    at = to;
  }
  return steps;
}

}  // namespace dwell::test
