#include "solvers/problem/expected_removal.h"

#include <fmt/format.h>

#include <stdexcept>

namespace dwell {
namespace {

const RemovalOperator& first_of(const std::vector<ExpectedRemoval::Block>& blocks) {
  if (blocks.empty()) throw std::invalid_argument("expected removal: at least one block is required");
  if (blocks.front().factor != 1.0) throw std::invalid_argument("expected removal: the first block has factor 1");
  for (const auto& block : blocks) {
    if (block.removal->rows() != blocks.front().removal->rows() ||
        block.removal->cols() != blocks.front().removal->cols())
      throw std::invalid_argument("expected removal: blocks of different sizes");
  }
  return *blocks.front().removal;
}

}  // namespace

ExpectedRemoval::ExpectedRemoval(std::vector<Block> blocks)
    : RemovalOperator(first_of(blocks).rows() * static_cast<Index>(blocks.size()), first_of(blocks).cols()),
      blocks_(std::move(blocks)) {}

std::string ExpectedRemoval::name() const {
  return fmt::format("{}, {} rows of its changes", blocks_.front().removal->name(), blocks_.size() - 1);
}

void ExpectedRemoval::do_apply(const Vector& t, Vector& rows) {
  const Index m = blocks_.front().removal->rows();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const Block& block = blocks_[k];
    auto to = rows.segment(static_cast<Index>(k) * m, m);
    if (k > 0 && block.removal == blocks_.front().removal) {
      to = block.factor * rows.head(m);
    } else {
      block.removal->apply(t, of_block_);
      to = block.factor * of_block_;
    }
  }
}

void ExpectedRemoval::do_apply_adjoint(const Vector& rows, Vector& t) {
  const Index m = blocks_.front().removal->rows();
  of_block_ = rows.head(m);
  for (std::size_t k = 1; k < blocks_.size(); ++k) {
    if (blocks_[k].removal == blocks_.front().removal)
      of_block_ += blocks_[k].factor * rows.segment(static_cast<Index>(k) * m, m);
  }
  blocks_.front().removal->apply_adjoint(of_block_, t);
  for (std::size_t k = 1; k < blocks_.size(); ++k) {
    const Block& block = blocks_[k];
    if (block.removal == blocks_.front().removal) continue;
    of_block_ = block.factor * rows.segment(static_cast<Index>(k) * m, m);
    block.removal->apply_adjoint(of_block_, dwell_);
    t += dwell_;
  }
}

}  // namespace dwell
