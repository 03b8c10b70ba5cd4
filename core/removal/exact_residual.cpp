#include "core/removal/exact_residual.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "core/base/random_numbers.h"
#include "core/form/form.h"

namespace dwell {
namespace {

// Gauss points of a check of every pixel: half a second, and for the lattice alone a twentieth.
constexpr double kCheap = 6e7, kCheapForLattice = 6e6;
constexpr double kEnough = 0.01;
constexpr Index kFirstBatch = 64, kForLattice = 256;  // at random
constexpr Index kFewestLargest = 64, kMostLargest = 256;

/// So many of the largest residuals are looked at.
Index largest_of(Index pixels, ExactCheck check) {
  return check == ExactCheck::Lattice ? kFewestLargest : std::clamp(pixels / 2000, kFewestLargest, kMostLargest);
}

/// The pixels in the order in which they are looked at: the largest residuals, then the others at random.
class LookOrder {
 public:
  LookOrder(const Vector& residual, Index largest) : largest_(std::min(largest, residual.size())) {
    const auto count = static_cast<std::size_t>(residual.size());
    const double mean = count > 0 ? residual.mean() : 0.0;
    places_.resize(count);
    std::iota(places_.begin(), places_.end(), Index{0});
    const auto end = places_.begin() + largest_;
    if (end == places_.end()) return;
    std::vector<double> sizes(count);
    for (std::size_t i = 0; i < count; ++i) sizes[i] = std::abs(residual[static_cast<Index>(i)] - mean);
    std::vector<double> in_order = sizes;
    std::nth_element(in_order.begin(), in_order.begin() + largest_, in_order.end(), std::greater<>());
    const double least = in_order[static_cast<std::size_t>(largest_)];
    // Those above come first, then as many equal ones as there is room for, so that the order is the same everywhere.
    const auto equal =
        std::stable_partition(places_.begin(), places_.end(), [&](Index i) { return at(sizes, i) > least; });
    std::stable_partition(equal, places_.end(), [&](Index i) { return at(sizes, i) == least; });
  }

  Index largest() const { return largest_; }
  /// The k-th place in the list of pixels; to be asked for in order.
  Index next(Index k) {
    if (k >= largest_) random_.draw(places_, static_cast<std::size_t>(k));
    return (*this)[k];
  }
  Index operator[](Index k) const { return places_[static_cast<std::size_t>(k)]; }

 private:
  static double at(const std::vector<double>& values, Index i) { return values[static_cast<std::size_t>(i)]; }

  std::vector<Index> places_;
  Index largest_;
  RandomNumbers random_{1};
};

/// The values of a map at these pixels, the form terms of the basis removed.
Vector without_form(const HeightMap& map, const std::vector<Index>& pixels, const Eigen::MatrixXd& basis) {
  Vector values(static_cast<Index>(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i)
    values[static_cast<Index>(i)] = map.values[static_cast<std::size_t>(pixels[i])];
  remove_form(basis, values);
  return values;
}

/// What is known of the pixels looked at so far.
class ResidualCheck {
 public:
  ResidualCheck(const RemovalProbe& probe, const HeightMap& map, const HeightMap& left, const FormTerms& form,
                int threads, ExactCheck check)
      : probe_(probe),
        map_(map),
        left_(left),
        threads_(threads),
        check_(check),
        pixels_(finite_pixels(map)),
        basis_(form_basis(map.grid, pixels_, form, {}, threads)),
        residual_(without_form(left, pixels_, basis_)),
        order_(residual_, largest_of(residual_.size(), check)) {}

  ExactResidual run(const Progress& progress) {
    look_at(first_look(), progress);
    ExactResidual result = estimate();
    const auto enough = [&] { return result.all || result.standard_error <= kEnough * result.statistics.rms; };
    while (check_ != ExactCheck::Lattice && !enough()) {
      look_at(order_.largest() + 2 * (looked() - order_.largest()), progress);
      result = estimate();
    }
    result.surface = surface();
    if (check_ != ExactCheck::Lattice) add_ripple(result, progress);
    return result;
  }

 private:
  Index looked() const { return static_cast<Index>(difference_.size()); }

  /// How many pixels are looked at before the first estimate.
  Index first_look() const {
    const bool lattice = check_ == ExactCheck::Lattice;
    const double points = static_cast<double>(residual_.size()) * probe_.points_under_tool();
    if (check_ == ExactCheck::EveryPixel || points <= (lattice ? kCheapForLattice : kCheap)) return residual_.size();
    return order_.largest() + (lattice ? kForLattice : kFirstBatch);
  }

  /// Looks at pixels in order until there are so many, or all.
  void look_at(Index count, const Progress& progress) {
    std::vector<Index> next;
    for (Index k = looked(); k < std::min(count, residual_.size()); ++k)
      next.push_back(pixels_[static_cast<std::size_t>(order_.next(k))]);
    const Vector removal = mean_removal(probe_, map_.grid, next, threads_, progress);
    for (std::size_t k = 0; k < next.size(); ++k) {
      const auto i = static_cast<std::size_t>(next[k]);
      difference_.push_back(map_.values[i] - removal[static_cast<Index>(k)] - left_.values[i]);
    }
  }

  /// How many pixels one of those looked at stands for.
  double weight(Index k) const {
    if (k < order_.largest()) return 1.0;
    return static_cast<double>(residual_.size() - order_.largest()) / static_cast<double>(looked() - order_.largest());
  }

  Index pixel_at(Index k) const { return pixels_[static_cast<std::size_t>(order_[k])]; }

  /// The differences without the form terms that they hold, by weighted least squares over the pixels looked at.
  Vector differences_without_form() const {
    Vector d = Vector::Map(difference_.data(), looked());
    const Index terms = basis_.cols();
    if (terms == 0) return d;
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(terms, terms);
    Vector moments = Vector::Zero(terms);
    for (Index k = 0; k < looked(); ++k) {
      gram += weight(k) * basis_.row(order_[k]).transpose() * basis_.row(order_[k]);
      moments += weight(k) * d[k] * basis_.row(order_[k]).transpose();
    }
    const Vector coefficients = gram.ldlt().solve(moments);
    for (Index k = 0; k < looked(); ++k) d[k] -= basis_.row(order_[k]).dot(coefficients);
    return d;
  }

  ExactResidual estimate() const {
    const Vector d = differences_without_form();
    const auto count = static_cast<double>(residual_.size());
    double squares = residual_.squaredNorm(), sum = residual_.sum(), errors = 0.0;
    double mean = 0.0, scatter = 0.0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (Index k = 0; k < looked(); ++k) {
      const double before = residual_[order_[k]], after = before + d[k];
      const double change = after * after - before * before;
      squares += weight(k) * change;
      sum += weight(k) * d[k];
      errors += weight(k) * d[k] * d[k];
      low = std::min(low, after);
      high = std::max(high, after);
      if (k < order_.largest()) continue;
      const double n = static_cast<double>(k - order_.largest() + 1), step = change - mean;  // Welford
      mean += step / n;
      scatter += step * (change - mean);
    }
    ExactResidual result;
    result.checked = looked();
    result.all = looked() == residual_.size();
    const double about_zero = std::sqrt(std::max(0.0, squares / count));
    result.statistics.valid_pixels = residual_.size();
    result.statistics.mean = sum / count;
    result.statistics.rms =
        std::sqrt(std::max(0.0, about_zero * about_zero - result.statistics.mean * result.statistics.mean));
    result.statistics.pv = high - low;
    result.lattice_rms = std::sqrt(residual_.squaredNorm() / count);
    result.lattice_error = std::sqrt(errors / count);
    if (!result.all) {
      const double others = count - static_cast<double>(order_.largest()),
                   n = static_cast<double>(looked() - order_.largest());
      const double deviation = std::sqrt(scatter / (n - 1.0) / n * (1.0 - n / others)) * others / count;
      result.standard_error = about_zero > 0.0 ? 0.5 * deviation / about_zero : deviation;
    }
    return result;
  }

  HeightMap surface() const {
    const Vector d = differences_without_form();
    HeightMap map(map_.grid);
    for (Index i = 0; i < residual_.size(); ++i)
      map.values[static_cast<std::size_t>(pixels_[static_cast<std::size_t>(i)])] = residual_[i];
    for (Index k = 0; k < looked(); ++k) map.values[static_cast<std::size_t>(pixel_at(k))] += d[k];
    return map;
  }

  /// RMS within pixels of the removal less the parabolic surface that has the means of the pixels around, over pixels
  /// at random: until it is known to kEnoughRipple, or so many are looked at as are cheap.
  void add_ripple(ExactResidual& result, const Progress& progress) const {
    constexpr Index kFirst = 24;
    constexpr double kEnoughRipple = 0.02, kCheapRipple = 4e7, kPointsOfAPixel = 57.0;
    const double cheap = kCheapRipple / (kPointsOfAPixel * std::max(1.0, probe_.points_under_tool()));
    const Index most =
        std::min(std::max(kFirst, static_cast<Index>(std::min(cheap, 1e5))), static_cast<Index>(pixels_.size()));
    std::vector<Index> places = pixels_;
    RandomNumbers random{2};
    std::vector<double> squares;
    for (Index next = kFirst; static_cast<Index>(squares.size()) < most; next *= 2) {
      progress.check();
      const auto first = static_cast<Index>(squares.size()), last = std::min(next, most);
      squares.resize(static_cast<std::size_t>(last));
      for (Index k = first; k < last; ++k) random.draw(places, static_cast<std::size_t>(k));
#pragma omp parallel for num_threads(threads_) schedule(dynamic, 1)
      for (Index k = first; k < last; ++k) {
        const auto i = static_cast<std::size_t>(k);
        squares[i] = ripple_in(map_.grid.centre(places[i]), k);
      }
      set_ripple(result, squares);
      if (result.ripple_error <= kEnoughRipple * result.ripple) return;
    }
  }

  static void set_ripple(ExactResidual& result, const std::vector<double>& squares) {
    const auto n = static_cast<double>(squares.size());
    const double mean = std::accumulate(squares.begin(), squares.end(), 0.0) / n;
    double scatter = 0.0;
    for (const double square : squares) scatter += (square - mean) * (square - mean);
    result.ripple = std::sqrt(mean);
    const double deviation = n > 1.0 ? std::sqrt(scatter / (n - 1.0) / n) : mean;
    result.ripple_error = mean > 0.0 ? 0.5 * deviation / result.ripple : 0.0;
  }

  /// Mean square of the ripple in a pixel, at one random place in each of 4 x 4 parts of it.
  double ripple_in(Point centre, Index seed) const {
    constexpr int kParts = 4;
    const Grid& g = map_.grid;
    std::array<std::array<double, 3>, 3> means{};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        const Point beside{(static_cast<double>(c) - 1.0) * g.pitch_x, (static_cast<double>(r) - 1.0) * g.pitch_y};
        means[r][c] = probe_.mean_over_pixel(centre + beside);
      }
    }
    RandomNumbers random(static_cast<std::uint64_t>(seed));
    double sum = 0.0;
    for (int i = 0; i < kParts; ++i) {
      for (int j = 0; j < kParts; ++j) {
        const double u = (j + random.uniform()) / kParts - 0.5, v = (i + random.uniform()) / kParts - 0.5;
        const auto wx = parabola_weights(u), wy = parabola_weights(v);
        double smooth = 0.0;
        for (std::size_t r = 0; r < 3; ++r)
          smooth += wy[r] * (wx[0] * means[r][0] + wx[1] * means[r][1] + wx[2] * means[r][2]);
        const double d = probe_.at(centre + Point{u * g.pitch_x, v * g.pitch_y}) - smooth;
        sum += d * d;
      }
    }
    return sum / (kParts * kParts);
  }

  /// The value, at u pixels from the middle, of the parabola whose means over three pixels these weights multiply.
  static std::array<double, 3> parabola_weights(double u) {
    const double q = u * u - 1.0 / 12.0;
    return {0.5 * (q - u), 1.0 - q, 0.5 * (q + u)};
  }

  const RemovalProbe& probe_;
  const HeightMap& map_;
  const HeightMap& left_;
  int threads_;
  ExactCheck check_;
  std::vector<Index> pixels_;
  Eigen::MatrixXd basis_;
  Vector residual_;  // by the lattice, form terms removed
  LookOrder order_;
  std::vector<double> difference_;  // exact less lattice, of the pixels looked at
};

}  // namespace

double ExactResidual::total() const { return std::hypot(statistics.rms_about_zero(), ripple); }

ExactResidual exact_residual(const RemovalProbe& probe, const HeightMap& map, const HeightMap& left,
                             const FormTerms& form, int threads, const Progress& progress, ExactCheck check) {
  return ResidualCheck(probe, map, left, form, threads, check).run(progress);
}

}  // namespace dwell
