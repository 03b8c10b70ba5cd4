#pragma once

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <vector>

#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "tests/oracle/dense_algebra.h"

/// The slow oracle of every removal operator: the definition written as a double loop. Shares no code with the
/// library: the spline is found by dense linear algebra, evaluated from B3's own formula, and averaged along the
/// stroke by Simpson's rule on a fine uniform partition.
namespace dwell::oracle {

inline double b3(double x) {
  const double a = std::abs(x);
  if (a >= 2.0) return 0.0;
  if (a >= 1.0) return (2.0 - a) * (2.0 - a) * (2.0 - a) / 6.0;
  return 2.0 / 3.0 - a * a + 0.5 * a * a * a;
}

/// Spline through samples (odd x odd, axis in the middle), zero on `margin` further samples on every side.
class DirectKernel {
 public:
  DirectKernel(const Eigen::MatrixXd& samples, double hx, double hy, int margin = 4) : hx_(hx), hy_(hy) {
    Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(samples.rows() + 2 * margin, samples.cols() + 2 * margin);
    padded.block(margin, margin, samples.rows(), samples.cols()) = samples;
    c_ = solve_by_elimination(collocation(padded.rows()), padded);
    c_ = solve_by_elimination(collocation(padded.cols()), c_.transpose()).transpose().eval();
  }

  double rate(double dx, double dy) const {
    const double u = dx / hx_ + static_cast<double>(c_.cols() / 2), v = dy / hy_ + static_cast<double>(c_.rows() / 2);
    double sum = 0.0;
    for (Eigen::Index r = 0; r < c_.rows(); ++r) {
      if (std::abs(v - static_cast<double>(r)) >= 2.0) continue;
      for (Eigen::Index c = 0; c < c_.cols(); ++c) {
        if (std::abs(u - static_cast<double>(c)) >= 2.0) continue;
        sum += c_(r, c) * b3(v - static_cast<double>(r)) * b3(u - static_cast<double>(c));
      }
    }
    return sum;
  }

  /// Average of the rate at (x, y) while the tool runs along the stroke at constant speed.
  double average(double x, double y, const Stroke& s, int intervals = 1600) const {
    const double la = std::hypot(s.via.x - s.start.x, s.via.y - s.start.y);
    const double lb = std::hypot(s.finish.x - s.via.x, s.finish.y - s.via.y);
    if (la + lb == 0.0) return rate(x - s.via.x, y - s.via.y);
    const auto simpson = [&](double ax, double ay, double bx, double by) {
      double sum = 0.0;
      for (int k = 0; k <= intervals; ++k) {
        const double f = static_cast<double>(k) / intervals;
        const double w = (k == 0 || k == intervals) ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
        sum += w * rate(x - ax - f * (bx - ax), y - ay - f * (by - ay));
      }
      return sum / (3.0 * intervals);
    };
    return (la * simpson(s.start.x, s.start.y, s.via.x, s.via.y) +
            lb * simpson(s.via.x, s.via.y, s.finish.x, s.finish.y)) /
           (la + lb);
  }

 private:
  static Eigen::MatrixXd collocation(Eigen::Index n) {
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index k = 0; k < n; ++k) m(i, k) = b3(static_cast<double>(i - k));
    }
    return m;
  }

  double hx_, hy_;
  Eigen::MatrixXd c_;
};

/// The m x n matrix of the removal operator.
inline Eigen::MatrixXd direct_matrix(const Grid& map, const std::vector<Index>& pixels, const DirectKernel& kernel,
                                     const std::vector<Stroke>& strokes) {
  Eigen::MatrixXd a(static_cast<Eigen::Index>(pixels.size()), static_cast<Eigen::Index>(strokes.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double x = map.origin.x + map.pitch_x * static_cast<double>(pixels[i] % map.cols);
    const double y = map.origin.y + map.pitch_y * static_cast<double>(pixels[i] / map.cols);
    for (std::size_t j = 0; j < strokes.size(); ++j) {
      a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = kernel.average(x, y, strokes[j]);
    }
  }
  return a;
}

}  // namespace dwell::oracle
