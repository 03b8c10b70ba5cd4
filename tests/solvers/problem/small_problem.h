#pragma once

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "core/removal/sparse_removal.h"
#include "solvers/problem/dwell_problem.h"

namespace dwell::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The objective of a dwell problem written out as 1/2 t'H t + c't + constant, from the definition alone: shares no
/// code with the library.
struct Quadratic {
  Eigen::MatrixXd h;
  Vector c;
  double constant = 0.0;

  double value(const Vector& t) const { return 0.5 * t.dot(h * t) + c.dot(t) + constant; }
  Vector gradient(const Vector& t) const { return h * t + c; }
};

/// A dwell problem that owns its matrix and remembers from what its smoothness was made.
struct SmallProblem {
  Eigen::MatrixXd a;
  std::vector<double> lengths;  // of the strokes; empty = no smoothness
  std::vector<char> joined;
  std::unique_ptr<SparseRemoval> removal;
  DwellProblem problem;

  /// No terms but the fit; bounds 0 and infinity.
  SmallProblem(Eigen::MatrixXd matrix, Vector target);
  void set_smoothness(double alpha, std::vector<double> stroke_lengths, std::vector<char> stroke_joined);

  Quadratic quadratic() const;
};

/// What a random problem is to contain.
struct Recipe {
  Index pixels = 200;
  Index points = 6;
  bool upper = true;            // finite upper bounds
  bool terms = true;            // weights (some zero), form, smoothness, reference, price
  bool rank_deficient = false;  // duplicate columns
};

/// Overlapping bumps along a line, a target that wants bounds active on both sides.
SmallProblem random_problem(const Recipe& recipe, unsigned seed);

/// The minimiser within the bounds by trying every set of active bounds: at most 8 points. Among the optima there is
/// one whose free block is regular (an extreme point), so singular blocks are passed over.
Vector minimise_by_enumeration(const SmallProblem& small);

/// The minimiser by coordinate descent until a sweep changes nothing that counts.
Vector minimise_by_coordinates(const SmallProblem& small);

/// |A' W P z|, the scale of gradient tolerances.
double gradient_scale(const SmallProblem& small);

/// How far the objective at t may be above that of the optimum if |projected gradient| <= tolerance * scale: by
/// convexity f(t) - f* <= g'(t - t*) <= |projected gradient| |t - t*|. Plus rounding of the objective's own terms.
double objective_slack(const SmallProblem& small, double tolerance, const Vector& t, const Vector& optimum);

}  // namespace dwell::test
