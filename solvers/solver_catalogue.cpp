#include "solvers/solver_catalogue.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "core/base/errors.h"
#include "solvers/matched/auto_solver.h"
#include "solvers/native/dense_nnls.h"
#include "solvers/native/projected_cg.h"
#include "solvers/native/projected_lbfgs.h"
#include "solvers/native/questioned_solver.h"
#include "solvers/native/spectral_projected_gradient.h"
#include "solvers/peers/ceres_solver.h"
#include "solvers/peers/fourier_deconvolution.h"
#include "solvers/peers/lbfgsb_solver.h"
#include "solvers/peers/nlopt_solver.h"

namespace dwell {
namespace {

template <class Solver>
std::unique_ptr<DwellSolver> make(const SolverOptions& options) {
  return std::make_unique<Solver>(options);
}

constexpr bool kOurs = false, kPeer = true;

std::vector<SolverRecord> make_catalogue() {
  using Kind = SolverKind;
  return {
      {Kind::Auto,
       "auto",
       "most of the work on pixels matched to the removal function, judged on the full problem",
       kOurs,
       {},
       make<AutoSolver>},
      {Kind::Lbfgsb, "lbfgsb", "L-BFGS-B 3.0", kPeer, {}, make<LbfgsbSolver>},
      {Kind::NloptLbfgs, "nlopt-lbfgs", "NLopt LD_LBFGS", kPeer, {}, make<NloptSolver>},
      {Kind::ProjectedLbfgs,
       "projected-lbfgs",
       "matrix-free quasi-Newton steps of exact length",
       kOurs,
       {},
       make<ProjectedLbfgs>},
      {Kind::ProjectedCg,
       "projected-cg",
       "matrix-free conjugate gradients on the dwell times that no bound holds",
       kOurs,
       {},
       make<ProjectedCg>},
      {Kind::NloptTnewton, "nlopt-tnewton", "NLopt LD_TNEWTON_PRECOND_RESTART", kPeer, {}, make<NloptSolver>},
      {Kind::SpectralProjectedGradient,
       "spectral-projected-gradient",
       "matrix-free, the simplest: one operator pair and three vectors an iteration",
       kOurs,
       {},
       make<SpectralProjectedGradient>},
      {Kind::Fourier,
       "fourier",
       "Wiener deconvolution clipped to the bounds: no optimum, but what many use",
       kPeer,
       {},
       make<FourierDeconvolution>},
      {Kind::Ceres, "ceres", "Ceres, bounded least squares on the explicit matrix", kPeer, CeresSolver::kMaxPoints,
       make<CeresSolver>},
      {Kind::DenseNnls, "dense-nnls", "Lawson and Hanson's active set on the dense normal equations", kPeer,
       DenseNnls::kMaxPoints, make<DenseNnls>},
      {Kind::NloptMma, "nlopt-mma", "NLopt LD_MMA", kPeer, {}, make<NloptSolver>},
      {Kind::NloptSlsqp, "nlopt-slsqp", "NLopt LD_SLSQP", kPeer, NloptSolver::kMaxSlsqpPoints, make<NloptSolver>},
  };
}

}  // namespace

const std::vector<SolverRecord>& solver_catalogue() {
  static const std::vector<SolverRecord> kCatalogue = make_catalogue();
  return kCatalogue;
}

const SolverRecord& solver_record(SolverKind kind) {
  for (const SolverRecord& record : solver_catalogue()) {
    if (record.kind == kind) return record;
  }
  throw std::logic_error("this value of SolverKind has no record in the catalogue");
}

std::string to_string(SolverKind kind) { return solver_record(kind).name; }

SolverKind parse_solver_kind(const std::string& text) {
  std::string accepted;
  for (const SolverRecord& record : solver_catalogue()) {
    if (text == record.name) return record.kind;
    accepted += (accepted.empty() ? "" : ", ") + record.name;
  }
  throw InputError(fmt::format("solver = '{}'; accepted: {}", text, accepted));
}

std::unique_ptr<DwellSolver> make_solver(const SolverOptions& options) {
  validate(options);
  std::unique_ptr<DwellSolver> solver = solver_record(options.kind).make(options);
  const bool by_the_same_rule = options.kind == SolverKind::Auto || options.kind == SolverKind::ProjectedLbfgs;
  return by_the_same_rule ? std::move(solver) : std::make_unique<QuestionedSolver>(std::move(solver), options);
}

}  // namespace dwell
