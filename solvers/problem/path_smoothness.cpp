#include "solvers/problem/path_smoothness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solvers/problem/blocks.h"

namespace dwell {

PathSmoothness::PathSmoothness(const std::vector<double>& lengths, const std::vector<char>& joined, int threads)
    : scale_(Vector::Ones(static_cast<Index>(lengths.size()))), joined_(joined), threads_(threads) {
  if (joined.size() != lengths.size())
    throw std::invalid_argument("path smoothness: lengths and joined differ in size");
  double sum = 0.0;
  Index moving = 0;
  for (double l : lengths) {
    if (!(std::isfinite(l) && l >= 0.0))
      throw std::invalid_argument(fmt::format("path smoothness: length {} mm; required finite and >= 0", l));
    if (l > 0.0) {
      sum += l;
      ++moving;
    }
  }
  constexpr double kLargest = 100.0;
  for (std::size_t j = 0; j < lengths.size(); ++j) {
    if (lengths[j] > 0.0) {
      scale_[static_cast<Index>(j)] = std::min(sum / static_cast<double>(moving) / lengths[j], kLargest);
    }
  }
}

Index PathSmoothness::links() const {
  Index links = 0;
  for (Index j = 1; j < scale_.size(); ++j) links += linked(j);
  return links;
}

template <class Dwell>
double PathSmoothness::sum_of_squares(const Dwell& dwell) const {
  return sum_over(size(), threads_, [&](Index begin, Index length) {
    double sum = 0.0;
    for (Index j = begin; j < begin + length; ++j) {
      const double d = step(j, dwell);
      sum += d * d;
    }
    return sum;
  });
}

double PathSmoothness::squared_norm(const Eigen::Ref<const Vector>& t) const {
  return sum_of_squares([t = t.data()](Index j) { return t[j]; });
}

double PathSmoothness::squared_norm(const Eigen::Ref<const Vector>& t, const Eigen::Ref<const Vector>& least) const {
  return sum_of_squares([t = t.data(), least = least.data()](Index j) { return t[j] - least[j]; });
}

template <class Dwell>
void PathSmoothness::add_normal_of(double weight, const Dwell& dwell, double* out) const {
  for_blocks(size(), threads_, [&](Index, Index begin, Index length) {
    double before = weight * step(begin, dwell);
    for (Index j = begin; j < begin + length; ++j) {
      const double after = weight * step(j + 1, dwell);
      out[j] += scale_[j] * before;
      out[j] -= scale_[j] * after;
      before = after;
    }
  });
}

void PathSmoothness::add_normal(double weight, const Eigen::Ref<const Vector>& t, Eigen::Ref<Vector> out) const {
  add_normal_of(
      weight, [t = t.data()](Index j) { return t[j]; }, out.data());
}

void PathSmoothness::add_normal(double weight, const Eigen::Ref<const Vector>& t, const Eigen::Ref<const Vector>& least,
                                Eigen::Ref<Vector> out) const {
  add_normal_of(
      weight, [t = t.data(), least = least.data()](Index j) { return t[j] - least[j]; }, out.data());
}

Eigen::MatrixXd PathSmoothness::dense_normal() const {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(scale_.size(), scale_.size());
  for (Index j = 1; j < scale_.size(); ++j) {
    if (!joined_[static_cast<std::size_t>(j)]) continue;
    normal(j, j) += scale_[j] * scale_[j];
    normal(j - 1, j - 1) += scale_[j - 1] * scale_[j - 1];
    normal(j, j - 1) -= scale_[j] * scale_[j - 1];
    normal(j - 1, j) -= scale_[j] * scale_[j - 1];
  }
  return normal;
}

PathSmoothness path_smoothness(const ToolPath& path, const std::vector<Stroke>& strokes, int threads) {
  std::vector<double> lengths;
  std::vector<char> joined;
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    lengths.push_back(strokes[j].length());
    joined.push_back(j > 0 && !path.lifted[j]);
  }
  return {lengths, joined, threads};
}

}  // namespace dwell
