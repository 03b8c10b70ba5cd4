#include "solvers/peers/fourier_deconvolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "core/base/errors.h"
#include "core/numerics/fft.h"
#include "solvers/peers/adapter_run.h"

namespace dwell {
namespace {

using Spectrum = std::vector<std::complex<double>>;

/// Whether the form terms hold the constant, so that the target may be raised.
bool piston_is_free(const DwellProblem& p) {
  if (p.form.cols() == 0) return false;
  const Vector one = p.weights.size() == 0 ? Vector::Ones(p.pixels()) : p.weights;
  const Vector left = one - p.form * (p.form.transpose() * one);
  return left.norm() <= 1e-9 * one.norm();
}

/// The map's grid, wide enough around it for every dwell point that reaches it and for the filter's own reach, with the
/// spectra of removal function and target.
class WienerFilter {
 public:
  explicit WienerFilter(const DwellProblem& p)
      : g_(*p.parts.front().geometry),
        margin_rows_(2 * g_.kernel.half_rows),
        margin_cols_(2 * g_.kernel.half_cols),
        fft_(good_fft_size(g_.lattice.rows + 2 * margin_rows_), good_fft_size(g_.lattice.cols + 2 * margin_cols_),
             g_.threads) {
    load_kernel();
    const double raise = piston_is_free(p) && p.pixels() > 0 ? -p.target.minCoeff() : 0.0;
    load_target(p.target.array() + raise);
    for (const auto& b : kernel_) largest_ = std::max(largest_, std::norm(b));
  }

  /// T at the dwell points, not scaled.
  Vector dwell(double lambda) {
    const auto spectrum = fft_.spectrum();
    const double floor = lambda * largest_;
    for (std::size_t k = 0; k < spectrum.size(); ++k)
      spectrum[k] = std::conj(kernel_[k]) * target_[k] / (std::norm(kernel_[k]) + floor);
    fft_.inverse();
    Vector t(static_cast<Index>(g_.strokes.size()));
    for (std::size_t j = 0; j < g_.strokes.size(); ++j) t[static_cast<Index>(j)] = at(g_.strokes[j].via);
    return t;
  }

 private:
  std::size_t node(Index row, Index col) const {
    const Index r = (row % fft_.rows() + fft_.rows()) % fft_.rows();
    const Index c = (col % fft_.cols() + fft_.cols()) % fft_.cols();
    return static_cast<std::size_t>(r * fft_.cols() + c);
  }

  Spectrum transformed() {
    fft_.forward();
    return {fft_.spectrum().begin(), fft_.spectrum().end()};
  }

  void clear() { std::fill(fft_.real().begin(), fft_.real().end(), 0.0); }

  void load_kernel() {
    clear();
    for (Index r = -g_.kernel.half_rows; r <= g_.kernel.half_rows; ++r) {
      for (Index c = -g_.kernel.half_cols; c <= g_.kernel.half_cols; ++c) {
        fft_.real()[node(r, c)] =
            g_.kernel.rate({g_.lattice.pitch_x * static_cast<double>(c), g_.lattice.pitch_y * static_cast<double>(r)});
      }
    }
    kernel_ = transformed();
  }

  /// Values at the pixels, seen through the removal function turned about its axis: what a dwell at each node sees.
  std::vector<double> seen(const Vector& values) {
    put(values);
    fft_.forward();
    for (std::size_t k = 0; k < kernel_.size(); ++k) fft_.spectrum()[k] *= std::conj(kernel_[k]);
    fft_.inverse();
    return {fft_.real().begin(), fft_.real().end()};
  }

  void put(const Vector& values) {
    clear();
    for (std::size_t i = 0; i < g_.pixels.size(); ++i)
      fft_.real()[node(g_.pixels[i] / g_.lattice.cols, g_.pixels[i] % g_.lattice.cols)] = values[static_cast<Index>(i)];
  }

  void load_target(const Vector& values) {
    const std::vector<double> sum = seen(values), share = seen(Vector::Ones(values.size()));
    const double most = *std::max_element(share.begin(), share.end());
    constexpr double kSeen = 1e-3;  // of the removal function; less is rounding and falls to zero
    put(values);
    std::vector<char> known(sum.size(), 0);
    for (const Index pixel : g_.pixels) known[node(pixel / g_.lattice.cols, pixel % g_.lattice.cols)] = 1;
    for (std::size_t k = 0; k < sum.size(); ++k) {
      if (!known[k] && share[k] > kSeen * most) fft_.real()[k] = sum[k] / share[k];
    }
    target_ = transformed();
  }

  /// The field at a point, bilinear; zero beyond the margin.
  double at(Point p) {
    const double u = (p.x - g_.lattice.origin.x) / g_.lattice.pitch_x,
                 v = (p.y - g_.lattice.origin.y) / g_.lattice.pitch_y;
    const auto rows = static_cast<double>(g_.lattice.rows + margin_rows_ - 1);
    const auto cols = static_cast<double>(g_.lattice.cols + margin_cols_ - 1);
    if (!(u > -static_cast<double>(margin_cols_) && v > -static_cast<double>(margin_rows_) && u < cols && v < rows))
      return 0.0;
    const auto row = static_cast<Index>(std::floor(v)), col = static_cast<Index>(std::floor(u));
    const double fu = u - std::floor(u), fv = v - std::floor(v);
    const auto field = fft_.real();
    return (1.0 - fv) * ((1.0 - fu) * field[node(row, col)] + fu * field[node(row, col + 1)]) +
           fv * ((1.0 - fu) * field[node(row + 1, col)] + fu * field[node(row + 1, col + 1)]);
  }

  const RemovalGeometry& g_;
  Index margin_rows_, margin_cols_;
  RealFft2D fft_;
  Spectrum kernel_, target_;
  double largest_ = 0.0;  // |B|^2
};

/// d scaled so that its removal fits the target best, in the norm of the problem. One application.
void scale_to_fit(DwellObjective& objective, const Vector& target, Vector& d) {
  Vector image;
  objective.image(d, image);
  const double square = image.squaredNorm(), product = image.dot(target);
  d *= square > 0.0 && product > 0.0 ? product / square : 0.0;
}

}  // namespace

void FourierDeconvolution::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  if (!problem.has_geometry())
    throw InputError("solver = 'fourier' needs to know what the removal operator is made of: DwellPart.geometry");
  if (problem.parts.size() > 1) {
    throw InputError(
        fmt::format("solver = 'fourier' with {} tools or passes; accepted: 1, as it divides by the spectrum "
                    "of one removal function",
                    problem.parts.size()));
  }
  if (problem.blocks() > 1) {
    throw InputError(
        "solver = 'fourier' with an expected residual; accepted: a residual, as it divides by the spectrum of one "
        "removal function");
  }
  if (problem.rows) {
    throw InputError(
        "solver = 'fourier' with an objective in slopes; accepted: one in heights, as it divides spectra of "
        "heights");
  }
  AdapterRun run(problem, options_, t, summary);
  run.settle_by_evaluations(false);
  if (!run.stopped() && problem.points() > 0 && problem.pixels() > 0) {
    Vector point = t, gradient;
    run.evaluate(point, gradient);
    DwellObjective objective(problem);
    Vector target;
    objective.residual(Vector::Zero(problem.points()), target);
    target = -target;
    WienerFilter filter(problem);
    for (double lambda = 1e-1; lambda > 0.5e-7 && !run.stopped(); lambda *= 0.1) {
      point = filter.dwell(lambda);
      clip_to_bounds(problem, point);
      scale_to_fit(objective, target, point);
      run.evaluate(point, gradient);
    }
  }
  run.finish("a deconvolution is no optimum", t);
}

}  // namespace dwell
