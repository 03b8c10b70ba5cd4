#include "solvers/problem/dwell_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/counted.h"
#include "solvers/problem/blocks.h"

namespace dwell {
namespace {

[[noreturn]] void reject(const std::string& message) { throw std::invalid_argument("DwellProblem." + message); }

void check_size(const char* field, Index actual, Index expected) {
  if (actual != expected) reject(fmt::format("{} has {}; {} required", field, counted(actual, "value"), expected));
}

void check_finite(const char* field, const Vector& v) {
  for (Index i = 0; i < v.size(); ++i) {
    if (!std::isfinite(v[i])) reject(fmt::format("{}[{}] = {}; must be finite", field, i, v[i]));
  }
}

void check_weight(const char* field, double value) {
  if (!(std::isfinite(value) && value >= 0.0)) reject(fmt::format("{} = {}; required finite and >= 0", field, value));
}

}  // namespace

bool DwellProblem::has_geometry() const {
  return !parts.empty() && std::all_of(parts.begin(), parts.end(), [](const DwellPart& p) { return p.geometry; });
}

int DwellProblem::threads() const {
  const auto known = std::find_if(parts.begin(), parts.end(), [](const DwellPart& p) { return p.geometry; });
  return known == parts.end() ? 1 : std::max(known->geometry->threads, 1);
}

double DwellProblem::upper_at(Index j) const {
  return upper.size() == 0 ? std::numeric_limits<double>::infinity() : upper[j];
}

namespace {

bool same_pixels(const RemovalGeometry& a, const RemovalGeometry& b) {
  return a.lattice == b.lattice && a.pixels == b.pixels;
}

void validate_changes(const DwellProblem& p, const DwellPart& part, Index points, const std::string& name) {
  check_size(name.c_str(), static_cast<Index>(part.changes.size()), p.blocks() - 1);
  for (const RemovalChange& change : part.changes) {
    check_weight(name.c_str(), change.factor);
    if (!change.geometry || !part.geometry) reject(name + " without the geometry of part or change");
    if (change.geometry != part.geometry && !same_pixels(*change.geometry, *part.geometry))
      reject(name + " on another map or other pixels than the part");
    check_size((name + " strokes").c_str(), static_cast<Index>(change.geometry->strokes.size()), points);
  }
}

void validate_parts(const DwellProblem& p) {
  if (p.parts.empty()) return;
  Index points = 0;
  for_parts(p, [&](const DwellPart& part, Index first, Index count) {
    const auto name = [&](const char* field) { return fmt::format("parts[{}].{}", &part - p.parts.data(), field); };
    if (count == 0 && p.parts.size() > 1) reject(name("geometry and smoothness are empty; one of them is required"));
    if (part.geometry) {
      const RemovalGeometry& g = *part.geometry;
      check_size(name("geometry pixels").c_str(), static_cast<Index>(g.pixels.size()), p.pixels());
      check_size(name("geometry strokes").c_str(), static_cast<Index>(g.strokes.size()), count);
      const auto& of_first = p.parts.front().geometry;
      if (of_first && of_first != part.geometry && !same_pixels(*of_first, g))
        reject(name("geometry has another map or other pixels than parts[0]"));
    }
    if (!part.smoothness.empty()) check_size(name("smoothness").c_str(), part.smoothness.size(), count);
    if (part.alpha) check_weight(name("alpha").c_str(), *part.alpha);
    if (!(part.price > 0.0) || !std::isfinite(part.price))
      reject(fmt::format("{} = {}; required > 0", name("price"), part.price));
    validate_changes(p, part, count, name("changes"));
    points = first + count;
  });
  check_size("parts together", points, p.removal->cols());
}

}  // namespace

void validate(const DwellProblem& p) {
  if (!p.removal) reject("removal is not set");
  check_size("target", p.target.size(), p.removal->rows());
  const Index rows = p.target.size() / p.blocks();
  check_size("target blocks", rows * p.blocks(), p.target.size());
  if (p.rows) check_size("rows", p.rows->rows(), rows);
  check_size("lower", p.lower.size(), p.removal->cols());
  if (p.upper.size() != 0) check_size("upper", p.upper.size(), p.removal->cols());
  if (p.reference.size() != 0) check_size("reference", p.reference.size(), p.removal->cols());
  if (p.weights.size() != 0) check_size("weights", p.weights.size(), rows);
  if (p.form.cols() > kMaxFormTerms)
    reject(fmt::format("form has {}; at most {} accepted", counted(p.form.cols(), "column"), kMaxFormTerms));
  if (p.form.cols() != 0) check_size("form rows", p.form.rows(), rows);
  validate_parts(p);
  check_finite("target", p.target);
  check_finite("lower", p.lower);
  check_finite("reference", p.reference);
  check_finite("weights", p.weights);
  if (!p.form.allFinite()) reject("form has a value that is not finite");
  check_weight("alpha", p.alpha);
  check_weight("beta", p.beta);
  check_weight("gamma", p.gamma);
  for (Index i = 0; i < p.weights.size(); ++i) {
    if (!(p.weights[i] >= 0.0)) reject(fmt::format("weights[{}] = {}; required >= 0", i, p.weights[i]));
  }
  for (Index j = 0; j < p.points(); ++j) {
    if (!(p.lower[j] <= p.upper_at(j)))
      reject(fmt::format("lower[{}] = {} s exceeds upper[{}] = {} s", j, p.lower[j], j, p.upper_at(j)));
  }
}

namespace {

/// Calls visit(part, first dwell point, number of dwell points) for the parts whose smoothness counts.
template <class Visit>
void for_smooth_parts(const DwellProblem& p, const Visit& visit) {
  for_parts(p, [&](const DwellPart& part, Index first, Index points) {
    if (p.alpha_of(part) > 0.0 && !part.smoothness.empty()) visit(part, first, points);
  });
}

}  // namespace

double squared_steps(const DwellProblem& p, const Vector& d) {
  double sum = 0.0;
  for_smooth_parts(p, [&](const DwellPart& part, Index first, Index points) {
    sum += p.alpha_of(part) * part.smoothness.squared_norm(d.segment(first, points));
  });
  return sum;
}

void add_smoothness(const DwellProblem& p, const Vector& d, Vector& out) {
  for_smooth_parts(p, [&](const DwellPart& part, Index first, Index points) {
    part.smoothness.add_normal(p.alpha_of(part), d.segment(first, points), out.segment(first, points));
  });
}

double smoothness_term(const DwellProblem& p, const Vector& t) {
  double sum = 0.0;
  for_smooth_parts(p, [&](const DwellPart& part, Index first, Index points) {
    sum += p.alpha_of(part) * part.smoothness.squared_norm(t.segment(first, points), p.lower.segment(first, points));
  });
  return sum;
}

double step_rms(const DwellProblem& p, const Vector& t) {
  double squares = 0.0;
  Index links = 0;
  for_parts(p, [&](const DwellPart& part, Index first, Index points) {
    if (part.smoothness.empty()) return;
    squares += part.smoothness.squared_norm(t.segment(first, points), p.lower.segment(first, points));
    links += part.smoothness.links();
  });
  return links == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(links));
}

double priced_total(const DwellProblem& p, const Vector& t) {
  if (p.parts.size() < 2) return (p.parts.empty() ? 1.0 : p.parts.front().price) * t.sum();
  double sum = 0.0;
  for_parts(
      p, [&](const DwellPart& part, Index first, Index points) { sum += part.price * t.segment(first, points).sum(); });
  return sum;
}

void add_prices(const DwellProblem& p, double factor, Vector& out) {
  if (p.parts.empty()) out.array() += factor;
  for_parts(p, [&](const DwellPart& part, Index first, Index points) {
    out.segment(first, points).array() += factor * part.price;
  });
}

double penalty(const DwellProblem& p, const Vector& t) {
  double f = 0.5 * smoothness_term(p, t);
  if (p.beta > 0.0) f += 0.5 * p.beta * (p.reference.size() != 0 ? (t - p.reference).squaredNorm() : t.squaredNorm());
  if (p.gamma > 0.0) f += p.gamma * priced_total(p, t);
  return f;
}

void add_penalty_gradient(const DwellProblem& p, const Vector& t, Vector& g) {
  for_smooth_parts(p, [&](const DwellPart& part, Index first, Index points) {
    part.smoothness.add_normal(p.alpha_of(part), t.segment(first, points), p.lower.segment(first, points),
                               g.segment(first, points));
  });
  if (p.beta > 0.0) {
    g += p.beta * t;
    if (p.reference.size() != 0) g -= p.beta * p.reference;
  }
  if (p.gamma > 0.0) add_prices(p, p.gamma, g);
}

void clip_to_bounds(const DwellProblem& p, Vector& t) {
  t = t.cwiseMax(p.lower);
  if (p.upper.size() != 0) t = t.cwiseMin(p.upper);
}

DwellObjective::DwellObjective(const DwellProblem& problem)
    : problem_(problem), weighted_(problem.weights.size() == 0 ? 0 : problem.residuals()) {}

void DwellObjective::weigh_and_project(Vector& v) const {
  const Index blocks = problem_.blocks(), rows = v.size() / blocks;
  for (Index block = 0; block < blocks; ++block) {
    auto of_block = v.segment(block * rows, rows);
    if (problem_.weights.size() != 0) of_block.array() *= problem_.weights.array();
    if (problem_.form.cols() != 0) project(of_block);
  }
}

/// The form terms are taken out of the weighted rows of one block.
void DwellObjective::project(Eigen::Ref<Vector> v) const {
  // Q is several times as large as v: in blocks of rows, by all threads; the blocks are summed in order.
  constexpr Index kBlocks = 64, kSmall = 1 << 16;
  const Index m = v.size(), terms = problem_.form.cols(), block = (m + kBlocks - 1) / kBlocks;
  [[maybe_unused]] const int team = m > kSmall ? threads() : 1;
  const auto begin = [&](Index b) { return std::min(b * block, m); };
  const auto rows = [&](Index b) { return begin(b + 1) - begin(b); };
  Eigen::Matrix<double, kMaxFormTerms, kBlocks> partial = Eigen::Matrix<double, kMaxFormTerms, kBlocks>::Zero();
#pragma omp parallel for num_threads(team) schedule(static)
  for (Index b = 0; b < kBlocks; ++b) {
    for (Index k = 0; k < terms; ++k)
      partial(k, b) = problem_.form.col(k).segment(begin(b), rows(b)).dot(v.segment(begin(b), rows(b)));
  }
  const Eigen::Matrix<double, kMaxFormTerms, 1> c = partial.rowwise().sum();
#pragma omp parallel for num_threads(team) schedule(static)
  for (Index b = 0; b < kBlocks; ++b) {
    for (Index k = 0; k < terms; ++k)
      v.segment(begin(b), rows(b)) -= c[k] * problem_.form.col(k).segment(begin(b), rows(b));
  }
}

void DwellObjective::residual(const Vector& t, Vector& r) {
  const bool removes = (t.array() != 0.0).any();
  if (removes) {
    problem_.removal->apply(t, r);
  } else {
    r.resize(problem_.residuals());
  }
  for_blocks(r.size(), threads(), [&](Index, Index begin, Index length) {
    const auto z = problem_.target.segment(begin, length);
    if (removes) {
      r.segment(begin, length) -= z;
    } else {
      r.segment(begin, length) = -z;
    }
  });
  weigh_and_project(r);
}

double DwellObjective::evaluate(const Vector& t, Vector& r, Vector& g) {
  residual(t, r);
  adjoint_of_weighted(r, g);
  if (!(t.array() != 0.0).any()) gradient_scale_ = g.norm();
  add_penalty_gradient(problem_, t, g);
  return value(r, t);
}

void DwellObjective::image(const Vector& d, Vector& image) {
  problem_.removal->apply(d, image);
  weigh_and_project(image);
}

// A residual already lies in the range of I - Q Q', so P' W' r = W r.
void DwellObjective::adjoint_of_weighted(const Vector& r, Vector& g) {
  if (problem_.weights.size() == 0) {
    problem_.removal->apply_adjoint(r, g);
  } else {
    const Index blocks = problem_.blocks(), rows = r.size() / blocks;
    weighted_.resize(r.size());
    for (Index block = 0; block < blocks; ++block)
      weighted_.segment(block * rows, rows) = r.segment(block * rows, rows).cwiseProduct(problem_.weights);
    problem_.removal->apply_adjoint(weighted_, g);
  }
}

void DwellObjective::gradient(const Vector& r, const Vector& t, Vector& g) {
  adjoint_of_weighted(r, g);
  add_penalty_gradient(problem_, t, g);
}

void DwellObjective::hessian_times(const Vector& d, const Vector& image, Vector& h) {
  adjoint_of_weighted(image, h);
  add_smoothness(problem_, d, h);
  if (problem_.beta > 0.0) h += problem_.beta * d;
}

double DwellObjective::curvature(const Vector& d, const Vector& image) const {
  double c = squared_norm(image) + squared_steps(problem_, d);
  if (problem_.beta > 0.0) c += problem_.beta * d.squaredNorm();
  return c;
}

double DwellObjective::value(const Vector& r, const Vector& t) const {
  return 0.5 * squared_norm(r) + penalty(problem_, t);
}

void DwellObjective::advance(double a, const Vector& image, Vector& r) const {
  for_blocks(r.size(), threads(),
             [&](Index, Index begin, Index length) { r.segment(begin, length) += a * image.segment(begin, length); });
}

double DwellObjective::squared_norm(const Vector& v) const {
  return sum_over(v.size(), threads(),
                  [&](Index begin, Index length) { return v.segment(begin, length).squaredNorm(); });
}

int DwellObjective::threads() const { return problem_.threads(); }

double DwellObjective::gradient_scale() {
  if (gradient_scale_ < 0.0) {
    Vector z = problem_.target, g;
    weigh_and_project(z);
    adjoint_of_weighted(z, g);
    gradient_scale_ = g.norm();
  }
  return gradient_scale_;
}

void project_gradient(const DwellProblem& p, const Vector& t, const Vector& gradient, Vector& projected) {
  projected.resize(t.size());
  for (Index j = 0; j < t.size(); ++j) {
    const double g = gradient[j];
    const bool pushed_out = (t[j] <= p.lower[j] && g > 0.0) || (t[j] >= p.upper_at(j) && g < 0.0);
    projected[j] = pushed_out ? 0.0 : g;
  }
}

}  // namespace dwell
