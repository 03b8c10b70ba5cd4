#pragma once

#include <string>
#include <vector>

#include "core/removal/removal_operator.h"

namespace dwell {

/// The rows of a removal and of its random changes, one block under the other: (A; f_1 A_1; f_2 A_2; ...). The square
/// of such a residual is the expected one: E|(A + sum_k e_k A_k) t - z|^2 = |A t - z|^2 + sum_k f_k^2 |A_k t|^2 for
/// independent e_k of mean zero and standard deviation f_k. A block of the first block's own operator (a change of the
/// rate) costs no application.
class ExpectedRemoval final : public RemovalOperator {
 public:
  struct Block {
    RemovalOperator* removal;  // not owned
    double factor;
  };

  /// Throws std::invalid_argument if there is no block, if the first has another factor than 1, or if sizes differ.
  explicit ExpectedRemoval(std::vector<Block> blocks);
  std::string name() const override;

 private:
  void do_apply(const Vector& t, Vector& rows) override;
  void do_apply_adjoint(const Vector& rows, Vector& t) override;

  std::vector<Block> blocks_;
  Vector of_block_, dwell_;
};

}  // namespace dwell
