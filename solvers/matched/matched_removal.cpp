#include "solvers/matched/matched_removal.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/tif/kernel_change.h"
#include "solvers/matched/model_pixels.h"

namespace dwell {
namespace {

std::vector<Index> all_nodes(const Grid& grid) {
  std::vector<Index> nodes(static_cast<std::size_t>(grid.size()));
  std::iota(nodes.begin(), nodes.end(), Index{0});
  return nodes;
}

}  // namespace

MatchedRemoval::MatchedRemoval(const DwellProblem& problem, const std::vector<Grid>& dwell, CoarseFactor factor)
    : problem_(problem),
      pixels_(problem.parts.front().geometry->lattice, factor, problem.parts.front().geometry->threads) {
  const RemovalGeometry& g = *problem.parts.front().geometry;
  add_pixels();
  const Grid& lattice = pixels_.lattice();
  form_.resize(lattice.size(), problem.form.cols());
  Vector column, spread;
  for (Index k = 0; k < problem.form.cols(); ++k) {
    column = problem.form.col(k);
    pixels_.spread(g.pixels, heights_of_weighted(column), spread);
    form_.col(k) = spread;
  }
  double coarse = 0.0;
  for (Index block = 0; block < problem.blocks(); ++block)
    add_block(static_cast<std::size_t>(block), dwell, factor, coarse);
  surface_.resize(lattice.size());
  if (problem.parts.size() > 1) of_tool_.resize(lattice.size());
  relative_cost_ = coarse / pair_cost(problem);
}

/// Adds the cost of its transforms to `coarse`.
void MatchedRemoval::add_block(std::size_t block, const std::vector<Grid>& dwell, CoarseFactor factor, double& coarse) {
  const auto is_rate = [block](const DwellPart& part) {
    return block > 0 && part.changes[block - 1].geometry == part.geometry;
  };
  const double of_first =
      problem_.parts.front().changes.empty() || block == 0 ? 1.0 : problem_.parts.front().changes[block - 1].factor;
  const bool scales = std::all_of(problem_.parts.begin(), problem_.parts.end(), [&](const DwellPart& part) {
    return is_rate(part) && part.changes[block - 1].factor == of_first;
  });
  Block& added = blocks_.emplace_back();
  if (scales) {
    added.factor = of_first;
    return;
  }
  for (std::size_t k = 0; k < problem_.parts.size(); ++k) {
    const DwellPart& part = problem_.parts[k];
    const RemovalGeometry& g = block == 0 ? *part.geometry : *part.changes[block - 1].geometry;
    RemovalKernel kernel = matched_kernel(g.kernel, factor);
    if (block > 0) kernel = times(std::move(kernel), part.changes[block - 1].factor);
    added.tools.push_back(make_tool(kernel, dwell[k]));
    coarse += transform_cost(pixels_.lattice(), kernel);
  }
}

/// S'R'W^2 R S.
void MatchedRemoval::add_pixels() {
  const std::vector<Index>& pixels = problem_.parts.front().geometry->pixels;
  const Vector squares = problem_.weights.cwiseAbs2();
  if (!problem_.rows) return pixels_.add(pixels, squares, SplineGram::Take::Value, 1.0);
  const SurfaceRows& rows = *problem_.rows;
  if (rows.heights() > 0) {
    const Index of_heights = squares.size() == 0 ? 0 : rows.heights();
    pixels_.add(pixels, squares.head(of_heights), SplineGram::Take::Value, 1.0);
  }
  add_slopes(0, rows.pairs_x(), SplineGram::Take::StepX);
  add_slopes(rows.pairs_x(), rows.pairs_y(), SplineGram::Take::StepY);
}

/// Where the lattice divides the map's pixels, a slope is over n of its own, and taken as that many steps: (sum of n
/// steps)^2 <= n (sum of their squares), with equality where the surface is straight between two pixels. So the model
/// sees a little more curvature than there is, and never a descent without any.
void MatchedRemoval::add_slopes(Index first, Index count, SplineGram::Take take) {
  const RemovalGeometry& g = *problem_.parts.front().geometry;
  const SurfaceRows& rows = *problem_.rows;
  const bool along_x = take == SplineGram::Take::StepX;
  const Index stride = along_x ? 1 : g.lattice.cols;
  const double pitch = along_x ? g.lattice.pitch_x : g.lattice.pitch_y;
  std::vector<std::pair<Index, double>> steps;
  for (Index k = first; k < first + count; ++k) {
    const auto [from, to] = rows.pair(k);
    const Index begin = g.pixels[static_cast<std::size_t>(from)], end = g.pixels[static_cast<std::size_t>(to)];
    const double w = problem_.weights.size() == 0 ? 1.0 : problem_.weights[rows.heights() + k];
    const double each = w * w / (pitch * pitch * static_cast<double>((end - begin) / stride));
    for (Index pixel = begin; pixel < end; pixel += stride) steps.emplace_back(pixel, each);
  }
  std::sort(steps.begin(), steps.end());
  std::vector<Index> pixels;
  Vector weights(static_cast<Index>(steps.size()));
  pixels.reserve(steps.size());
  for (const auto& [pixel, weight] : steps) {
    weights[static_cast<Index>(pixels.size())] = weight;
    pixels.push_back(pixel);
  }
  pixels_.add(pixels, weights, take, 1.0);
}

/// R'W r, of the rows of one block.
const Vector& MatchedRemoval::heights_of_weighted(const Vector& r) {
  const bool weighs = problem_.weights.size() != 0;
  if (weighs) weighted_ = r.cwiseProduct(problem_.weights);
  const Vector& rows = weighs ? weighted_ : r;
  if (!problem_.rows) return rows;
  problem_.rows->apply_adjoint(rows, heights_);
  return heights_;
}

MatchedRemoval::Tool MatchedRemoval::make_tool(const RemovalKernel& kernel, const Grid& dwell) const {
  const Grid& lattice = pixels_.lattice();
  // A coarse transform is too short to share between threads.
  Tool tool{{lattice, all_nodes(lattice), kernel.surface.coefficients(), kernel.half_rows, kernel.half_cols, 1}, {}};
  const auto row0 = static_cast<Index>(std::llround((dwell.origin.y - lattice.origin.y) / lattice.pitch_y));
  const auto col0 = static_cast<Index>(std::llround((dwell.origin.x - lattice.origin.x) / lattice.pitch_x));
  tool.field_node.reserve(static_cast<std::size_t>(dwell.size()));
  for (Index i = 0; i < dwell.size(); ++i)
    tool.field_node.push_back(tool.convolution.node(row0 + i / dwell.cols, col0 + i % dwell.cols));
  return tool;
}

void MatchedRemoval::put(const Vector& c, Tool& tool) {
  tool.convolution.clear_field();
  const auto field = tool.convolution.field();
  for (std::size_t i = 0; i < tool.field_node.size(); ++i) {
    if (tool.field_node[i] >= 0) field[static_cast<std::size_t>(tool.field_node[i])] = c[static_cast<Index>(i)];
  }
}

/// What the dwell of all parts makes of the surface.
void MatchedRemoval::remove(const std::vector<Vector>& c, std::vector<Tool>& tools) {
  for (std::size_t k = 0; k < tools.size(); ++k) {
    put(c[k], tools[k]);
    tools[k].convolution.convolve(k == 0 ? surface_.data() : of_tool_.data());
    if (k > 0) surface_ += of_tool_;
  }
}

void MatchedRemoval::normal(const std::vector<Vector>& c, std::vector<Vector>& out) {
  double of_first = 1.0;
  for (const Block& block : blocks_) of_first += block.tools.empty() ? block.factor * block.factor : 0.0;
  for (Block& block : blocks_) {
    if (block.tools.empty()) continue;
    const bool first = &block == blocks_.data();
    remove(c, block.tools);
    pixels_.apply(surface_, weighed_);
    if (form_.cols() != 0) {
      const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxFormTerms, 1> q = form_.transpose() * surface_;
      weighed_.noalias() -= form_ * q;
    }
    if (first && of_first != 1.0) weighed_ *= of_first;
    correlate(weighed_, block.tools, first, out);
  }
}

void MatchedRemoval::adjoint(const Vector& r, std::vector<Vector>& out) {
  const std::vector<Index>& pixels = problem_.parts.front().geometry->pixels;
  const Index rows = r.size() / problem_.blocks();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (blocks_[k].tools.empty()) continue;
    if (blocks_.size() > 1) of_block_ = r.segment(static_cast<Index>(k) * rows, rows);
    for (std::size_t scaled = 1; k == 0 && scaled < blocks_.size(); ++scaled) {
      if (blocks_[scaled].tools.empty())
        of_block_ += blocks_[scaled].factor * r.segment(static_cast<Index>(scaled) * rows, rows);
    }
    pixels_.spread(pixels, heights_of_weighted(blocks_.size() > 1 ? of_block_ : r), surface_);
    correlate(surface_, blocks_[k].tools, k == 0, out);
  }
}

/// Puts what the nodes of each part say into `out`, or, but for the first, adds it.
void MatchedRemoval::correlate(const Vector& surface, std::vector<Tool>& tools, bool first, std::vector<Vector>& out) {
  out.resize(tools.size());
  for (std::size_t k = 0; k < tools.size(); ++k) {
    Tool& tool = tools[k];
    tool.convolution.correlate(surface.data());
    const auto field = tool.convolution.field();
    if (first) out[k].setZero(static_cast<Index>(tool.field_node.size()));
    for (std::size_t i = 0; i < tool.field_node.size(); ++i) {
      if (tool.field_node[i] >= 0) out[k][static_cast<Index>(i)] += field[static_cast<std::size_t>(tool.field_node[i])];
    }
  }
}

}  // namespace dwell
