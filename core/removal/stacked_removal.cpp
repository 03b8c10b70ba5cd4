#include "core/removal/stacked_removal.h"

#include <fmt/format.h>

#include <stdexcept>

#include "core/base/counted.h"

namespace dwell {
namespace {

using Parts = std::vector<std::unique_ptr<RemovalOperator>>;

Index common_rows(const Parts& parts) {
  if (parts.empty()) throw std::invalid_argument("stacked removal: at least one part is required");
  for (const auto& part : parts) {
    if (part->rows() != parts.front()->rows()) {
      throw std::invalid_argument(fmt::format("stacked removal: a part has {}; the first has {}",
                                              counted(part->rows(), "pixel"), parts.front()->rows()));
    }
  }
  return parts.front()->rows();
}

Index all_cols(const Parts& parts) {
  Index cols = 0;
  for (const auto& part : parts) cols += part->cols();
  return cols;
}

}  // namespace

StackedRemoval::StackedRemoval(Parts parts)
    : RemovalOperator(common_rows(parts), all_cols(parts)), parts_(std::move(parts)) {}

std::string StackedRemoval::name() const {
  std::string names;
  for (const auto& part : parts_) names += (names.empty() ? "" : " + ") + part->name();
  return names;
}

void StackedRemoval::do_apply(const Vector& t, Vector& removal) {
  removal.setZero();
  Index first = 0;
  for (const auto& part : parts_) {
    part_dwell_ = t.segment(first, part->cols());
    part->apply(part_dwell_, part_removal_);
    removal += part_removal_;
    first += part->cols();
  }
}

void StackedRemoval::do_apply_adjoint(const Vector& residual, Vector& t) {
  Index first = 0;
  for (const auto& part : parts_) {
    part->apply_adjoint(residual, part_dwell_);
    t.segment(first, part->cols()) = part_dwell_;
    first += part->cols();
  }
}

}  // namespace dwell
