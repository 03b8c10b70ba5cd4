#include "tests/solvers/problem/small_problem.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/base/numbers.h"
#include "tests/oracle/dense_algebra.h"

namespace dwell::test {
namespace {

/// D from its definition, one row a pair of neighbours without a lift.
Eigen::MatrixXd differences(const std::vector<double>& lengths, const std::vector<char>& joined) {
  const auto n = static_cast<Index>(lengths.size());
  double sum = 0.0, moving = 0.0;
  for (double l : lengths) {
    sum += l;
    moving += l > 0.0 ? 1.0 : 0.0;
  }
  const auto scale = [&](Index j) {
    const double l = lengths[static_cast<std::size_t>(j)];
    return l > 0.0 ? std::min(sum / moving / l, 100.0) : 1.0;
  };
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(n, n);
  for (Index j = 1; j < n; ++j) {
    if (!joined[static_cast<std::size_t>(j)]) continue;
    d(j, j) = scale(j);
    d(j, j - 1) = -scale(j - 1);
  }
  return d;
}

}  // namespace

SmallProblem::SmallProblem(Eigen::MatrixXd matrix, Vector target) : a(std::move(matrix)) {
  removal = std::make_unique<SparseRemoval>(SparseRemoval::Matrix(a.sparseView()), 1);
  problem.removal = removal.get();
  problem.target = std::move(target);
  problem.lower = Vector::Zero(a.cols());
}

void SmallProblem::set_smoothness(double alpha, std::vector<double> stroke_lengths, std::vector<char> stroke_joined) {
  lengths = std::move(stroke_lengths);
  joined = std::move(stroke_joined);
  problem.alpha = alpha;
  problem.parts = {{nullptr, PathSmoothness(lengths, joined)}};
}

Quadratic SmallProblem::quadratic() const {
  const Index m = a.rows(), n = a.cols();
  const Vector w = problem.weights.size() ? problem.weights : Vector(Vector::Ones(m));
  Eigen::MatrixXd keep = Eigen::MatrixXd::Identity(m, m);
  if (problem.form.cols()) keep -= problem.form * problem.form.transpose();
  const Eigen::MatrixXd b = keep * w.asDiagonal() * a;
  const Vector y = keep * w.cwiseProduct(problem.target);
  const Vector t0 = problem.reference.size() ? problem.reference : Vector(Vector::Zero(n));
  Quadratic q;
  q.h = b.transpose() * b + problem.beta * Eigen::MatrixXd::Identity(n, n);
  q.c = -b.transpose() * y - problem.beta * t0 + Vector::Constant(n, problem.gamma);
  q.constant = 0.5 * y.squaredNorm() + 0.5 * problem.beta * t0.squaredNorm();
  if (!lengths.empty()) {
    const Eigen::MatrixXd d = differences(lengths, joined);
    const Vector of_least = d * problem.lower;
    q.h += problem.alpha * d.transpose() * d;
    q.c -= problem.alpha * d.transpose() * of_least;
    q.constant += 0.5 * problem.alpha * of_least.squaredNorm();
  }
  return q;
}

SmallProblem random_problem(const Recipe& recipe, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::normal_distribution<double> normal;
  const Index m = recipe.pixels, n = recipe.points;
  Eigen::MatrixXd a(m, n);
  for (Index j = 0; j < n; ++j) {
    const double centre = (static_cast<double>(j) + u(random)) / static_cast<double>(n);
    const double width = (0.6 + u(random)) / static_cast<double>(n);
    for (Index i = 0; i < m; ++i) {
      const double x = ((static_cast<double>(i) + 0.5) / static_cast<double>(m) - centre) / width;
      a(i, j) = std::abs(x) < 3.0 ? std::exp(-0.5 * x * x) : 0.0;
    }
    if (recipe.rank_deficient && j % 2 == 1) a.col(j) = a.col(j - 1);
  }
  Vector wanted(n);
  for (Index j = 0; j < n; ++j) wanted[j] = 4.0 * u(random) - 1.0;  // some below zero, some above the upper bound
  Vector target = a * wanted;
  for (Index i = 0; i < m; ++i) target[i] += 0.1 * normal(random);
  SmallProblem small(a, target);
  DwellProblem& p = small.problem;
  for (Index j = 0; j < n; ++j) p.lower[j] = 0.2 * u(random);
  if (recipe.upper) {
    p.upper = p.lower;
    for (Index j = 0; j < n; ++j) p.upper[j] += j % 4 == 3 ? kInfinity : 1.5 * u(random);
  }
  if (!recipe.terms) return small;
  p.weights.resize(m);
  Eigen::MatrixXd form(m, 3);
  for (Index i = 0; i < m; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(m) - 0.5;
    p.weights[i] = i % 7 == 0 ? 0.0 : 0.5 + u(random);
    form.row(i) << p.weights[i], p.weights[i] * x, p.weights[i] * x * x;
  }
  p.form = oracle::thin_qr(form).q;
  std::vector<double> lengths;
  std::vector<char> joined;
  for (Index j = 0; j < n; ++j) {
    lengths.push_back(j % 5 == 4 ? 0.0 : 0.3 + u(random));
    joined.push_back(j % 4 != 0);
  }
  small.set_smoothness(0.5, lengths, joined);
  p.beta = 0.05;
  p.gamma = 0.1;
  p.reference.resize(n);
  for (Index j = 0; j < n; ++j) p.reference[j] = u(random);
  return small;
}

Vector minimise_by_enumeration(const SmallProblem& small) {
  const Quadratic q = small.quadratic();
  const Index n = q.c.size();
  if (n > 8) throw std::logic_error("enumeration is for at most 8 points");
  Vector best;
  double best_value = kInfinity;
  const auto sets = static_cast<long>(std::lround(std::pow(3.0, static_cast<double>(n))));
  for (long code = 0; code < sets; ++code) {
    Vector t = small.problem.lower;
    std::vector<Index> free;
    bool sensible = true;
    long rest = code;
    for (Index j = 0; j < n; ++j, rest /= 3) {
      if (rest % 3 == 1) t[j] = small.problem.upper_at(j);
      if (rest % 3 == 2) free.push_back(j);
      sensible = sensible && std::isfinite(t[j]);
    }
    if (!sensible) continue;
    if (!free.empty()) {
      const Eigen::MatrixXd step = oracle::solve_by_elimination(q.h(free, free), -q.gradient(t)(free));
      if (step.size() == 0) continue;
      t(free) += step;
    }
    for (Index j = 0; j < n; ++j)
      sensible = sensible && t[j] >= small.problem.lower[j] && t[j] <= small.problem.upper_at(j);
    if (!sensible || !(q.value(t) < best_value)) continue;
    best_value = q.value(t);
    best = t;
  }
  return best;
}

Vector minimise_by_coordinates(const SmallProblem& small) {
  const Quadratic q = small.quadratic();
  Vector t = small.problem.lower;
  Vector g = q.gradient(t);
  for (int sweep = 0; sweep < 200'000; ++sweep) {
    double largest = 0.0;
    for (Index j = 0; j < t.size(); ++j) {
      if (!(q.h(j, j) > 0.0)) continue;  // a column of zeros stays where it is cheapest, at the lower bound
      const double next = std::clamp(t[j] - g[j] / q.h(j, j), small.problem.lower[j], small.problem.upper_at(j));
      const double change = next - t[j];
      if (change == 0.0) continue;
      g += change * q.h.col(j);
      t[j] = next;
      largest = std::max(largest, std::abs(change));
    }
    if (largest <= 1e-15) break;
    if (sweep % 100 == 99) g = q.gradient(t);
  }
  return t;
}

double gradient_scale(const SmallProblem& small) {
  const DwellProblem& p = small.problem;
  Vector y = p.target;
  if (p.weights.size()) y = y.cwiseProduct(p.weights).eval();
  if (p.form.cols()) y -= p.form * (p.form.transpose() * y).eval();
  if (p.weights.size()) y = y.cwiseProduct(p.weights).eval();
  const double scale = (small.a.transpose() * y).norm();
  return scale > 0.0 ? scale : 1.0;
}

double objective_slack(const SmallProblem& small, double tolerance, const Vector& t, const Vector& optimum) {
  const Quadratic q = small.quadratic();
  const double terms = q.constant + std::abs(q.c.dot(t)) + t.dot(q.h * t);
  return tolerance * gradient_scale(small) * (t - optimum).norm() + 1e-13 * terms;
}

}  // namespace dwell::test
