#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/base/progress.h"
#include "paths/feed/banded_system.h"
#include "paths/feed/speed_nodes.h"

namespace dwell {

/// A stretch of nodes: first and last keep their speeds, those between are free unless the machine rests there. Its
/// strokes are whole.
struct SpeedWindow {
  std::size_t first, last;
};

/// Brings the times of a window's strokes as near to their dwell as the limits allow (the objective of schedule_linear)
/// by Gauss-Newton with logarithmic barriers, banded: fraction to the boundary 0.95, Armijo. One object serves many
/// windows one after the other, whose memory it uses again.
class SpeedMinimiser {
 public:
  /// `dwell` [s]: of all strokes, `mean` of theirs. Both outlive the object.
  SpeedMinimiser(const SpeedNodes& nodes, const Eigen::VectorXd& dwell, double mean)
      : nodes_(nodes), dwell_(dwell), mean_(mean) {}

  /// `u`: squared speeds of all nodes; those of the window must keep all limits, and those between are replaced. Throws
  /// Interrupted. Returns the steps. Cost: 20 to 60 steps of O(nodes of the window).
  int minimise(SpeedWindow window, std::vector<double>& u, const Progress& progress);

 private:
  struct Stroke {
    std::size_t first, last;  // its pieces, [first, last), numbered from the window's first
    double wanted;
  };

  void take_window(SpeedWindow window, const std::vector<double>& u);
  void move_inside();
  double error_of(const Stroke& stroke, const std::vector<double>& v) const;
  double value(const std::vector<double>& u);
  void set_up();
  void add_pair(std::size_t i, double gradient, double curvature);
  void add_stroke(const Stroke& stroke, const std::vector<double>& v);
  double longest(const std::vector<double>& step) const;
  bool take_step();

  const SpeedNodes& nodes_;
  const Eigen::VectorXd& dwell_;
  double mean_;
  // Of the window in hand:
  std::vector<SpeedPiece> pieces_;
  std::vector<Stroke> strokes_;
  std::vector<double> cap_, u_, gradient_, step_, next_, root_;
  std::vector<char> free_;
  BandedSystem system_{0};
  double barrier_ = 0.0;
};

}  // namespace dwell
