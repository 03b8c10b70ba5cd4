#include "solvers/resolution_matched_hessian.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/bspline.h"

namespace dwell {
namespace {

std::vector<Index> all_nodes(const Grid& grid) {
  std::vector<Index> nodes(static_cast<std::size_t>(grid.size()));
  std::iota(nodes.begin(), nodes.end(), Index{0});
  return nodes;
}

}  // namespace

MatchedPixels::MatchedPixels(const DwellProblem& p, CoarseFactor factor) : gram_(p.geometry->map, factor) {
  const std::vector<Index>& pixels = p.geometry->pixels;
  gram_.add(pixels, p.weights.cwiseAbs2(), SplineGram::Take::Value, 1.0);
  form_.resize(lattice().size(), p.form.cols());
  Vector column, spread;
  for (Index k = 0; k < p.form.cols(); ++k) {
    column = p.form.col(k);
    if (p.weights.size() != 0) column.array() *= p.weights.array();
    gram_.spread(pixels, column, spread);
    form_.col(k) = spread;
  }
}

void MatchedPixels::apply(const Vector& d, Vector& v) const {
  gram_.apply(d, v);
  if (form_.cols() == 0) return;
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1> c = form_.transpose() * d;
  v.noalias() -= form_ * c;
}

ResolutionMatchedHessian::ResolutionMatchedHessian(const DwellProblem& problem, CoarseFactor factor)
    : problem_(problem), pixels_(problem, factor) {
  const RemovalGeometry& g = *problem.geometry;
  const RemovalKernel kernel = matched_kernel(g.kernel, factor);
  removal_.emplace(pixels_.lattice(), all_nodes(pixels_.lattice()), kernel, g.strokes, g.threads);
  relative_cost_ = transform_cost(pixels_.lattice(), kernel) / transform_cost(g.map, g.kernel);
}

void ResolutionMatchedHessian::product(const Vector& d, Vector& hd) {
  removal_->apply(d, surface_);
  pixels_.apply(surface_, weighed_);
  removal_->apply_adjoint(weighed_, hd);
  if (problem_.alpha > 0.0 && !problem_.smoothness.empty()) problem_.smoothness.add_normal(problem_.alpha, d, hd);
  if (problem_.beta > 0.0) hd += problem_.beta * d;
}

void ResolutionMatchedHessian::precondition(const std::vector<char>& free, const Vector& r, Vector& out) {
  if (problem_.smoothness.empty() || !(problem_.alpha > 0.0)) {
    out = r;
    return;
  }
  // The removal adds to the diagonal orders of magnitude more for smooth dwell than for rough, so no value is right. Of
  // 1e-4, 0.01, 0.1 and 1, tried on ibfest-70x30, 0.01 and 0.1 were best, by less than 0.5 % of the objective.
  constexpr double kRidge = 0.05;
  problem_.smoothness.solve_normal(problem_.alpha, kRidge * problem_.alpha + problem_.beta, free, r, out, scratch_);
}

SmoothDwell::SmoothDwell(const RemovalGeometry& g, CoarseFactor factor) : strokes_(&g.strokes) {
  // Cover starts a whole number of coarse steps from the map's origin, so that both lattices coincide.
  Index first_row = 0, first_col = 0, last_row = 0, last_col = 0;
  for (const Stroke& s : *strokes_) {
    const auto row = static_cast<Index>(std::floor((s.via.y - g.map.origin.y) / g.map.pitch_y));
    const auto col = static_cast<Index>(std::floor((s.via.x - g.map.origin.x) / g.map.pitch_x));
    first_row = std::min(first_row, row);
    first_col = std::min(first_col, col);
    last_row = std::max(last_row, row + 1);
    last_col = std::max(last_col, col + 1);
  }
  const auto down = [](Index v, Index step) { return -((-v + step - 1) / step) * step; };
  first_row = down(first_row, factor.y);
  first_col = down(first_col, factor.x);
  cover_ = g.map;
  cover_.origin = g.map.centre(first_row, first_col);
  cover_.rows = last_row - first_row + 1;
  cover_.cols = last_col - first_col + 1;
  lattice_ = SplineGram(cover_, factor).lattice();
  nodes_ = lattice_.size();
  first_row_ = first_row / factor.y - 1;
  first_col_ = first_col / factor.x - 1;
}

SmoothDwell::Place SmoothDwell::place(Point p) const {
  const double u = (p.x - lattice_.origin.x) / lattice_.pitch_x, v = (p.y - lattice_.origin.y) / lattice_.pitch_y;
  // Rounding must not carry a point on the edge off the lattice.
  const double fu = std::clamp(std::floor(u), 1.0, static_cast<double>(lattice_.cols - 3));
  const double fv = std::clamp(std::floor(v), 1.0, static_cast<double>(lattice_.rows - 3));
  return {(static_cast<Index>(fv) - 1) * lattice_.cols + static_cast<Index>(fu) - 1,
          bspline_weights(std::clamp(u - fu, 0.0, 1.0)), bspline_weights(std::clamp(v - fv, 0.0, 1.0))};
}

void SmoothDwell::prolong(const Vector& s, Vector& t) const {
  t.resize(static_cast<Index>(strokes_->size()));
  for (Index j = 0; j < t.size(); ++j) {
    const Place at = place((*strokes_)[static_cast<std::size_t>(j)].via);
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double* from = s.data() + at.first + static_cast<Index>(i) * lattice_.cols;
      sum += at.y[i] * (at.x[0] * from[0] + at.x[1] * from[1] + at.x[2] * from[2] + at.x[3] * from[3]);
    }
    t[j] = sum;
  }
}

void SmoothDwell::restrict_to(const Vector& g, Vector& coarse) const {
  coarse.setZero(nodes_);
  for (Index j = 0; j < g.size(); ++j) {
    const Place at = place((*strokes_)[static_cast<std::size_t>(j)].via);
    for (std::size_t i = 0; i < 4; ++i) {
      double* to = coarse.data() + at.first + static_cast<Index>(i) * lattice_.cols;
      for (std::size_t k = 0; k < 4; ++k) to[k] += at.y[i] * at.x[k] * g[j];
    }
  }
}

// Two-scale relation of the cubic B-spline: B3(u) = sum_k c_k B3(2u - k), c = 1/8, 4/8, 6/8, 4/8, 1/8.
void SmoothDwell::refine(const SmoothDwell& coarse, const Vector& coarse_s, Vector& s) const {
  constexpr std::array<double, 5> c = {0.125, 0.5, 0.75, 0.5, 0.125};
  s.setZero(nodes_);
  for (Index i = 0; i < coarse.nodes_; ++i) {
    const Index row = 2 * (coarse.first_row_ + i / coarse.lattice_.cols) - first_row_;
    const Index col = 2 * (coarse.first_col_ + i % coarse.lattice_.cols) - first_col_;
    for (Index dy = -2; dy <= 2; ++dy) {
      for (Index dx = -2; dx <= 2; ++dx) {
        const Index r = row + dy, k = col + dx;
        if (r < 0 || k < 0 || r >= lattice_.rows || k >= lattice_.cols) continue;
        s[r * lattice_.cols + k] +=
            c[static_cast<std::size_t>(dy + 2)] * c[static_cast<std::size_t>(dx + 2)] * coarse_s[i];
      }
    }
  }
}

Vector SmoothDwell::largest(const DwellProblem& problem) const {
  if (problem.upper.size() == 0) return {};
  Vector result = Vector::Constant(nodes_, std::numeric_limits<double>::infinity());
  for (Index j = 0; j < problem.points(); ++j) {
    const Place at = place((*strokes_)[static_cast<std::size_t>(j)].via);
    for (Index i = 0; i < 4; ++i) {
      for (Index k = 0; k < 4; ++k) {
        double& largest = result[at.first + i * lattice_.cols + k];
        largest = std::min(largest, problem.upper[j] - problem.lower[j]);
      }
    }
  }
  return result;
}

namespace {

/// Values by pixel, in ascending order of pixel.
struct PixelSums {
  std::vector<Index> pixels;
  Vector sums;

  /// entries[j] = (pixel, value), any order.
  explicit PixelSums(std::vector<std::pair<Index, double>> entries) {
    std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<double> values;
    for (const auto& [pixel, value] : entries) {
      if (!pixels.empty() && pixels.back() == pixel) {
        values.back() += value;
      } else {
        pixels.push_back(pixel);
        values.push_back(value);
      }
    }
    sums = Eigen::Map<Vector>(values.data(), static_cast<Index>(values.size()));
  }
};

}  // namespace

SmoothDwellHessian::SmoothDwellHessian(const DwellProblem& problem, const SmoothDwell& dwell, CoarseFactor factor)
    : pixels_(problem, factor), points_(dwell.cover(), factor), penalty_(dwell.cover(), factor) {
  const RemovalGeometry& g = *problem.geometry;
  const Grid& cover = dwell.cover();
  std::vector<std::pair<Index, double>> once, along_x, along_y;
  for (const Stroke& s : g.strokes) {
    const auto row = static_cast<Index>(std::llround((s.via.y - cover.origin.y) / cover.pitch_y));
    const auto col = static_cast<Index>(std::llround((s.via.x - cover.origin.x) / cover.pitch_x));
    once.emplace_back(cover.index(std::clamp<Index>(row, 0, cover.rows - 1), std::clamp<Index>(col, 0, cover.cols - 1)),
                      1.0);
  }
  for (Index j = 1; problem.alpha > 0.0 && j < problem.smoothness.size(); ++j) {
    if (!problem.smoothness.linked(j)) continue;
    const auto k = static_cast<std::size_t>(j);
    const Point step = g.strokes[k].via - g.strokes[k - 1].via;
    const double scale = problem.smoothness.scale(j), dx = scale * step.x / cover.pitch_x,
                 dy = scale * step.y / cover.pitch_y;
    if (dx != 0.0) along_x.emplace_back(once[k].first, dx * dx);
    if (dy != 0.0) along_y.emplace_back(once[k].first, dy * dy);
  }
  const PixelSums counts(std::move(once)), x(std::move(along_x)), y(std::move(along_y));
  points_.add(counts.pixels, counts.sums, SplineGram::Take::Value, 1.0);
  penalty_.add(x.pixels, x.sums, SplineGram::Take::SlopeX, problem.alpha);
  penalty_.add(y.pixels, y.sums, SplineGram::Take::SlopeY, problem.alpha);
  penalty_.add(counts.pixels, counts.sums, SplineGram::Take::Value, problem.beta);

  const RemovalKernel kernel = matched_kernel(g.kernel, factor);
  const Grid &map_lattice = pixels_.lattice(), &lattice = points_.lattice();
  convolution_.emplace(map_lattice, all_nodes(map_lattice), kernel.surface.coefficients(), kernel.half_rows,
                       kernel.half_cols, g.threads);
  const auto row0 = static_cast<Index>(std::llround((lattice.origin.y - map_lattice.origin.y) / lattice.pitch_y));
  const auto col0 = static_cast<Index>(std::llround((lattice.origin.x - map_lattice.origin.x) / lattice.pitch_x));
  for (Index i = 0; i < lattice.size(); ++i)
    field_node_.push_back(convolution_->node(row0 + i / lattice.cols, col0 + i % lattice.cols));
  relative_cost_ = transform_cost(map_lattice, kernel) / transform_cost(g.map, g.kernel);
  surface_.resize(map_lattice.size());
  correlated_.resize(lattice.size());
}

void SmoothDwellHessian::product(const Vector& d, Vector& hd) {
  points_.apply(d, density_);
  convolution_->clear_field();
  const auto field = convolution_->field();
  for (std::size_t i = 0; i < field_node_.size(); ++i) {
    if (field_node_[i] >= 0) field[static_cast<std::size_t>(field_node_[i])] = density_[static_cast<Index>(i)];
  }
  convolution_->convolve(surface_.data());
  pixels_.apply(surface_, weighed_);
  convolution_->correlate(weighed_.data());
  for (std::size_t i = 0; i < field_node_.size(); ++i) {
    correlated_[static_cast<Index>(i)] = field_node_[i] >= 0 ? field[static_cast<std::size_t>(field_node_[i])] : 0.0;
  }
  points_.apply(correlated_, hd);
  penalty_.apply(d, part_);
  hd += part_;
}

}  // namespace dwell
