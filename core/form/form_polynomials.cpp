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

/// Term by term.
std::array<double, FormPolynomials::kTerms> terms_at(double x, double y) {
  return {1.0, x, y, x * x + y * y, x * x - y * y, 2.0 * x * y};
}

double product_of(const FormPolynomials::Polynomial& a, const std::array<FormPolynomials::Polynomial, 6>& gram,
                  const FormPolynomials::Polynomial& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < FormPolynomials::kTerms; ++i) {
    for (std::size_t j = 0; j < FormPolynomials::kTerms; ++j) sum += a[i] * gram[i][j] * b[j];
  }
  return sum;
}

}  // namespace

FormPolynomials::FormPolynomials(const Grid& grid, std::span<const Index> pixels, const FormTerms& terms,
                                 std::span<const double> weights, int threads)
    : grid_(grid), pixels_(pixels), weights_(weights), threads_(std::max(threads, 1)), astigmatism_(terms.astigmatism) {
  const double all = size();
  if (!std::isfinite(all)) throw std::invalid_argument("form_basis: weights must be finite");
  if (!terms.any() || !(all > 0.0)) return;
  centre_and_scale();
  const Gram products = astigmatism_ ? gram<kTerms>() : gram<kRoundTerms>();
  if (terms.piston) add_term<kRoundTerms>(0, all, products);
  if (terms.tilt) add_term<kRoundTerms>(1, all, products);
  if (terms.tilt) add_term<kRoundTerms>(2, all, products);
  if (terms.power) add_term<kRoundTerms>(3, all, products);
  if (terms.astigmatism) add_term<kTerms>(4, all, products);
  if (terms.astigmatism) add_term<kTerms>(5, all, products);
}

/// |w|.
double FormPolynomials::size() const {
  if (weights_.empty()) return std::sqrt(static_cast<double>(pixels_.size()));
  return std::sqrt(sum<1>([this](auto& s, const Place& p) { s[0] += weight(p.number) * weight(p.number); })[0]);
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

template <std::size_t N, class Add>
std::array<double, N> FormPolynomials::sum(const Add& add) const {
  const Index count = blocks();
  std::vector<std::array<double, N>> of_block(static_cast<std::size_t>(count), std::array<double, N>{});
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (Index b = 0; b < count; ++b) {
    std::array<double, N> sums{};
    visit_block(b, [&](const Place& p) { add(sums, p); });
    of_block[static_cast<std::size_t>(b)] = sums;
  }
  std::array<double, N> total{};
  for (const auto& sums : of_block) {
    for (std::size_t k = 0; k < N; ++k) total[k] += sums[k];
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
  const auto moments = sum<3>([this](auto& s, const Place& p) {
    const double w2 = weight(p.number) * weight(p.number);
    s[0] += w2, s[1] += w2 * p.x, s[2] += w2 * p.y;
  });
  centre_x_ = moments[1] / moments[0];
  centre_y_ = moments[2] / moments[0];
  double extent = 0.0;
#pragma omp parallel for num_threads(threads_) schedule(static) reduction(max : extent)
  for (Index b = 0; b < blocks(); ++b) {
    visit_block(b, [&](const Place& p) { extent = std::max({extent, std::abs(p.x), std::abs(p.y)}); });
  }
  if (extent > 0.0) per_extent_ = 1.0 / extent;
}

template <std::size_t Terms>
FormPolynomials::Gram FormPolynomials::gram() const {
  const auto sums = sum<Terms * Terms>([this](auto& s, const Place& p) {
    const double w2 = weight(p.number) * weight(p.number);
    const auto t = terms_at(p.x, p.y);
    for (std::size_t i = 0; i < Terms; ++i) {
      for (std::size_t j = 0; j < Terms; ++j) s[i * Terms + j] += w2 * t[i] * t[j];
    }
  });
  Gram result{};
  for (std::size_t i = 0; i < Terms; ++i) {
    for (std::size_t j = 0; j < Terms; ++j) result[i][j] = sums[i * Terms + j];
  }
  return result;
}

/// Gram-Schmidt by the products of the terms, which takes no pass over the pixels. Where the others hold most of the
/// term, the products have lost digits, and the pixels are asked.
template <std::size_t Terms>
void FormPolynomials::add_term(std::size_t term, double size, const Gram& gram) {
  constexpr double kMostLeft = 0.5;  // of the square: one pass is then enough (Kahan, in Parlett 1980)
  Polynomial candidate{};
  candidate[term] = 1.0;
  const double before = gram[term][term];
  std::vector<double> products;
  for (const Polynomial& q : orthonormal_) products.push_back(product_of(candidate, gram, q));
  for (std::size_t k = 0; k < products.size(); ++k) {
    for (std::size_t c = 0; c < kTerms; ++c) candidate[c] -= products[k] * orthonormal_[k][c];
  }
  const double after = product_of(candidate, gram, candidate);
  const double norm = after >= kMostLeft * before ? std::sqrt(after) : orthogonalise<Terms>(candidate);
  // The terms are at most of the size |w|; what the others leave of a dependent term is rounding.
  if (!(norm > 1e-9 * size)) return;
  for (double& c : candidate) c /= norm;
  orthonormal_.push_back(candidate);
}

/// Gram-Schmidt by sums over the pixels; twice is enough (Giraud et al. 2005): the second pass takes out what rounding
/// in the first left behind. Returns the norm.
template <std::size_t Terms>
double FormPolynomials::orthogonalise(Polynomial& candidate) const {
  const std::size_t rank = orthonormal_.size();
  for (int pass = 0; pass < 2 && rank > 0; ++pass) {
    const Sums product = sum<kTerms>([&](Sums& s, const Place& p) {
      const double w = weight(p.number), v = w * w * value_of<Terms>(candidate, p.x, p.y);
      for (std::size_t k = 0; k < rank; ++k) s[k] += v * value_of<Terms>(orthonormal_[k], p.x, p.y);
    });
    for (std::size_t k = 0; k < rank; ++k) {
      for (std::size_t c = 0; c < kTerms; ++c) candidate[c] -= product[k] * orthonormal_[k][c];
    }
  }
  return std::sqrt(sum<1>([&](auto& s, const Place& p) {
    const double v = weight(p.number) * value_of<Terms>(candidate, p.x, p.y);
    s[0] += v * v;
  })[0]);
}

Eigen::VectorXd FormPolynomials::at(Index pixel) const {
  Eigen::VectorXd values(rank());
  for (Index k = 0; k < rank(); ++k) values[k] = value_at(orthonormal_[static_cast<std::size_t>(k)], pixel);
  return values;
}

double FormPolynomials::value_at(const Polynomial& form, Index pixel) const {
  const Point p = scaled(pixel);
  return value_of<kTerms>(form, p.x, p.y);
}

/// The place of a pixel as the polynomials take it.
Point FormPolynomials::scaled(Index pixel) const {
  if (pixels_.empty()) return {};
  const Index first = pixels_.front();
  const auto rows = static_cast<double>(pixel / grid_.cols - first / grid_.cols);
  const auto cols = static_cast<double>(pixel % grid_.cols - first % grid_.cols);
  return {(grid_.pitch_x * cols - centre_x_) * per_extent_, (grid_.pitch_y * rows - centre_y_) * per_extent_};
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
FormPolynomials::Polynomial FormPolynomials::fit_terms(std::span<const double> map_values) const {
  Polynomial form{};
  for (int pass = 0; pass < 2; ++pass) {  // as above
    const Sums product = sum<kTerms>([&](Sums& s, const Place& p) {
      const double v = map_values[static_cast<std::size_t>(p.pixel)] - value_of<Terms>(form, p.x, p.y);
      for (std::size_t k = 0; k < orthonormal_.size(); ++k) s[k] += v * value_of<Terms>(orthonormal_[k], p.x, p.y);
    });
    for (std::size_t k = 0; k < orthonormal_.size(); ++k) {
      for (std::size_t c = 0; c < kTerms; ++c) form[c] += product[k] * orthonormal_[k][c];
    }
  }
  return form;
}

FormPolynomials::Polynomial FormPolynomials::fit(std::span<const double> map_values) const {
  if (rank() == 0) return {};
  return astigmatism_ ? fit_terms<kTerms>(map_values) : fit_terms<kRoundTerms>(map_values);
}

template <std::size_t Terms>
void FormPolynomials::subtract_form(std::span<double> map_values) const {
  const Polynomial form = fit_terms<Terms>(map_values);
  for_each([&](const Place& p) { map_values[static_cast<std::size_t>(p.pixel)] -= value_of<Terms>(form, p.x, p.y); });
}

void FormPolynomials::remove_from(std::span<double> map_values) const {
  if (rank() == 0) return;
  astigmatism_ ? subtract_form<kTerms>(map_values) : subtract_form<kRoundTerms>(map_values);
}

}  // namespace dwell
