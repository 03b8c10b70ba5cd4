#include "core/form/form_polynomials.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dwell {
namespace {

// Pixels: small enough to share the work among threads, large enough to keep them busy.
constexpr Index kBlock = 1 << 14;

constexpr std::size_t kRoundTerms = 4;  // piston, tilt, power

/// The value at (x, y) of the first `Terms` coefficients, 4 or 6.
template <std::size_t Terms>
double value_of(const FormPolynomials::Polynomial& p, double x, double y) {
  const double round = p[0] + p[1] * x + p[2] * y + p[3] * (x * x + y * y);
  if constexpr (Terms == kRoundTerms) return round;
  return round + p[4] * (x * x - y * y) + p[5] * (2.0 * x * y);
}

}  // namespace

FormPolynomials::FormPolynomials(const Grid& grid, std::span<const Index> pixels, const FormTerms& terms,
                                 std::span<const double> weights, int threads)
    : grid_(grid), pixels_(pixels), weights_(weights), threads_(std::max(threads, 1)), astigmatism_(terms.astigmatism) {
  const double size =
      std::sqrt(sum([this](Sums& s, const Place& p) { s[0] += weight(p.number) * weight(p.number); })[0]);
  if (!std::isfinite(size)) throw std::invalid_argument("form_basis: weights must be finite");
  if (!terms.any() || !(size > 0.0)) return;
  centre_and_scale();
  if (terms.piston) add_term<kRoundTerms>(0, size);
  if (terms.tilt) add_term<kRoundTerms>(1, size);
  if (terms.tilt) add_term<kRoundTerms>(2, size);
  if (terms.power) add_term<kRoundTerms>(3, size);
  if (terms.astigmatism) add_term<kTerms>(4, size);
  if (terms.astigmatism) add_term<kTerms>(5, size);
}

Index FormPolynomials::blocks() const { return (static_cast<Index>(pixels_.size()) + kBlock - 1) / kBlock; }

template <class Visit>
void FormPolynomials::visit_block(Index block, const Visit& visit) const {
  const auto end = static_cast<std::size_t>(std::min((block + 1) * kBlock, static_cast<Index>(pixels_.size())));
  const Index reference_row = pixels_.front() / grid_.cols, reference_col = pixels_.front() % grid_.cols;
  Index row_begin = 0, row_end = 0;
  double y = 0.0;
  for (auto i = static_cast<std::size_t>(block * kBlock); i < end; ++i) {
    const Index pixel = pixels_[i];
    // A division for every pixel would cost more than all the rest.
    if (pixel < row_begin || pixel >= row_end) {
      const Index row = pixel / grid_.cols;
      row_begin = row * grid_.cols;
      row_end = row_begin + grid_.cols;
      y = (grid_.pitch_y * static_cast<double>(row - reference_row) - centre_y_) * per_extent_;
    }
    const double x = (grid_.pitch_x * static_cast<double>(pixel - row_begin - reference_col) - centre_x_) * per_extent_;
    visit(Place{i, pixel, x, y});
  }
}

template <class Add>
FormPolynomials::Sums FormPolynomials::sum(const Add& add) const {
  const Index count = blocks();
  std::vector<Sums> of_block(static_cast<std::size_t>(count), Sums{});
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (Index b = 0; b < count; ++b) {
    Sums sums{};
    visit_block(b, [&](const Place& p) { add(sums, p); });
    of_block[static_cast<std::size_t>(b)] = sums;
  }
  Sums total{};
  for (const Sums& sums : of_block) {
    for (std::size_t k = 0; k < kTerms; ++k) total[k] += sums[k];
  }
  return total;
}

template <class Visit>
void FormPolynomials::for_each(const Visit& visit) const {
  const Index count = blocks();
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (Index b = 0; b < count; ++b) visit_block(b, visit);
}

void FormPolynomials::centre_and_scale() {
  const Sums moments = sum([this](Sums& s, const Place& p) {
    const double w2 = weight(p.number) * weight(p.number);
    s[0] += w2, s[1] += w2 * p.x, s[2] += w2 * p.y;
  });
  centre_x_ = moments[1] / moments[0];
  centre_y_ = moments[2] / moments[0];
  double extent = 0.0;
  for (Index b = 0; b < blocks(); ++b) {
    visit_block(b, [&](const Place& p) { extent = std::max({extent, std::abs(p.x), std::abs(p.y)}); });
  }
  if (extent > 0.0) per_extent_ = 1.0 / extent;
}

/// Gram-Schmidt; twice is enough (Giraud et al. 2005): the second pass takes out what rounding in the first left
/// behind.
template <std::size_t Terms>
void FormPolynomials::add_term(std::size_t term, double size) {
  Polynomial candidate{};
  candidate[term] = 1.0;
  const std::size_t rank = orthonormal_.size();
  for (int pass = 0; pass < 2 && rank > 0; ++pass) {
    const Sums product = sum([&](Sums& s, const Place& p) {
      const double w = weight(p.number), v = w * w * value_of<Terms>(candidate, p.x, p.y);
      for (std::size_t k = 0; k < rank; ++k) s[k] += v * value_of<Terms>(orthonormal_[k], p.x, p.y);
    });
    for (std::size_t k = 0; k < rank; ++k) {
      for (std::size_t c = 0; c < kTerms; ++c) candidate[c] -= product[k] * orthonormal_[k][c];
    }
  }
  const double norm = std::sqrt(sum([&](Sums& s, const Place& p) {
    const double v = weight(p.number) * value_of<Terms>(candidate, p.x, p.y);
    s[0] += v * v;
  })[0]);
  // The terms are at most of the size |w|; what the others leave of a dependent term is rounding.
  if (!(norm > 1e-9 * size)) return;
  for (double& c : candidate) c /= norm;
  orthonormal_.push_back(candidate);
}

template <std::size_t Terms>
void FormPolynomials::write_columns(Eigen::MatrixXd& q) const {
  for_each([&](const Place& p) {
    for (Index k = 0; k < q.cols(); ++k) {
      q(static_cast<Index>(p.number), k) =
          weight(p.number) * value_of<Terms>(orthonormal_[static_cast<std::size_t>(k)], p.x, p.y);
    }
  });
}

Eigen::MatrixXd FormPolynomials::columns() const {
  Eigen::MatrixXd q(static_cast<Index>(pixels_.size()), rank());
  astigmatism_ ? write_columns<kTerms>(q) : write_columns<kRoundTerms>(q);
  return q;
}

template <std::size_t Terms>
void FormPolynomials::subtract_form(std::span<double> map_values) const {
  Polynomial form{};
  for (int pass = 0; pass < 2; ++pass) {  // as above
    const Sums product = sum([&](Sums& s, const Place& p) {
      const double v = map_values[static_cast<std::size_t>(p.pixel)] - value_of<Terms>(form, p.x, p.y);
      for (std::size_t k = 0; k < orthonormal_.size(); ++k) s[k] += v * value_of<Terms>(orthonormal_[k], p.x, p.y);
    });
    for (std::size_t k = 0; k < orthonormal_.size(); ++k) {
      for (std::size_t c = 0; c < kTerms; ++c) form[c] += product[k] * orthonormal_[k][c];
    }
  }
  for_each([&](const Place& p) { map_values[static_cast<std::size_t>(p.pixel)] -= value_of<Terms>(form, p.x, p.y); });
}

void FormPolynomials::remove_from(std::span<double> map_values) const {
  if (rank() == 0) return;
  astigmatism_ ? subtract_form<kTerms>(map_values) : subtract_form<kRoundTerms>(map_values);
}

}  // namespace dwell
