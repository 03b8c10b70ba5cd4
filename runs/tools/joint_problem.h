#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "runs/plan/dwell_options.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/part.h"
#include "solvers/problem/certificate.h"
#include "solvers/problem/dwell_problem.h"
#include "solvers/problem/dwell_solver.h"
#include "solvers/weights/time_worth.h"

namespace dwell {

/// One of several tools that work the same surface, with a path of its own.
struct JointTool {
  std::string name;
  std::shared_ptr<const Part> part;  // the surface, the same for all of them, and this removal function
  LaidPath laid;
  DwellOptions options;      // its machine, and its smoothness: a number or Auto
  double price = 1.0;        // of a second with it, over the common price; > 0
  double change_over = 0.0;  // what mounting it takes of machine time, at its price [s]; >= 0
};

/// What some of the tools are to do together.
struct JointDwell {
  std::vector<std::size_t> tools;  // that take part, by their numbers, ascending
  std::vector<Vector> seconds;     // of every dwell point of each of these [s]
  double residual_rms = 0.0;       // of what the objective sees, as the lattices have it [nm]
  double price = 0.0;              // common, at which this is the best [nm^2/s]
  double total = 0.0;              // of dwell and change-over [s]
  double time_cost = 0.0;          // what these cost [nm^2]
  double cost = 0.0;               // the objective over the pixels, with time_cost [nm^2]
  SolverSummary solver;
  Certificate certificate;
};

/// The dwell problem of several tools on one surface, which any set of them may work:
///
///   minimise  1/2 |W P (sum_k A_k t_k - z)|^2 + sum_k [ alpha_k/2 |D_k (t_k - l_k)|^2 + gamma p_k (1't_k + c_k) ]
///
/// with p_k the tool's price and c_k its change-over. Each tool's alpha_k is that of a plan for it alone: the
/// smoothness it is given, or the usual one. Solvers are given the seconds in the measure of what the tools remove in
/// them, which is the same problem, and as easy for tools of very different rates as for equal ones.
class JointProblem {
 public:
  /// All tools have parts of the same pixels, weights and form terms. Throws InputError for options that a joint solve
  /// cannot have: a weight that is searched, a fraction of the error, a Fourier deconvolution. Cost: the set-up of a
  /// removal operator for each.
  explicit JointProblem(std::vector<JointTool> tools, const Progress& progress = {});

  const std::vector<JointTool>& tools() const { return tools_; }
  /// The weight of smoothness of a tool, in the place of Auto a number.
  double smoothness(std::size_t tool) const { return pieces_[tool].smoothness_weight; }
  /// The least dwell of some tools, with their change-over [s].
  double least_total(const std::vector<std::size_t>& tools) const;

  /// The common price of a second [nm^2/s], by the rules of a plan, with all tools at work. Throws and costs as
  /// find_time_price.
  TimePrice find_price(const TimeWorth& worth, const Progress& progress = {});

  /// The best dwell of some tools, given by their numbers, at a common price [nm^2/s]. Throws Interrupted,
  /// std::runtime_error if the solver fails. Cost: the solve, and five operator applications.
  JointDwell solve(const std::vector<std::size_t>& tools, double price, double max_seconds, const std::string& stage,
                   const Progress& progress = {});

 private:
  /// What a tool brings into the problem, in seconds times `scale`.
  struct Piece {
    std::shared_ptr<const RemovalGeometry> geometry;
    PathSmoothness smoothness;
    double smoothness_weight = 0.0;
    double alpha = 0.0, scale = 1.0;
    Vector lower;
    Vector moved;  // what of the target its moves between halts remove [nm, or as the rows have it]
  };

  /// A problem of some tools and the operators that it refers to.
  struct Stack {
    std::unique_ptr<RemovalOperator> removal, rows;
    DwellProblem problem;
  };

  void add(const JointTool& tool, const RemovalKernel& kernel, const Progress& progress);
  Stack stack(const std::vector<std::size_t>& tools) const;

  std::vector<JointTool> tools_;
  std::vector<Piece> pieces_;
  DwellProblem common_;  // rows, target, form and weights, which are of the surface
};

}  // namespace dwell
