#pragma once

#include <vector>

#include "core/numerics/padded_convolution.h"
#include "core/removal/matched_kernel.h"
#include "solvers/matched/spline_gram.h"
#include "solvers/problem/dwell_problem.h"

namespace dwell {

/// The removal of a dwell problem on pixels matched to the removal function. A t is smooth on the scale of the removal
/// function, so it is the spline S d through its values at every q-th pixel, and d = K c: the coarse kernel times the
/// dwell c that stands on the nodes of a coarse dwell lattice. What the pixels make of it is exact for ragged
/// apertures, weights, slopes and form terms: S'R'W (I - Q Q') W R S, with R the rows of the problem's objective, the
/// heights themselves where it has none. Work on the map's own pixels is done once, when made, and
/// once per adjoint(). Of several parts of a problem, each has its kernel and its dwell lattice, all have the pixels,
/// and their removals add up. Every part's geometry must be set; the problem must outlive this.
class MatchedRemoval {
 public:
  /// dwell: for each part nodes on the map's lines at every factor-th pixel, anywhere.
  MatchedRemoval(const DwellProblem& problem, const std::vector<Grid>& dwell, CoarseFactor factor);

  /// out = sum_k K_k'S'R'W (I - Q Q') W R S K_k c over the blocks of the problem's rows; one vector a part, both ways.
  void normal(const std::vector<Vector>& c, std::vector<Vector>& out);
  /// out = sum_k K_k'S'R'W r_k for a residual r of the problem: this model's own gradient, consistent with normal().
  void adjoint(const Vector& r, std::vector<Vector>& out);
  /// Cost of normal() in operator pairs of the full problem, by transform_cost.
  double relative_cost() const { return relative_cost_; }

 private:
  /// A coarse convolution of one part.
  struct Tool {
    PaddedConvolution convolution;
    std::vector<Index> field_node;  // of every node of the dwell lattice, -1 = out of reach
  };
  /// The rows of one block: the convolutions of all parts, or, where it is a change of the rate of every part, those of
  /// the first block times a factor.
  struct Block {
    std::vector<Tool> tools;
    double factor = 1.0;
  };

  void add_pixels();
  void add_slopes(Index first, Index count, SplineGram::Take take);
  const Vector& heights_of_weighted(const Vector& r);
  void add_block(std::size_t block, const std::vector<Grid>& dwell, CoarseFactor factor, double& coarse);
  Tool make_tool(const RemovalKernel& kernel, const Grid& dwell) const;
  void remove(const std::vector<Vector>& c, std::vector<Tool>& tools);
  static void put(const Vector& c, Tool& tool);
  static void correlate(const Vector& surface, std::vector<Tool>& tools, bool first, std::vector<Vector>& out);

  const DwellProblem& problem_;
  SplineGram pixels_;
  Eigen::MatrixXd form_;  // S'R'W Q
  std::vector<Block> blocks_;
  Vector surface_, of_tool_, weighed_, weighted_, heights_, of_block_;
  double relative_cost_ = 1.0;
};

}  // namespace dwell
