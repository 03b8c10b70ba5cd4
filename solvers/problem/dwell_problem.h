#pragma once

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

#include "core/removal/removal_geometry.h"
#include "core/removal/removal_operator.h"
#include "solvers/problem/path_smoothness.h"
#include "solvers/problem/surface_rows.h"

namespace dwell {

/// Form terms that a specification may leave out: piston, tilt in x and y, power.
inline constexpr Index kMaxFormTerms = 6;

/// A random change of a part's removal, small and of mean zero: of the removal of this geometry, times e with standard
/// deviation `factor`. The part's own geometry stands for a change of the rate.
struct RemovalChange {
  std::shared_ptr<const RemovalGeometry> geometry;
  double factor = 0.0;
};

/// One tool, or one pass of it: a stretch of the dwell vector with a path of its own.
struct DwellPart {
  /// The removal function and strokes of which its removal is made, if it is: with them solvers can work on coarser
  /// pixels. Null = not known.
  std::shared_ptr<const RemovalGeometry> geometry{};
  PathSmoothness smoothness{};    // its D; empty = none
  std::optional<double> alpha{};  // in place of the problem's, >= 0 [nm^2/s^2]
  double price = 1.0;             // of its seconds over gamma, > 0
  /// Of its removal, in the order of the blocks of the problem's rows; with geometry only.
  std::vector<RemovalChange> changes{};

  /// Its dwell points, as geometry or smoothness know them; 0 if neither does.
  Index points() const { return geometry ? static_cast<Index>(geometry->strokes.size()) : smoothness.size(); }
};

/// The dwell problem (docs/math.md):
///
///   minimise  1/2 |W P (A t - z)|^2 + alpha/2 |D (t - l)|^2 + beta/2 |t - t0|^2 + gamma 1't   subject to  l <= t <= u
///
/// Smoothness acts on the surplus over the least dwell l: where the machine must be slow, as in a turn, the steps that
/// l has of its own are not the plan's to smooth, and to spread them over their surroundings would only cost residual.
///
/// P removes the form terms that the specification does not count, in the least-squares sense of the weights: W P = (I
/// - Q Q') W with Q = `form`, orthonormal columns spanning W times the terms. A pixel of weight zero thus influences
/// neither the fit nor the form.
///
/// An objective in slopes has rows R (SurfaceRows): A is then R times the removal, z is R times the heights, and Q and
/// W are of the rows. Mean squares are over the pixels in any case, so that weights carry the units: those of slopes
/// are lengths [mm].
///
/// An expected residual has blocks of rows (ExpectedRemoval): the first is the removal less the target, each other what
/// a random change of the removal makes of it, without a target; W, P and R are of each block alike, and parts say what
/// the changes are. All changes of one block are one error, that of every part.
///
/// Several tools or passes are one problem: A = [A_1 A_2 ...] (StackedRemoval), the dwell vectors one after the other,
/// and for each a part that says its own smoothness, price and geometry; alpha |D (t - l)|^2 and gamma 1't are then the
/// sums over the parts.
struct DwellProblem {
  RemovalOperator* removal = nullptr;       // A, not owned [nm/s]; of rows [nm/s, urad/s]
  std::shared_ptr<const SurfaceRows> rows;  // R; null = the heights of the m pixels
  Vector target;                            // z, m [nm]; of rows [nm, urad]
  Eigen::MatrixXd form;                     // Q, m x 0..kMaxFormTerms
  Vector weights;                           // diagonal of W, m, >= 0; empty = all one
  std::vector<DwellPart> parts;             // stretches of t, in order; empty = one part of which nothing is known
  double alpha = 0.0;                       // >= 0 [nm^2/s^2]
  double beta = 0.0;                        // >= 0 [nm^2/s^2]
  double gamma = 0.0;                       // >= 0, price of a second [nm^2/s]
  Vector reference;                         // t0, n [s]; empty = zero
  Vector lower;                             // l, n, finite [s]
  Vector upper;                             // u, n, > = l, may be infinite [s]; empty = infinite

  /// Of rows, each of residuals() / blocks().
  Index blocks() const { return parts.empty() ? 1 : 1 + static_cast<Index>(parts.front().changes.size()); }
  /// What a mean square is over.
  Index pixels() const { return rows ? rows->pixels() : target.size() / blocks(); }
  /// Entries of a residual: as many as pixels, but with rows theirs, for each of the blocks.
  Index residuals() const { return target.size(); }
  Index points() const { return lower.size(); }
  double upper_at(Index j) const;
  /// The weight of a part's smoothness.
  double alpha_of(const DwellPart& part) const { return part.alpha.value_or(alpha); }
  /// Whether it is known of every part what its removal is made of.
  bool has_geometry() const;
  /// Threads that the geometry asks for; 1 if it is not known.
  int threads() const;
};

/// Calls visit(part, first dwell point, number of dwell points) for the parts in order.
template <class Visit>
void for_parts(const DwellProblem& problem, const Visit& visit) {
  Index first = 0;
  for (const DwellPart& part : problem.parts) {
    const Index points = problem.parts.size() == 1 ? problem.points() : part.points();
    visit(part, first, points);
    first += points;
  }
}

/// Throws std::invalid_argument naming field, index and value of the first fault: a size, a NaN, an infinity where none
/// is allowed, a negative weight, l > u.
void validate(const DwellProblem& problem);

/// Sum over the parts of alpha |D (t - l)|^2 [nm^2].
double smoothness_term(const DwellProblem& problem, const Vector& t);

/// Sum over the parts of alpha |D d|^2 for a change d of the dwell [nm^2].
double squared_steps(const DwellProblem& problem, const Vector& d);

/// The seconds of a dwell, or of a change of one, each at the price of its part [s].
double priced_total(const DwellProblem& problem, const Vector& t);

/// out += factor times what a second of each dwell point adds to priced_total.
void add_prices(const DwellProblem& problem, double factor, Vector& out);

/// out += alpha D'D d for a change d of the dwell, part by part.
void add_smoothness(const DwellProblem& problem, const Vector& d, Vector& out);

/// |D (t - l)| / sqrt(number of links) over all parts: how much the dwell, as far as it is the plan's to choose,
/// changes from one stroke to the next [s]. 0 without links.
double step_rms(const DwellProblem& problem, const Vector& t);

/// The objective's terms that do not see the surface: smoothness, distance from the reference, price of time [nm^2].
double penalty(const DwellProblem& problem, const Vector& t);

/// g += gradient of the penalty: alpha D'D (t - l) + beta (t - t0) + gamma 1.
void add_penalty_gradient(const DwellProblem& problem, const Vector& t, Vector& g);

/// Moves t into [l, u] componentwise.
void clip_to_bounds(const DwellProblem& problem, Vector& t);

/// The objective of a dwell problem and its derivatives, with the form projection applied. Owns its workspace: one
/// caller at a time. Every call states its operator applications.
class DwellObjective {
 public:
  explicit DwellObjective(const DwellProblem& problem);

  /// r = W P (A t - z). One application; none at t = 0.
  void residual(const Vector& t, Vector& r);
  /// Residual and gradient at t; returns the objective. Two applications; at t = 0 one, which also gives the scale of
  /// the gradient, so that gradient_scale() costs nothing afterwards.
  double evaluate(const Vector& t, Vector& r, Vector& g);
  /// image = W P A d. One application.
  void image(const Vector& d, Vector& image);
  /// g = A' P' W' r + alpha D'D (t - l) + beta (t - t0) + gamma 1, for r a residual. One application.
  void gradient(const Vector& r, const Vector& t, Vector& g);
  /// h = (A' P' W' W P A + alpha D'D + beta I) d, given image = W P A d. One application.
  void hessian_times(const Vector& d, const Vector& image, Vector& h);
  /// d' H d, given image = W P A d. No application.
  double curvature(const Vector& d, const Vector& image) const;
  /// Objective at t, given r. No application.
  double value(const Vector& r, const Vector& t) const;
  /// r += a image: the residual after a step of a along d, given image = W P A d. No application.
  void advance(double a, const Vector& image, Vector& r) const;
  /// |A' P' W' W P z|: the scale against which gradients are measured. One application, computed once.
  double gradient_scale();

 private:
  void weigh_and_project(Vector& v) const;
  void project(Eigen::Ref<Vector> v) const;
  void adjoint_of_weighted(const Vector& r, Vector& g);
  double squared_norm(const Vector& v) const;
  int threads() const;

  const DwellProblem& problem_;
  Vector weighted_;
  double gradient_scale_ = -1.0;
};

/// Gradient restricted to what the bounds allow to move: zero where t is at a bound and the gradient pushes outward.
void project_gradient(const DwellProblem& problem, const Vector& t, const Vector& gradient, Vector& projected);

}  // namespace dwell
