#include "paths/feed/linear_schedule.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "paths/feed/banded_system.h"
#include "paths/feed/constant_schedule.h"
#include "paths/feed/least_dwell.h"

namespace dwell {
namespace {

TEST(BandedSystem, SolvesAsADenseMatrixDoes) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  constexpr Index kSize = 17;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(40, kSize);
  for (Index i = 0; i < rows.rows(); ++i) {
    const Index first = i % (kSize - 4);
    for (Index k = 0; k < 5; ++k) rows(i, first + k) = normal(random);
  }
  const Eigen::MatrixXd dense = rows.transpose() * rows + 0.1 * Eigen::MatrixXd::Identity(kSize, kSize);
  BandedSystem banded(kSize);
  std::vector<double> x(kSize);
  for (Index i = 0; i < kSize; ++i) {
    x[static_cast<std::size_t>(i)] = normal(random);
    for (Index k = 0; k < 5 && i + k < kSize; ++k)
      banded.add(static_cast<std::size_t>(i), static_cast<std::size_t>(k), dense(i, i + k));
  }
  const Eigen::VectorXd expected = dense.ldlt().solve(Eigen::VectorXd::Map(x.data(), kSize));
  banded.solve(x);
  EXPECT_LE((Eigen::VectorXd::Map(x.data(), kSize) - expected).cwiseAbs().maxCoeff(), 1e-10);
}

/// Half-millimetre steps that turn at four points in ten.
ToolPath turning_path(int points) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  ToolPath path{"file", {}, {}};
  Point at{1.0, -2.0};
  double heading = 0.2;
  for (int i = 0; i < points; ++i) {
    if (unit(random) < 0.4) heading += 2.2 * (unit(random) - 0.45);
    at = at + Point{0.5 * std::cos(heading), 0.5 * std::sin(heading)};
    path.points.push_back(at);
  }
  path.lifted.assign(path.points.size(), 0);
  path.lifted[0] = path.lifted[static_cast<std::size_t>(points / 3)] = 1;
  return path;
}

struct TurningCase {
  Machine machine;
  StrokeMoves moves;
  KinematicPath path;
  Eigen::VectorXd dwell;

  explicit TurningCase(double above_least) {
    machine.x.max_acceleration = 60.0;
    machine.path_acceleration = 50.0;
    machine.max_feed = 10.0;
    moves = stroke_moves(turning_path(240), Motion::Moving);
    path = kinematic_path(moves.steps, machine);
    dwell = least_dwell(moves, path, machine) * above_least;
    for (Index j = 0; j < dwell.size(); ++j)
      dwell[j] = std::max(dwell[j], 0.12 + 0.05 * std::sin(0.2 * static_cast<double>(j)));
  }
};

TEST(LinearSchedule, KeepsCornersSpeedsAndAccelerations) {
  const TurningCase c(1.02);
  const LinearSchedule schedule = schedule_linear(c.moves, c.path, c.machine, c.dwell);
  ASSERT_EQ(schedule.speed.size(), 2 * c.moves.size() + 1);
  Eigen::VectorXd times = Eigen::VectorXd::Zero(c.dwell.size());
  for (std::size_t i = 0; i < c.moves.size(); ++i) {
    const KinematicMove& move = c.path.moves[i];
    EXPECT_LE(schedule.speed[2 * i] * schedule.speed[2 * i], c.path.corner[i] + 1e-12);
    for (std::size_t k = 2 * i; k < 2 * i + 2; ++k) {
      const double v = schedule.speed[k], next = schedule.speed[k + 1];
      EXPECT_LE(v, move.max_speed);
      EXPECT_LE(std::abs(next * next - v * v), move.acceleration * move.length * (1.0 + 1e-12));
      if (c.moves.stroke[i] != StrokeMoves::kNoStroke) times[c.moves.stroke[i]] += move.length / (v + next);
    }
  }
  EXPECT_LE((times - schedule.seconds).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(LinearSchedule, HoldsTimesThatOneFeedAStrokeCannot) {
  const auto error = [](const Eigen::VectorXd& seconds, const Eigen::VectorXd& dwell) {
    return std::sqrt((seconds - dwell).cwiseQuotient(dwell).squaredNorm() / static_cast<double>(dwell.size()));
  };
  const TurningCase tight(1.02);
  const double linear =
      error(schedule_linear(tight.moves, tight.path, tight.machine, tight.dwell).seconds, tight.dwell);
  const double constant =
      error(schedule_constant(tight.moves, tight.path, tight.machine, tight.dwell).seconds, tight.dwell);
  EXPECT_LE(linear, 0.01);
  EXPECT_LE(linear, 0.3 * constant);
  const TurningCase loose(1.5);
  EXPECT_LE(schedule_linear(loose.moves, loose.path, loose.machine, loose.dwell).worst_error, 0.01);
}

}  // namespace
}  // namespace dwell
