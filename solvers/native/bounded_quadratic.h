#pragma once

#include <vector>

#include "solvers/problem/box_minimiser.h"

namespace dwell {

/// Conjugate gradients in a box (after More and Toraldo 1991, "On the solution of large quadratic programming problems
/// with bound constraints"): spectral projected-gradient steps find which bounds hold, conjugate gradients minimise
/// over the rest as if there were no bounds, a projected search brings the result back into the bounds, and so on. The
/// gradient is updated along with the point, so a step costs one product with H. MPRGP (Dostal 2009), which stops its
/// conjugate gradients at the first bound met, was tried on one problem (ibfest-70x30, smooth dwell): to an objective
/// that this reached in 423 products it needed 1421, and with the projected-CG expansion more than 2421. Memory: 5
/// vectors and a byte a variable.
class BoundedCg final : public BoxMinimiser {
 public:
  /// The bounds must outlive this. upper may be empty.
  BoundedCg(const Vector& lower, const Vector& upper);

  /// Improves the point until |projected gradient| <= tolerance, no step descends any more (rounding), or the monitor
  /// says stop. It is asked after every product; while conjugate gradients run it gets the point at which they started.
  /// Never worsens it. No allocation.
  void minimise(QuadraticForm& form, double tolerance, QuadraticPoint& point, const Monitor& go_on) override;

 private:
  /// x + step * direction, with the product of the direction.
  struct Segment {
    const Vector& direction;
    const Vector& product;
    double slope, curvature;
    double best_step() const;  // in [0, 1]
  };

  double upper_at(Index j) const;
  void clip(Vector& x) const;
  bool multiply(const Vector& d, Vector& hd);
  void move(const Segment& s, double step);
  bool spectral_step();
  void minimise_on_face();
  bool search();
  void take_whole_step();
  void take_first_stretch();
  double first_bound() const;
  Index mark_free();
  void mask(Vector& v) const;

  const Vector &lower_, &upper_;
  Vector direction_, product_, step_, step_product_, descent_;
  std::vector<char> free_;
  long products_ = 0;
  double spectral_length_ = 0.0;  // kept from one call to the next; 0 = not known

  // Of the running call.
  QuadraticForm* form_ = nullptr;
  QuadraticPoint* point_ = nullptr;
  const Monitor* go_on_ = nullptr;
  bool running_ = false;
  double tolerance_ = 0.0;
  double cg_share_ = 0.0;
  long cg_limit_ = 0;
  bool face_unchanged_ = false;
};

}  // namespace dwell
