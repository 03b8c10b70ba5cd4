#include "paths/feed/look_ahead.h"

#include <algorithm>
#include <utility>

namespace dwell {
namespace {

double squared_feed(const KinematicPath& path, const std::vector<double>& feed, std::size_t move) {
  const double highest = std::min(feed[move], path.moves[move].max_speed);
  return highest * highest;
}

}  // namespace

LookAhead::LookAhead(const KinematicPath& path, std::vector<std::size_t> begins)
    : path_(path),
      begins_(std::move(begins)),
      forward_(path.size() + 1, -1.0),
      u_(path.size() + 1, -1.0),
      dirty_(begins_.size(), 1),
      touched_(begins_.size(), 0),
      changed_(path.size() + 1, 0) {
  feed_.reserve(path.size());
  for (const KinematicMove& move : path.moves) feed_.push_back(move.max_speed);
}

void LookAhead::set_feed(std::size_t block, std::size_t move, double feed) {
  feed_[move] = feed;
  dirty_[block] = 1;
  if (block > 0 && move == begins_[block]) dirty_[block - 1] = 1;  // the node between both has another cap
}

double LookAhead::cap(std::size_t node) const {
  double most = path_.corner[node];
  if (node > 0) most = std::min(most, squared_feed(path_, feed_, node - 1));
  if (node < path_.size()) most = std::min(most, squared_feed(path_, feed_, node));
  return most;
}

/// Returns whether the speed at the block's end is another.
bool LookAhead::run_forward(std::size_t block) {
  const std::size_t begin = begin_of(block), end = end_of(block);
  if (begin == 0) forward_[0] = cap(0);
  const double before = forward_[end];
  double own = squared_feed(path_, feed_, begin);
  for (std::size_t i = begin; i < end; ++i) {
    double most = std::min(path_.corner[i + 1], own);
    if (i + 1 < path_.size()) most = std::min(most, own = squared_feed(path_, feed_, i + 1));
    forward_[i + 1] = most > forward_[i] || !path_.arcs.empty()
                          ? std::min(most, reached_forward(path_, i, feed_[i], forward_[i]))
                          : most;
  }
  return forward_[end] != before;
}

/// Returns whether the speed at the block's beginning is another.
bool LookAhead::run_back(std::size_t block) {
  const std::size_t begin = begin_of(block), end = end_of(block);
  if (end == path_.size()) {
    changed_[end] = static_cast<char>(u_[end] != forward_[end]);
    u_[end] = forward_[end];
  }
  for (std::size_t i = end; i-- > begin;) {
    const double most = forward_[i];
    const double now =
        most > u_[i + 1] || !path_.arcs.empty() ? std::min(most, reached_back(path_, i, feed_[i], u_[i + 1])) : most;
    changed_[i] = static_cast<char>(now != u_[i]);
    u_[i] = now;
  }
  return changed_[begin] != 0;
}

void LookAhead::update() {
  bool reaches = false;
  for (std::size_t b = 0; b < blocks(); ++b) {
    touched_[b] = static_cast<char>(dirty_[b] != 0 || reaches);
    dirty_[b] = 0;
    reaches = touched_[b] != 0 && run_forward(b);
  }
  reaches = false;
  for (std::size_t b = blocks(); b-- > 0;) {
    touched_[b] = static_cast<char>(touched_[b] != 0 || reaches);
    reaches = touched_[b] != 0 && run_back(b);
  }
}

}  // namespace dwell
