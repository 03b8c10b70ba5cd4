#include "core/removal/removal_operator.h"

#include <fmt/format.h>

#include <stdexcept>

#include "core/base/counted.h"

namespace dwell {
namespace {

void check_size(const char* what, Index expected, Index actual) {
  if (expected != actual)
    throw std::invalid_argument(
        fmt::format("{} has {}; the operator needs {}", what, counted(actual, "value"), expected));
}

}  // namespace

void RemovalOperator::apply(const Vector& t, Vector& removal) {
  check_size("dwell", cols_, t.size());
  removal.resize(rows_);
  ++applications_;
  do_apply(t, removal);
}

void RemovalOperator::apply_adjoint(const Vector& residual, Vector& t) {
  check_size("residual", rows_, residual.size());
  t.resize(cols_);
  ++applications_;
  do_apply_adjoint(residual, t);
}

}  // namespace dwell
