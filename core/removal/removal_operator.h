#pragma once

#include <Eigen/Core>

#include <string>

#include "core/base/grid.h"

// Eigen's products are inline functions, of which the linker keeps one: compiled with threads here and without there,
// they are silently wrong (cmake/DwellTargets.cmake). Whoever links dwell without its CMake targets learns it here.
#ifdef EIGEN_HAS_OPENMP
#error "dwell needs EIGEN_DONT_PARALLELIZE defined in everything that includes Eigen and is linked with it"
#endif

namespace dwell {

using Vector = Eigen::VectorXd;

/// The removal operator A, m pixels x n dwell points [nm/s]: (A t)(x_i) = sum_j b_j(x_i) t_j with b_j the removal
/// rate averaged over the stroke of dwell point j. One contract for every implementation, checked here once:
/// outputs are overwritten, never accumulated into; inputs and outputs do not alias. Convolution is linear: nothing
/// wraps around an edge. The same input and number of threads give the same bytes.
/// Not thread-safe: an operator owns its workspace, so one caller at a time.
class RemovalOperator {
 public:
  virtual ~RemovalOperator() = default;

  Index rows() const { return rows_; }  // m, valid pixels
  Index cols() const { return cols_; }  // n, dwell points

  /// removal [nm] = A t [s]. Throws std::invalid_argument on a wrong size.
  void apply(const Vector& t, Vector& removal);
  /// t [nm^2/s] = A' residual [nm]. Throws std::invalid_argument on a wrong size.
  void apply_adjoint(const Vector& residual, Vector& t);

  /// How often apply and apply_adjoint have been called since construction.
  long applications() const { return applications_; }

  virtual std::string name() const = 0;

 protected:
  RemovalOperator(Index rows, Index cols) : rows_(rows), cols_(cols) {}

 private:
  virtual void do_apply(const Vector& t, Vector& removal) = 0;
  virtual void do_apply_adjoint(const Vector& residual, Vector& t) = 0;

  Index rows_ = 0;
  Index cols_ = 0;
  long applications_ = 0;
};

}  // namespace dwell
