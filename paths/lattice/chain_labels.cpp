#include "paths/lattice/chain_labels.h"

#include <utility>

#include "core/base/poll.h"

namespace dwell {
namespace {

using Cell = CellLinks::Cell;

/// Walks along a chain from one of its cells: over one link until it returns or reaches an end; after an end, over the
/// other link to the other end.
class Walker {
 public:
  Walker(const CellLinks& links, Cell begin) : links_(links), begin_(begin), at_(begin) {
    way_ = links.link_direction(begin);
    second_ = links.link_direction(begin, way_ < 0 ? -1 : way_);
  }

  Cell at() const { return at_; }
  bool done() const { return done_; }
  bool open() const { return open_; }  // once done
  std::int32_t cells() const { return cells_; }

  void step() {
    if (way_ < 0) {
      open_ = true;
      if (second_ < 0) {
        done_ = true;
        return;
      }
      at_ = begin_;
      way_ = std::exchange(second_, -1);
    }
    at_ = links_.neighbour(at_, way_);
    if (at_ == begin_) {
      done_ = true;
      return;
    }
    ++cells_;
    way_ = links_.link_direction(at_, way_ ^ 2);
  }

 private:
  const CellLinks& links_;
  Cell begin_, at_;
  int way_, second_;  // next link to take; link of the beginning not yet taken, -1 = none
  std::int32_t cells_ = 1;
  bool done_ = false;
  bool open_ = false;
};

}  // namespace

ChainLabels::ChainLabels(const CellLinks& links, const Progress& progress)
    : links_(links), label_(static_cast<std::size_t>(links.size()), -1) {
  Poll poll(progress);
  for (Cell c = links.first(); c < links.end(); ++c) {
    poll.step();
    if (!links.kept(c) || label_[static_cast<std::size_t>(c)] >= 0) continue;
    const std::int32_t name = names();
    chains_.push_back({name, 0, false});
    name_part(c, name);
  }
}

void ChainLabels::name_part(Cell begin, std::int32_t name) {
  Walker walker(links_, begin);
  while (!walker.done()) {
    label_[static_cast<std::size_t>(walker.at())] = name;
    walker.step();
  }
  Chain& chain = chains_[static_cast<std::size_t>(name)];
  chain.cells = walker.cells();
  chain.open = walker.open();
}

std::int32_t ChainLabels::root(std::int32_t name) const {
  auto parent = [&](std::int32_t i) -> std::int32_t& { return chains_[static_cast<std::size_t>(i)].parent; };
  while (parent(name) != name) {
    parent(name) = parent(parent(name));
    name = parent(name);
  }
  return name;
}

bool ChainLabels::join(Cell a, Cell b) {
  std::int32_t to = name(a), from = name(b);
  if (to == from) return false;
  Chain* into = &chains_[static_cast<std::size_t>(to)];
  Chain* gone = &chains_[static_cast<std::size_t>(from)];
  if (into->open && gone->open) return false;
  if (into->cells < gone->cells) {
    std::swap(into, gone);
    std::swap(to, from);
  }
  gone->parent = to;
  into->cells += gone->cells;
  into->open = into->open || gone->open;
  return true;
}

Cell ChainLabels::split(Cell square, std::int64_t& steps) {
  const Cell other = links_.flippable(square) == 1 ? square + links_.row_step() : square + 1;
  Walker one(links_, square), two(links_, other);
  while (!one.done() && !two.done()) {
    one.step();
    two.step();
    steps -= 2;
    if ((!one.done() && one.at() == other) || (!two.done() && two.at() == square)) return -1;
  }
  const Walker& part = one.done() ? one : two;
  const Cell begin = one.done() ? square : other;
  steps -= part.cells();
  Chain& rest = chain(begin);
  rest.cells -= part.cells();
  if (part.open()) rest.open = false;
  const std::int32_t fresh = names();
  chains_.push_back({fresh, 0, false});
  name_part(begin, fresh);
  return begin;
}

}  // namespace dwell
