#pragma once

#include <memory>
#include <vector>

#include "core/removal/removal_operator.h"

namespace dwell {

/// Several tools, or several passes of one, on the same pixels: A = [A_1 A_2 ...]. The dwell vectors of the parts stand
/// one after the other; their removals add up. Cost of a call: those of the parts.
class StackedRemoval final : public RemovalOperator {
 public:
  /// Throws std::invalid_argument if there is no part, or if their numbers of pixels differ.
  explicit StackedRemoval(std::vector<std::unique_ptr<RemovalOperator>> parts);

  std::string name() const override;

 private:
  void do_apply(const Vector& t, Vector& removal) override;
  void do_apply_adjoint(const Vector& residual, Vector& t) override;

  std::vector<std::unique_ptr<RemovalOperator>> parts_;
  Vector part_dwell_, part_removal_;
};

}  // namespace dwell
