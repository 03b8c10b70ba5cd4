#pragma once

#include <cstddef>
#include <vector>

#include "paths/feed/kinematic_path.h"

namespace dwell {

/// The highest speeds at the nodes of a path (node_speeds_squared) while feeds change in places: the passes run again
/// only through blocks of moves that a change reaches. Node speeds are those of node_speeds_squared to the last digit.
class LookAhead {
 public:
  /// Every move begins with its own highest speed as feed. `begins`: of every block the first move, ascending, the
  /// first 0. `path` must outlive this.
  LookAhead(const KinematicPath& path, std::vector<std::size_t> begins);

  std::size_t blocks() const { return begins_.size(); }
  std::size_t begin_of(std::size_t block) const { return begins_[block]; }
  std::size_t end_of(std::size_t block) const { return block + 1 < begins_.size() ? begins_[block + 1] : feed_.size(); }

  double feed(std::size_t move) const { return feed_[move]; }
  const std::vector<double>& feeds() const { return feed_; }
  /// A change of the feed of a move in this block [mm/s].
  void set_feed(std::size_t block, std::size_t move, double feed);
  /// Squared speeds at the nodes as of the last update [mm^2/s^2].
  const std::vector<double>& squared() const { return u_; }

  /// Brings the speeds up to date with the feeds. Cost: O(blocks), and the moves of those that change.
  void update();
  /// Whether the last update went through a block, and whether it changed the speed at a node.
  bool touched(std::size_t block) const { return touched_[block] != 0; }
  bool changed(std::size_t node) const { return changed_[node] != 0; }

 private:
  double cap(std::size_t node) const;
  bool run_forward(std::size_t block);
  bool run_back(std::size_t block);

  const KinematicPath& path_;
  std::vector<std::size_t> begins_;
  std::vector<double> feed_;     // of every move
  std::vector<double> forward_;  // squared speeds at every node after the pass forward
  std::vector<double> u_;        // and after both
  std::vector<char> dirty_;      // blocks in which a feed has changed since the last update
  std::vector<char> touched_, changed_;
};

}  // namespace dwell
