#include "solvers/matched/dwell_model.h"

#include <algorithm>
#include <utility>

#include "solvers/matched/model_pixels.h"
#include "solvers/matched/resolution_matched_hessian.h"
#include "solvers/matched/smooth_dwell.h"
#include "solvers/problem/full_hessian.h"

namespace dwell {
namespace {

class SmoothModel final : public DwellModel {
 public:
  SmoothModel(const DwellProblem& problem, StackedSmoothDwell dwell, CoarseFactor factor)
      : p_(problem), dwell_(std::move(dwell)), hessian_(problem, dwell_, factor) {}

  Index size() const override { return dwell_.size(); }
  QuadraticForm& form() override { return hessian_; }
  Vector largest() const override { return dwell_.largest(p_); }
  void prolong(const Vector& s, Vector& d) const override {
    d.resize(p_.points());
    dwell_.prolong(s, d);
  }
  void restrict_to(const Vector& g, Vector& out) override { dwell_.restrict_to(g, out); }
  void gradient(const Vector& r, const Vector& t, Vector& g) override {
    of_points_.setZero(p_.points());
    add_penalty_gradient(p_, t, of_points_);
    dwell_.restrict_to(of_points_, of_penalty_);
    hessian_.removal_gradient(r, g);
    g += of_penalty_;
  }

 private:
  const DwellProblem& p_;
  StackedSmoothDwell dwell_;
  SmoothDwellHessian hessian_;
  Vector of_points_, of_penalty_;
};

/// The dwell points themselves.
class PointsModel : public DwellModel {
 public:
  explicit PointsModel(const DwellProblem& problem) : p_(problem) {}

  Index size() const override { return p_.points(); }
  Vector largest() const override { return p_.upper.size() == 0 ? Vector() : Vector(p_.upper - p_.lower); }
  void prolong(const Vector& s, Vector& d) const override { d = s; }
  void restrict_to(const Vector& g, Vector& out) override { out = g; }

 private:
  const DwellProblem& p_;
};

class CoarsePixelsModel final : public PointsModel {
 public:
  CoarsePixelsModel(const DwellProblem& problem, CoarseFactor factor)
      : PointsModel(problem), hessian_(problem, factor) {}

  QuadraticForm& form() override { return hessian_; }
  void gradient(const Vector& r, const Vector& t, Vector& g) override { hessian_.gradient(r, t, g); }

 private:
  ResolutionMatchedHessian hessian_;
};

class FullModel final : public PointsModel {
 public:
  FullModel(const DwellProblem& problem, DwellObjective& objective)
      : PointsModel(problem), objective_(objective), hessian_(objective) {}

  QuadraticForm& form() override { return hessian_; }
  void gradient(const Vector& r, const Vector& t, Vector& g) override { objective_.gradient(r, t, g); }

 private:
  DwellObjective& objective_;
  FullHessian hessian_;
};

}  // namespace

std::unique_ptr<DwellModel> make_dwell_model(const DwellProblem& problem, DwellObjective& objective) {
  if (!problem.has_geometry()) return std::make_unique<FullModel>(problem, objective);
  const CoarseFactor factor = model_pixels(problem), fine = fine_pixels(narrowest_sigma(problem), factor);
  const Index finest = finest_factor(problem);
  if (std::min(fine.x, fine.y) >= finest) {
    StackedSmoothDwell dwell(problem, fine);
    if (dwell.has_points_for_each(kPointsPerVariable)) {
      return std::make_unique<SmoothModel>(problem, std::move(dwell), fine);
    }
  }
  if (std::min(factor.x, factor.y) >= finest) return std::make_unique<CoarsePixelsModel>(problem, factor);
  return std::make_unique<FullModel>(problem, objective);
}

}  // namespace dwell
