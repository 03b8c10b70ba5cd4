#pragma once

#include <vector>

#include "core/motion/tool_path.h"
#include "core/removal/removal_operator.h"

namespace dwell {

/// The difference operator D of the dwell problem: how much the dwell per length changes between neighbours on the
/// path. (D t)_k = s_(j+1) t_(j+1) - s_j t_j for every pair of dwell points j, j+1 joined without a lift, where s_j =
/// mean length / length_j (1 for halts), so that D t is in seconds and smooth D t means smooth feed. Pairs across a
/// lift are not linked. s_j is kept below 100, so that a stroke far shorter than the others does not decide the feed.
class PathSmoothness {
 public:
  PathSmoothness() = default;
  /// joined[j]: dwell point j continues from j - 1 without a lift. lengths [mm], one a stroke. Both of size n.
  /// Throws std::invalid_argument if the sizes differ or a length is negative or not finite. What the members compute
  /// has the same bytes for any number of threads.
  PathSmoothness(const std::vector<double>& lengths, const std::vector<char>& joined, int threads = 1);

  bool empty() const { return scale_.size() == 0; }
  Index size() const { return scale_.size(); }  // n

  /// Dwell point j is linked to j - 1.
  bool linked(Index j) const { return j > 0 && joined_[static_cast<std::size_t>(j)] != 0; }
  double scale(Index j) const { return scale_[j]; }  // s_j

  /// How many pairs of neighbours are linked: the size of D t.
  Index links() const;
  /// |D t|^2 [s^2].
  double squared_norm(const Eigen::Ref<const Vector>& t) const;
  /// |D (t - least)|^2 [s^2].
  double squared_norm(const Eigen::Ref<const Vector>& t, const Eigen::Ref<const Vector>& least) const;
  /// out += weight * D' D t.
  void add_normal(double weight, const Eigen::Ref<const Vector>& t, Eigen::Ref<Vector> out) const;
  /// out += weight * D' D (t - least).
  void add_normal(double weight, const Eigen::Ref<const Vector>& t, const Eigen::Ref<const Vector>& least,
                  Eigen::Ref<Vector> out) const;
  /// Dense D' D, n x n, for oracles and small dense solvers.
  Eigen::MatrixXd dense_normal() const;

 private:
  /// (D t) of the link of point j to j - 1; 0 without one, or beyond the last point. dwell(j) is t_j.
  template <class Dwell>
  double step(Index j, const Dwell& dwell) const {
    if (j >= size() || !linked(j)) return 0.0;
    return scale_[j] * dwell(j) - scale_[j - 1] * dwell(j - 1);
  }
  template <class Dwell>
  double sum_of_squares(const Dwell& dwell) const;
  template <class Dwell>
  void add_normal_of(double weight, const Dwell& dwell, double* out) const;

  Vector scale_;
  std::vector<char> joined_;
  int threads_ = 1;
};

/// The smoothness of a path's strokes: tool running through, or halting (all scales one).
PathSmoothness path_smoothness(const ToolPath& path, const std::vector<Stroke>& strokes, int threads = 1);

}  // namespace dwell
