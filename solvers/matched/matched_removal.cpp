#include "solvers/matched/matched_removal.h"

#include <cmath>
#include <numeric>

namespace dwell {
namespace {

std::vector<Index> all_nodes(const Grid& grid) {
  std::vector<Index> nodes(static_cast<std::size_t>(grid.size()));
  std::iota(nodes.begin(), nodes.end(), Index{0});
  return nodes;
}

}  // namespace

MatchedRemoval::MatchedRemoval(const DwellProblem& problem, const Grid& dwell, CoarseFactor factor)
    : problem_(problem), pixels_(problem.geometry->map, factor, problem.geometry->threads) {
  const RemovalGeometry& g = *problem.geometry;
  pixels_.add(g.pixels, problem.weights.cwiseAbs2(), SplineGram::Take::Value, 1.0);
  const Grid& lattice = pixels_.lattice();
  form_.resize(lattice.size(), problem.form.cols());
  Vector column, spread;
  for (Index k = 0; k < problem.form.cols(); ++k) {
    column = problem.form.col(k);
    if (problem.weights.size() != 0) column.array() *= problem.weights.array();
    pixels_.spread(g.pixels, column, spread);
    form_.col(k) = spread;
  }
  const RemovalKernel kernel = matched_kernel(g.kernel, factor);
  // A coarse transform is too short to share between threads.
  convolution_.emplace(lattice, all_nodes(lattice), kernel.surface.coefficients(), kernel.half_rows, kernel.half_cols,
                       1);
  const auto row0 = static_cast<Index>(std::llround((dwell.origin.y - lattice.origin.y) / lattice.pitch_y));
  const auto col0 = static_cast<Index>(std::llround((dwell.origin.x - lattice.origin.x) / lattice.pitch_x));
  field_node_.reserve(static_cast<std::size_t>(dwell.size()));
  for (Index i = 0; i < dwell.size(); ++i)
    field_node_.push_back(convolution_->node(row0 + i / dwell.cols, col0 + i % dwell.cols));
  surface_.resize(lattice.size());
  relative_cost_ = transform_cost(lattice, kernel) / transform_cost(g.map, g.kernel);
}

void MatchedRemoval::normal(const Vector& c, Vector& out) {
  convolution_->clear_field();
  const auto field = convolution_->field();
  for (std::size_t i = 0; i < field_node_.size(); ++i) {
    if (field_node_[i] >= 0) field[static_cast<std::size_t>(field_node_[i])] = c[static_cast<Index>(i)];
  }
  convolution_->convolve(surface_.data());
  pixels_.apply(surface_, weighed_);
  if (form_.cols() != 0) {
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxFormTerms, 1> q = form_.transpose() * surface_;
    weighed_.noalias() -= form_ * q;
  }
  correlate(weighed_, out);
}

void MatchedRemoval::adjoint(const Vector& r, Vector& out) {
  const std::vector<Index>& pixels = problem_.geometry->pixels;
  if (problem_.weights.size() == 0) {
    pixels_.spread(pixels, r, surface_);
  } else {
    weighted_ = r.cwiseProduct(problem_.weights);
    pixels_.spread(pixels, weighted_, surface_);
  }
  correlate(surface_, out);
}

void MatchedRemoval::correlate(const Vector& surface, Vector& out) {
  convolution_->correlate(surface.data());
  const auto field = convolution_->field();
  out.resize(static_cast<Index>(field_node_.size()));
  for (std::size_t i = 0; i < field_node_.size(); ++i)
    out[static_cast<Index>(i)] = field_node_[i] >= 0 ? field[static_cast<std::size_t>(field_node_[i])] : 0.0;
}

}  // namespace dwell
