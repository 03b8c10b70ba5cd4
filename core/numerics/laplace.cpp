#include "core/numerics/laplace.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/base/counted.h"

namespace dwell {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
using Triplets = std::vector<Eigen::Triplet<double, int>>;

constexpr Index kDirectUnknowns = 2000;

// Pixels that are not unknown: those that hold a value, and those that let nothing through.
constexpr int kHeld = -1, kVoid = -2;

/// A level's own pixels: number of each one's unknown, or kHeld or kVoid.
struct Places {
  Index rows = 0, cols = 0;
  std::vector<int> number;  // rows * cols
  Index count = 0;

  int at(Index row, Index col) const {
    return row < rows && col < cols ? number[static_cast<std::size_t>(row * cols + col)] : kVoid;
  }
};

/// The next level: of every second pixel of every second row, those that are unknown. So every coarse unknown is a fine
/// one, and the coarse matrix is as definite as the fine one.
Places coarser(const Places& fine) {
  Places coarse{(fine.rows + 1) / 2, (fine.cols + 1) / 2, {}, 0};
  coarse.number.reserve(static_cast<std::size_t>(coarse.rows * coarse.cols));
  for (Index r = 0; r < coarse.rows; ++r) {
    for (Index c = 0; c < coarse.cols; ++c) {
      const int number = fine.at(2 * r, 2 * c);
      coarse.number.push_back(number >= 0 ? static_cast<int>(coarse.count++) : number);
    }
  }
  return coarse;
}

/// Bilinear between the coarse pixels around each fine one. Coarse pixels that hold a value count as zero. Where a
/// coarse pixel lets nothing through, the others take over its weight, so that a constant stays constant there.
Matrix interpolation(const Places& fine, const Places& coarse) {
  Triplets entries;
  for (Index r = 0; r < fine.rows; ++r) {
    for (Index c = 0; c < fine.cols; ++c) {
      const int unknown = fine.at(r, c);
      if (unknown < 0) continue;
      std::array<int, 4> parents{};
      std::size_t count = 0;
      for (Index cr = r / 2; cr <= (r + 1) / 2; ++cr) {
        for (Index cc = c / 2; cc <= (c + 1) / 2; ++cc) {
          if (coarse.at(cr, cc) != kVoid) parents[count++] = coarse.at(cr, cc);
        }
      }
      for (std::size_t k = 0; k < count; ++k) {
        if (parents[k] >= 0) entries.emplace_back(unknown, parents[k], 1.0 / static_cast<double>(count));
      }
    }
  }
  Matrix p(fine.count, coarse.count);
  p.setFromTriplets(entries.begin(), entries.end());
  return p;
}

/// The matrices of all levels and one V-cycle over them.
class Multigrid {
 public:
  Multigrid(const Matrix& a, Places places) {
    levels_.push_back({a, {}, {}, {}, {}});
    while (places.count > kDirectUnknowns) {
      Places next = coarser(places);
      if (next.count == 0) break;
      Level& fine = levels_.back();
      fine.up = interpolation(places, next);
      Matrix coarse = fine.up.transpose() * Matrix(fine.a * fine.up);
      levels_.push_back({coarse, {}, {}, {}, {}});
      places = std::move(next);
    }
    for (Level& level : levels_) level.diagonal = level.a.diagonal();
    if (levels_.back().a.rows() <= kDirectUnknowns) {
      coarsest_ = std::make_unique<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>>(levels_.back().a);
    }
  }

  const Matrix& matrix() const { return levels_.front().a; }

  /// x = M b with M symmetric and positive definite, near to the inverse of the matrix.
  void apply(const Vector& b, Vector& x) {
    levels_.front().b = b;
    cycle(0);
    x = levels_.front().x;
  }

 private:
  struct Level {
    Matrix a, up;  // up: from the next coarser level to this one
    Vector diagonal, b, x;
  };

  void cycle(std::size_t depth) {
    Level& level = levels_[depth];
    if (depth + 1 == levels_.size() && coarsest_) {
      level.x = coarsest_->solve(level.b);
      return;
    }
    level.x = Vector::Zero(level.b.size());
    for (Index i = 0; i < level.b.size(); ++i) relax(level, i);
    if (depth + 1 < levels_.size()) {
      Level& next = levels_[depth + 1];
      next.b = level.up.transpose() * (level.b - level.a * level.x);
      cycle(depth + 1);
      level.x += level.up * next.x;
    }
    for (Index i = level.b.size() - 1; i >= 0; --i) relax(level, i);
  }

  static void relax(Level& level, Index i) {
    double rest = level.b[i];
    for (Matrix::InnerIterator entry(level.a, i); entry; ++entry) rest -= entry.value() * level.x[entry.col()];
    level.x[i] += rest / level.diagonal[i];
  }

  std::vector<Level> levels_;
  std::unique_ptr<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>> coarsest_;
};

Places places_of(const Grid& grid, std::span<const unsigned char> unknown, std::span<const double> values) {
  Places places{grid.rows, grid.cols, {}, 0};
  places.number.reserve(unknown.size());
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    const int other = std::isfinite(values[i]) ? kHeld : kVoid;
    places.number.push_back(unknown[i] != 0 ? static_cast<int>(places.count++) : other);
  }
  return places;
}

struct System {
  Matrix a;
  Vector b;
};

/// The mean of the values that are held. Solving for the difference from it keeps a large piston out of the tolerance.
double mean_held(const Places& places, std::span<const double> values) {
  double sum = 0.0;
  Index count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (places.number[i] >= 0 || !std::isfinite(values[i])) continue;
    sum += values[i];
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

System five_point_system(const Grid& grid, const Places& places, std::span<const double> values, double mean) {
  System system{Matrix(places.count, places.count), Vector::Zero(places.count)};
  // Differences in the direction of the larger pitch weigh less; the larger weight is one.
  const double least = std::min(grid.pitch_x, grid.pitch_y);
  const double along_x = std::pow(least / grid.pitch_x, 2), along_y = std::pow(least / grid.pitch_y, 2);
  Triplets entries;
  entries.reserve(static_cast<std::size_t>(5 * places.count));
  for (Index r = 0; r < grid.rows; ++r) {
    for (Index c = 0; c < grid.cols; ++c) {
      const int unknown = places.at(r, c);
      if (unknown < 0) continue;
      double sum = 0.0;
      const auto link = [&](Index row, Index col, double weight) {
        if (row < 0 || col < 0 || row >= grid.rows || col >= grid.cols) return;
        const double value = values[static_cast<std::size_t>(grid.index(row, col))];
        const int other = places.at(row, col);
        if (other < 0 && !std::isfinite(value)) return;
        sum += weight;
        if (other >= 0) {
          entries.emplace_back(unknown, other, -weight);
        } else {
          system.b[unknown] += weight * (value - mean);
        }
      };
      link(r, c - 1, along_x), link(r, c + 1, along_x), link(r - 1, c, along_y), link(r + 1, c, along_y);
      entries.emplace_back(unknown, unknown, sum > 0.0 ? sum : 1.0);
    }
  }
  system.a.setFromTriplets(entries.begin(), entries.end());
  return system;
}

void conjugate_gradients(Multigrid& multigrid, const Vector& b, Vector& x, LaplaceSummary& summary,
                         const Progress& progress) {
  constexpr double kTolerance = 1e-11;
  constexpr int kMaxIterations = 500;
  const double size = b.norm();
  if (!(size > 0.0)) return;  // x = 0
  Vector r = b - multigrid.matrix() * x, z, p, ap;
  double rho = 0.0;
  for (int iteration = 0;; ++iteration) {
    summary.iterations = iteration;
    summary.residual = r.norm() / size;
    if (summary.residual <= kTolerance) return;
    if (iteration == kMaxIterations || !std::isfinite(summary.residual)) {
      throw std::runtime_error(fmt::format("Laplace's equation on {}: residual {} after {}",
                                           counted(summary.unknowns, "pixel"), summary.residual,
                                           counted(iteration, "iteration")));
    }
    progress.step(fmt::format("harmonic: {}, iteration {}, residual {:.1e}", counted(summary.unknowns, "pixel"),
                              iteration, summary.residual));
    multigrid.apply(r, z);
    const double rho_new = r.dot(z);
    p = iteration == 0 ? z : Vector(z + (rho_new / rho) * p);
    rho = rho_new;
    ap = multigrid.matrix() * p;
    const double step = rho / p.dot(ap);
    x += step * p;
    r -= step * ap;
  }
}

}  // namespace

LaplaceSummary solve_laplace(const Grid& grid, std::span<const unsigned char> unknown, std::span<double> values,
                             const Progress& progress) {
  LaplaceSummary summary;
  const Places places = places_of(grid, unknown, values);
  summary.unknowns = places.count;
  if (places.count == 0) return summary;
  progress.step(fmt::format("harmonic: {}, setting up", counted(places.count, "pixel")));
  const double mean = mean_held(places, values);
  const System system = five_point_system(grid, places, values, mean);
  Multigrid multigrid(system.a, places);
  Vector x = Vector::Zero(places.count);
  conjugate_gradients(multigrid, system.b, x, summary, progress);
  for (std::size_t i = 0; i < places.number.size(); ++i) {
    if (places.number[i] >= 0) values[i] = mean + x[places.number[i]];
  }
  return summary;
}

}  // namespace dwell
